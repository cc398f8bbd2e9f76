#pragma once
// Interface of a kind of source; queued_source.hpp makes a FrameSource of it.

#include <memory>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/capture/source/source_uri.hpp>

namespace turnscan::source {

class Grabber {
 public:
  virtual ~Grabber() = default;
  /// Constant after construction.
  virtual const SourceInfo& info() const = 0;
  virtual Result<> start() = 0;
  /// The next frame, in order of time, or kNothing after at most timeout_s, which is short. Frames
  /// that the driver knows to be lost are returned as FrameStatus::kDropped. info.index is set
  /// later. Called on one thread between start() and stop().
  virtual Result<Delivery> grab(double timeout_s) = 0;
  virtual void stop() = 0;
  /// See FrameSource::lay_object().
  virtual Result<> lay_object(const Eigen::Matrix3d& rotation, double time_s);
};

/// Openers of the URI schemes. Parameters common to all sources have been removed before.
Result<std::unique_ptr<Grabber>> open_virtual(const SourceUri& uri, const RunContext& context);
Result<std::unique_ptr<Grabber>> open_replay(const SourceUri& uri, const RunContext& context);

/// Seconds of the steady clock.
double steady_seconds();

/// The text with every character not allowed in an identity replaced by '-'.
std::string identity_text(std::string_view text);

}  // namespace turnscan::source
