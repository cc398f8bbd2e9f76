#pragma once
// Turntables with a known place in a room, seen by a noisy depth camera: the truth that
// calibration is judged by.

#include <functional>
#include <memory>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::testing {

/// Angle of the platter at a time in seconds; 0 at time 0.
using AngleLaw = std::function<double(double time_s)>;

struct RigOptions {
  double distance_m = 0.9, elevation_rad = 0.5, roll_rad = 0.0, aim_height_m = 0.0;
  double aim_x_m = 0.0, aim_z_m = 0.0;
  double radius_m = 0.15;
  bool platter = true;
  bool room = true;           ///< desk, wall
  bool drum = true;           ///< sides of the platter, down to the desk; of a room
  int clutter = 0;            ///< things that stand about
  double desk_m = 0.03;       ///< how far the desk lies below the platter
  double noise_m = 0.0015;    ///< standard deviation of depth
  double mixed_pixels = 0.5;  ///< share of silhouette pixels
  std::uint64_t seed = 1;
  int frames = 30;
  int shrink = 1;  ///< the camera has 512 / shrink by 424 / shrink pixels
  double fps = 30.0;
  AngleLaw angle;                     ///< none: stands still
  std::vector<TriangleMesh> objects;  ///< table frame, angle 0
};

/// The random rig: 0.6 to 1.2 m away, 10 to 50 deg up, radius 10 to 25 cm, roll to 10 deg.
RigOptions random_rig(std::uint64_t seed);

/// A small camera 0.6 m from a platter that turns evenly, `frames` of so many turns at one a
/// second.
RigOptions near_rig(int frames, double turns);

/// Frames have times; the header has no turntable and the frames no angles.
class Rig : public FrameSequence {
 public:
  explicit Rig(RigOptions options);
  ~Rig() override;
  const SequenceHeader& header() const override;
  const std::vector<FrameInfo>& frames() const override;
  Result<Frame> read(std::size_t position) const override;

  /// The truth: axis, centre, radius in the sensor frame.
  TurntableInfo truth() const;
  double true_angle(std::size_t position) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan::testing
