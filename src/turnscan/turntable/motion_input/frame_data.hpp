#pragma once
// Data that calibration from motion keeps of each frame: a few hundred surface samples with
// normals, and for key frames the object's surface, with which samples of other frames are
// compared.

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
  std::vector<float> z;                          ///< metres; 0 if there is no foreground
  /// Mask of the pixels within outlines; only for raw surfaces that have outlines.
  std::vector<std::uint8_t> inner;
  /// Mask of the pixels that see something nearer than the axis outside the foreground's cylinder,
  /// such as an end of an object wider than its platter; for key frames whose foreground is a
  /// cylinder.
  std::vector<std::uint8_t> covered;
  KdTree tree;
  std::vector<Vec3f> points;
  /// For a depth image of a levelled frame: maps from the frame of the other members to the
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
  double inner_share = 1.0;  ///< share of the foreground's pixels that drop_outline() keeps
  std::optional<PlatterObservation> platter;  ///< if it is seen; for depth images
};

struct MotionData {
  CameraIntrinsics camera;
  bool projective = true;           ///< depth images; else points
  std::vector<MotionFrame> frames;  ///< usable ones of sensor 0, in order
  std::vector<std::size_t> keys;    ///< positions in frames
  double noise_m = 0.0;             ///< standard deviation of one depth value
  /// Neighbouring pixels share noise (SpatialNoise): surfaces then have no outlines, where such a
  /// sensor mixes depths.
  bool correlated_noise = false;
  /// Mean over the frames; 1 if surfaces keep their outlines.
  double inner_share = 1.0;
  double spacing_m = 0.0;  ///< between neighbouring pixels on the object
  std::optional<DetectedPlatter> platter;
  Vec3d middle = Vec3d::Zero();       ///< of the foreground's points
  double extent_m = 0.1;              ///< twice the root mean square distance from the middle
  Vec3d to_sensor = -Vec3d::UnitZ();  ///< from the middle, unit
  std::vector<Vec3f> cloud;           ///< a subset of the foreground's points
  std::vector<std::string> notes;

  /// Distance within which a point belongs to another frame's surface while the alignment is still
  /// rough: surfaces may be a step apart, but must not be confused.
  double inlier_gate_m() const { return std::max(3.0 * noise_m, 0.004); }

  /// The point of a surface that corresponds to p (sensor frame): on the ray through p in a depth
  /// image (projective data association), the nearest point in a point cloud. False if there is
  /// none within reach_m.
  bool find_correspondence(const FrameSurface& surface, const Vec3d& p, double reach_m,
                           Vec3d& found) const;
  /// Whether all pixels that find_correspondence uses for p are inner ones. Preconditions: it finds
  /// p's correspondence, and surface.inner is set.
  bool within_outline(const FrameSurface& surface, const Vec3d& p) const;

 private:
  bool find_in_image(const FrameSurface& surface, const Vec3d& p, double reach_m,
                     Vec3d& found) const;
};

struct MotionDataOptions {
  DetectOptions detect;
  std::size_t max_keys = 160;
  std::optional<TurntableInfo> hint;  ///< used if no platter is seen
  bool use_platter = true;            ///< false: do not detect one
  bool sights = false;                ///< observe the platter in each frame
  bool level = false;                 ///< compensate the tilt of a wobbling platter in all frames
  PlatterMemory* memory = nullptr;    ///< kept by the caller; nullptr: detect the platter
};

/// Reads the frames. A round surface on which nothing is seen to stand is not a platter, and is
/// removed from the memory. Fails with kTooFewPoints if fewer than 3 frames are usable or nothing
/// turns in them, with kCancelled, and with the errors of reading.
Result<MotionData> load_motion(const FrameSequence& sequence, const MotionDataOptions& options,
                               const RunContext& context);

}  // namespace turnscan::motion
