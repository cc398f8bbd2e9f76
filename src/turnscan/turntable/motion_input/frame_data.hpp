#pragma once
// What calibration from motion keeps of each frame: a few hundred surface samples with normals, and
// of key frames the surface of the object that other frames' samples are compared with.

#include <memory>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/turntable/motion_input/platter_sight.hpp>
#include <vector>

namespace turnscan::motion {

/// Sensor frame, metres.
struct SurfaceSample {
  Vec3f p, n;
  float normal_sigma;  ///< standard deviation of the normal's direction, radians
};

/// Part of a depth image, or points with a tree.
struct FrameSurface {
  int left = 0, top = 0, width = 0, height = 0;  ///< pixels
  std::vector<float> z;                          ///< metres; 0 where there is no foreground
  /// Pixels within outlines; of raw surfaces that have outlines.
  std::vector<std::uint8_t> inner;
  /// Pixels that see something nearer than the axis outside the foreground's cylinder, as an end of
  /// an object that is wider than its platter; of key frames whose foreground is a cylinder.
  std::vector<std::uint8_t> covered;
  KdTree tree;
  std::vector<Vec3f> points;
  /// Of a depth image of a frame that was levelled: from the frame in which all else is to the
  /// camera's.
  std::optional<Pose> T_camera_level;

  bool empty() const { return z.empty() && points.empty(); }
};

struct MotionFrame {
  std::size_t position = 0;  ///< in the sequence
  double time_s = 0.0;       ///< NaN: unknown
  std::optional<double> nominal_rad;
  std::uint32_t pass = 0;
  std::vector<SurfaceSample> samples;
  FrameSurface surface;      ///< smoothed; empty unless a key frame
  FrameSurface raw_surface;  ///< of depth images: not smoothed, without mixed pixels
  double inner_share = 1.0;  ///< of the foreground's pixels, those that drop_outline() leaves
  std::optional<PlatterObservation> platter;  ///< where it is seen; of depth images
};

struct MotionData {
  CameraIntrinsics camera;
  bool projective = true;           ///< depth images; else points
  std::vector<MotionFrame> frames;  ///< usable ones of sensor 0, in order
  std::vector<std::size_t> keys;    ///< positions in frames
  double noise_m = 0.0;             ///< standard deviation of one depth value
  /// Neighbouring pixels share noise (SpatialNoise): surfaces have no outlines then, where such a
  /// sensor mixes what it sees.
  bool correlated_noise = false;
  /// Mean of the frames; 1 where surfaces keep their outlines.
  double inner_share = 1.0;
  double spacing_m = 0.0;  ///< between neighbouring pixels on the object
  std::optional<DetectedPlatter> platter;
  Vec3d middle = Vec3d::Zero();       ///< of the foreground's points
  double extent_m = 0.1;              ///< twice the root mean square distance from the middle
  Vec3d to_sensor = -Vec3d::UnitZ();  ///< from the middle, unit
  std::vector<Vec3f> cloud;           ///< a subset of the foreground's points
  std::vector<std::string> notes;

  /// Distance within which a point belongs to another frame's surface while the alignment is still
  /// rough: surfaces may be a step apart, but must not be taken for others.
  double inlier_gate_m() const { return std::max(3.0 * noise_m, 0.004); }

  /// The point of a surface that corresponds to p (sensor frame): on the ray through p in a depth
  /// image (projective data association), the nearest one among points. False where there is none
  /// within reach_m.
  bool find_correspondence(const FrameSurface& surface, const Vec3d& p, double reach_m,
                           Vec3d& found) const;
  /// Whether all pixels that find_correspondence uses for p, which it finds, are inner ones.
  /// Precondition: surface.inner is set.
  bool within_outline(const FrameSurface& surface, const Vec3d& p) const;

 private:
  bool find_in_image(const FrameSurface& surface, const Vec3d& p, double reach_m,
                     Vec3d& found) const;
};

struct MotionDataOptions {
  DetectOptions detect;
  std::size_t max_keys = 160;
  std::optional<TurntableInfo> hint;  ///< used where no platter is seen
  bool use_platter = true;            ///< false: do not look for one
  bool sights = false;                ///< tell how each frame shows the platter
  bool level = false;                 ///< take the tilt of a platter that wobbles out of all frames
  PlatterMemory* memory = nullptr;    ///< kept by the caller; nullptr: look for it
};

/// Reads the frames. A round surface on which nothing is seen to stand is no platter, and forgotten
/// in the memory. Fails with kTooFewPoints when fewer than 3 frames can be used or nothing
/// turns in them, kCancelled, and what reading fails with.
Result<MotionData> load_motion(const FrameSequence& sequence, const MotionDataOptions& options,
                               const RunContext& context);

/// At most `most` (2 or more) of a list, evenly spread, with the first and the last.
std::vector<std::size_t> spread_subset(std::vector<std::size_t> list, std::size_t most);

}  // namespace turnscan::motion
