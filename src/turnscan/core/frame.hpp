#pragma once
// What a sensor delivers, and a sequence of it. A recording, a foreign data set, the simulator and
// a device are all sequences of frames.

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/image.hpp>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// Where a frame was seen from, in the sensor frame: a point, or a direction at infinity for
/// scanners whose rays are parallel.
struct Viewpoint {
  Vec3d value =
      Vec3d::Zero();  ///< position in metres, or unit vector from the surface to the sensor
  bool parallel = false;

  /// Unit vector from p towards the sensor. Zero if p is the sensor's position.
  Vec3d direction_from(const Vec3d& p) const;
  Viewpoint transformed(const Pose& T_to_from) const;
};

enum class SensorKind { kDepthCamera, kPointScanner };

struct SensorInfo {
  SensorKind kind = SensorKind::kDepthCamera;
  std::string model;                   ///< for people, e.g. "kinect-v2"; may be empty
  CameraIntrinsics intrinsics;         ///< depth cameras only
  double depth_unit_m = 1e-4;          ///< metres per step of the raw depth
  double depth_bias_m = 0.0;           ///< added to each depth after scaling
  std::optional<Pose> T_table_sensor;  ///< with the platter at angle 0
  Viewpoint viewpoint;                 ///< sensor frame; depth cameras: the origin
  /// Colour images that are not registered to depth: their own camera; then T_color_sensor holds.
  std::optional<CameraIntrinsics> color_intrinsics;
  Pose T_color_sensor = Pose::Identity();
};

/// The turntable in the frame of sensor 0.
struct TurntableInfo {
  Vec3d axis = Vec3d::UnitY();        ///< unit vector, up
  Vec3d center_m = Vec3d::Zero();     ///< on the platter's surface
  std::optional<double> radius_m;     ///< of the platter
  std::optional<double> speed_rad_s;  ///< signed, counter-clockwise seen from above is positive
  /// Where no platter was seen: the largest distance from the axis at which something turned.
  std::optional<double> reach_m;
};

enum class FrameStatus { kOk, kDropped };

struct FrameInfo {
  std::uint32_t index = 0;                                   ///< unique in a sequence
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unknown
  std::uint32_t sensor = 0;
  std::uint32_t pass = 0;  ///< which way the object lies
  std::uint32_t turn = 0;
  std::optional<double> angle_rad;     ///< how far the platter has turned since the first frame
  std::optional<Pose> T_table_sensor;  ///< pose of this very frame; takes precedence over the angle
  std::string file;                    ///< relative to the sequence's folder
  FrameStatus status = FrameStatus::kOk;
};

/// Why no frame has this time, angle or pose: not finite, or beyond 1e13 s, a million turns,
/// kMaxDistance_m. Empty when they are plausible.
std::string implausible(const FrameInfo& info);

/// A depth image, or points (then depth is empty).
struct Frame {
  FrameInfo info;
  DepthImage depth;
  PointCloud points;   ///< sensor frame
  int grid_width = 0;  ///< of organised points, else 0
  int grid_height = 0;
  std::vector<std::int32_t> grid;  ///< cell -> position in points, -1 where empty; row by row
  ColorImage color;                ///< may be empty
  /// The colour image as its source packed it, where that is a JPEG file that decodes to color;
  /// else empty. A recording takes it as it is: packing it again would cost time and lose some.
  std::string color_jpeg;
};

/// The one view that both kinds of frames offer. Sensor frame, metres.
struct FramePoints {
  PointCloud cloud;  ///< colours if there are any
  int width = 0;     ///< 0 where there is no grid
  int height = 0;
  std::vector<std::int32_t> cell;  ///< per point its cell (row * width + column); empty: no grid
  Viewpoint viewpoint;
};

/// Valid returns of a frame as points, in the order of cells. Takes colour where it is registered
/// (same size as depth), or projects each point into the colour camera; black where that does not
/// see it. Pixels kNoReturn and kOutsideCrop and points that are not finite or not in front of a
/// depth camera are left out. rays must fit the intrinsics.
/// Fails with kFormat when sizes do not fit.
Result<FramePoints> points_of(const Frame& frame, const SensorInfo& sensor, const RayTable& rays);

struct SequenceHeader {
  std::vector<SensorInfo> sensors;
  std::optional<TurntableInfo> turntable;
  std::string software;  ///< what wrote it
  std::string source;    ///< for people: where the data come from; may be empty
  /// Frames' own poses bring together the frames of a pass only; else those of all passes.
  bool poses_within_pass = false;
};

/// Frames in the order of their indices. read() may be called from several threads at once.
class FrameSequence {
 public:
  virtual ~FrameSequence() = default;
  virtual const SequenceHeader& header() const = 0;
  virtual const std::vector<FrameInfo>& frames() const = 0;
  /// The frame at a position in frames(). Fails when its data are missing or damaged.
  virtual Result<Frame> read(std::size_t position) const = 0;
};

}  // namespace turnscan
