#pragma once
// Frames of depth sensors, and sequences of them. A recording, a data set of another program, the
// simulator and a device all offer sequences of frames.

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

/// The position of the sensor, in the sensor frame; for scanners whose rays are parallel, the
/// direction towards it.
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
  std::string model;                   ///< a name to show, e.g. "kinect-v2"; may be empty
  CameraIntrinsics intrinsics;         ///< depth cameras only
  double depth_unit_m = 1e-4;          ///< metres per step of the raw depth
  double depth_bias_m = 0.0;           ///< added to each depth after scaling
  std::optional<Pose> T_table_sensor;  ///< with the platter at angle 0
  Viewpoint viewpoint;                 ///< sensor frame; depth cameras: the origin
  /// The colour camera, if colour images are not registered to depth; T_color_sensor is its pose.
  std::optional<CameraIntrinsics> color_intrinsics;
  Pose T_color_sensor = Pose::Identity();
};

/// The turntable in the frame of sensor 0.
struct TurntableInfo {
  Vec3d axis = Vec3d::UnitY();        ///< unit vector, up
  Vec3d center_m = Vec3d::Zero();     ///< on the platter's surface
  std::optional<double> radius_m;     ///< of the platter
  std::optional<double> speed_rad_s;  ///< signed, counter-clockwise seen from above is positive
  /// If no platter was seen: the largest distance from the axis at which something rotated.
  std::optional<double> reach_m;
};

enum class FrameStatus { kOk, kDropped };

struct FrameInfo {
  std::uint32_t index = 0;                                   ///< unique in a sequence
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unknown
  std::uint32_t sensor = 0;
  std::uint32_t pass = 0;  ///< counts the poses in which the object was laid
  std::uint32_t turn = 0;
  std::uint32_t stretch = 0;  ///< how often it had been resumed; the turn in between is unknown
  std::optional<double> angle_rad;     ///< how far the platter has turned since the first frame
  std::optional<Pose> T_table_sensor;  ///< pose of this very frame; takes precedence over the angle
  std::string file;                    ///< relative to the sequence's folder
  FrameStatus status = FrameStatus::kOk;
};

/// What is implausible about the time, angle or pose: not finite, or beyond 1e13 s, a million turns
/// or kMaxDistance_m. Empty when all are plausible.
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

/// The points of a frame of either kind. Sensor frame, metres.
struct FramePoints {
  PointCloud cloud;  ///< colours if there are any
  int width = 0;     ///< 0 where there is no grid
  int height = 0;
  std::vector<std::int32_t> cell;  ///< per point its cell (row * width + column); empty: no grid
  Viewpoint viewpoint;
};

/// Valid returns of a frame as points, ordered by cell. Registered colour (of depth's size) is
/// taken from the pixel; else points are projected into the colour camera, and black outside its
/// image. Pixels kNoReturn and kOutsideCrop and points that are not finite or not in front of a
/// depth camera are left out. rays must fit the intrinsics.
/// Fails with kFormat when sizes do not fit.
Result<FramePoints> points_of(const Frame& frame, const SensorInfo& sensor, const RayTable& rays);

struct SequenceHeader {
  std::vector<SensorInfo> sensors;
  std::optional<TurntableInfo> turntable;
  std::string software;  ///< what wrote it
  std::string source;    ///< where the data come from, to show; may be empty
  /// Whether the frames' own poses are consistent within a pass only, and not across passes.
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
