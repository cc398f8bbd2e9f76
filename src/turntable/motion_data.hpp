#pragma once
// What calibration from motion keeps of each frame: a few hundred points with normals, and of key
// frames the depth image about the object. Internal to turntable: not installed.

#include <memory>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/knn.hpp>
#include <turnscan/turntable/detect.hpp>
#include <turnscan/turntable/plane_fit.hpp>
#include <vector>

namespace turnscan::detail {

/// Sensor frame, metres.
struct MotionSample {
  Vec3f p, n;
  float normal_sigma;  ///< standard deviation of the normal's direction, radians
};

/// Part of a depth image, or points with a tree.
struct MotionView {
  int left = 0, top = 0, width = 0, height = 0;
  std::vector<float> z;  ///< 0 where there is no foreground
  KdTree tree;
  std::vector<Vec3f> points;

  bool empty() const { return z.empty() && points.empty(); }
};

struct MotionFrame {
  std::size_t position = 0;  ///< in the sequence
  double time_s = 0.0;       ///< NaN: unknown
  std::optional<double> nominal_rad;
  std::uint32_t pass = 0;
  std::vector<MotionSample> samples;
  MotionView view;  ///< smoothed; empty unless a key frame
  MotionView raw;   ///< of depth images: as it was seen, without pixels mixed of two surfaces
};

struct MotionData {
  CameraIntrinsics camera;
  bool projective = true;           ///< depth images; else points
  std::vector<MotionFrame> frames;  ///< usable ones of sensor 0, in order
  std::vector<std::size_t> keys;    ///< positions in frames
  double noise_m = 0.0;             ///< of one depth value
  double spacing_m = 0.0;           ///< between neighbouring pixels on the object
  std::optional<DetectedPlatter> platter;
  Vec3d middle = Vec3d::Zero();       ///< of the foreground's points
  double extent_m = 0.1;              ///< twice the root mean square distance from there
  Vec3d to_sensor = -Vec3d::UnitZ();  ///< from there, unit
  std::vector<Vec3f> cloud;           ///< some of the foreground's points, for its lowest ones
  std::vector<std::string> notes;

  /// The place of a key frame's surface that a point of the same ray or the nearest one meets.
  bool look_up(const MotionView& view, const Vec3d& p, double reach_m, Vec3d& found) const;
};

/// What belongs to the turning object in a pixel.
struct Foreground {
  std::optional<Plane> plane;  ///< keep what is above it by margin, within radius of center
  Vec3d center = Vec3d::Zero();
  double margin_m = 0.0, radius_m = 0.0;
  std::vector<std::uint8_t> mask;  ///< without a plane: pixels, and the largest depth
  float farthest_m = 0.0f;
  int left = 0, top = 0, right = 0, bottom = 0;  ///< pixels that can be foreground

  bool holds(std::size_t pixel, const Vec3f& p) const;
};

struct MotionDataOptions {
  DetectOptions detect;
  std::size_t most_keys = 160;
  std::optional<TurntableInfo> hint;  ///< used where no platter is seen
};

/// Reads the frames. Fails with kTooFewPoints when fewer than 3 frames can be used or nothing
/// turns in them, kCancelled, and what reading fails with.
Result<MotionData> load_motion(const FrameSequence& sequence, const MotionDataOptions& options,
                               const RunContext& context);

}  // namespace turnscan::detail
