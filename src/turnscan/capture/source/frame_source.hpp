#pragma once
// Where live frames come from: a device behind its driver, a recording played back, or a virtual
// sensor. docs/reference/devices.md describes the sources and what their URIs accept.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/recording/recording.hpp>
#include <vector>

namespace turnscan {

/// What is known of a source before its first frame.
struct SourceInfo {
  std::string uri;     ///< that opens it again
  std::string driver;  ///< scheme of the URI: "virtual", "replay", "openni2", ...
  /// Per sensor a name of the very device, the same at each start: driver, model and serial number.
  /// Its characters are letters, digits, '-', '_' and '.'. Calibrations are kept under it.
  std::vector<std::string> identities;
  /// Sensors, and the turntable where the source knows it (replay; virtual on request).
  SequenceHeader header;
  /// For sources that know it (virtual sensors on request): from a fixed frame that several sources
  /// share to the frame of the turntable. The axis alone does not determine the azimuth of one
  /// sensor relative to another.
  std::optional<Pose> T_table_common;
  CaptureSettings settings;  ///< of the driver: mode, firmware, exposure; for recording.json
  double fps = 0.0;          ///< of each sensor, nominal; 0: unknown
  /// Frames come in their own time, and those that nobody takes in time are lost. False: frames
  /// come as fast as they are taken, and none is lost.
  bool live = true;
  std::optional<std::uint64_t> frame_count;  ///< of a source that ends by itself
  bool lays_object = false;                  ///< lay_object() is supported
};

/// What next() returns.
struct Delivery {
  enum class Kind {
    kFrame,    ///< a frame; FrameStatus::kDropped: one was lost here, and there is only its info
    kNothing,  ///< no frame came within the timeout
    kEnd       ///< the source has ended or was stopped, and no frame is waiting
  };
  Kind kind = Kind::kNothing;
  Frame frame;
  /// When the frame reached this machine, in seconds of its steady clock; of a source that is not
  /// live, when it would have. NaN: unknown.
  double host_time_s = std::numeric_limits<double>::quiet_NaN();
};

/// Counts since open.
struct SourceStatistics {
  std::uint64_t delivered = 0;          ///< frames taken from next(), without lost ones
  std::uint64_t dropped_by_sensor = 0;  ///< lost before they came here
  std::uint64_t dropped_by_queue = 0;   ///< lost because nobody took them in time
  std::uint64_t refused = 0;            ///< lost because they were wrong: size, time running back
  std::size_t most_waiting = 0;         ///< frames in the queue at the worst moment

  std::uint64_t dropped() const { return dropped_by_sensor + dropped_by_queue + refused; }
};

/// A sensor, or several with one turntable before them. Between start() and stop() a thread of its
/// own takes frames from the driver and puts them into a bounded queue. When the queue is full, a
/// live source drops the oldest frame, counts it and leaves its info in its place; any other waits.
///
/// Of a frame, index counts all frames of the source (lost ones included, later than the first
/// start), time_s is the sensor's clock, sensor the position in header.sensors. Depth is in steps
/// of the sensor's depth_unit_m, whatever the driver delivers, so that live and recorded frames are
/// equal. Pixels without a return are kNoReturn; a driver's 65535 becomes kNoReturn.
/// Colour, if there is any, is registered or not as the header's sensor says.
///
/// Of each sensor time never runs back, and sizes are those of the header: frames for which this
/// does not hold are refused (counted, delivered as kDropped); after kMaxRefused in a row next()
/// fails with kFormat.
///
/// All calls from one thread, but for statistics().
class FrameSource {
 public:
  static constexpr int kMaxRefused = 30;

  virtual ~FrameSource() = default;
  virtual const SourceInfo& info() const = 0;
  /// Fails with kDeviceBusy, kDeviceLost, kNoPermission, kLibrary. After stop() it may be started
  /// again; virtual sensors and recordings then go on where they were.
  virtual Result<> start() = 0;
  /// Waits up to timeout_s for a frame. Fails with kCancelled as soon as the context is cancelled,
  /// kDeviceLost when the device went away (after all frames that were waiting), kFormat, and what
  /// reading a recording fails with. After a failure other than kCancelled it fails so again.
  virtual Result<Delivery> next(double timeout_s, const RunContext& context) = 0;
  /// No more frames come in; what waits can still be taken. Also without start().
  virtual void stop() = 0;
  virtual SourceStatistics statistics() const = 0;
  /// Lays the object differently for the next pass: it is rotated, relative to its pose at the time
  /// `time_s` of a frame, by a rotation in the frame of sensor 0, and then set down at the centre
  /// of the platter. Waiting frames are discarded; the next start() begins a turn; time goes on.
  /// To be called while the source is stopped. Fails with kUnsupported unless info().lays_object,
  /// and with kNotFound when there was no such frame.
  virtual Result<> lay_object(const Eigen::Matrix3d& rotation, double time_s);
};

/// Opens the sensor of a URI (source_uri.hpp):
///   virtual:OBJECT?sensor=kinect-v2&OPTION=VALUE...   a simulated sensor and turntable
///   replay:FOLDER?speed=2                            a recording; speed=max: as fast as it is read
///   replay:FILE?depth-unit=1mm                         what open_foreign() reads, with its options
/// Every source takes queue=N, the number of frames that may wait (default 60).
/// Fails with kInvalidOption (the URI), kNotFound (no such scheme, object, recording or device),
/// kDeviceBusy, kNoPermission, kLibrary (no such driver), and what reading fails with.
Result<std::unique_ptr<FrameSource>> open_source(const std::string& uri, const RunContext& context);

/// Several sensors before one turntable as one source; of one URI, that one. Sensors and identities
/// stand in the order of the URIs, the turntable is the first one's, and so is the clock: how far
/// the others are from it is found from when their first 20 frames came, and time_s is corrected by
/// it. Frames come in the order of time, but that a live source which is silent for 0.3 s is not
/// waited for. Fails with kInvalidOption when there is no URI, a device is given twice, or only
/// some of the sources are live, and as open_source.
Result<std::unique_ptr<FrameSource>> open_sources(const std::vector<std::string>& uris,
                                                  const RunContext& context);

}  // namespace turnscan
