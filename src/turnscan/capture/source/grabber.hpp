#pragma once
// What a kind of source has to do itself; queued_source.hpp makes a FrameSource of it.

#include <memory>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/capture/source/source_uri.hpp>

namespace turnscan::source {

class Grabber {
 public:
  virtual ~Grabber() = default;
  /// Does not change after the grabber was made.
  virtual const SourceInfo& info() const = 0;
  virtual Result<> start() = 0;
  /// The next frame, in the order of time, or kNothing after at most timeout_s, which is short.
  /// Frames that the driver knows to be lost come as FrameStatus::kDropped. info.index is set
  /// later. Called on one thread between start() and stop().
  virtual Result<Delivery> grab(double timeout_s) = 0;
  virtual void stop() = 0;
  /// As FrameSource::lay_object().
  virtual Result<> lay_object(const Eigen::Matrix3d& rotation, double time_s);
};

/// Openers of the schemes. Parameters that are common to all sources are taken out before.
Result<std::unique_ptr<Grabber>> open_virtual(const SourceUri& uri, const RunContext& context);
Result<std::unique_ptr<Grabber>> open_replay(const SourceUri& uri, const RunContext& context);

/// Seconds of the steady clock.
double steady_seconds();

/// Text with everything that an identity may not have replaced by '-'.
std::string identity_text(std::string_view text);

}  // namespace turnscan::source
