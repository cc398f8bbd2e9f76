#pragma once
// Virtual scanners that look at objects on a turntable. To the rest of turnscan it is a recording
// like any other.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <turnscan/simulator/virtual_scan_options.hpp>
#include <vector>

namespace turnscan {

/// Kind of a body of TrueSamples, and the frame of the points on it.
enum class BodyKind : std::uint8_t {
  kObjects,  ///< including the platter, unless the objects move on it; the table's frame at angle 0
  kRoom,     ///< the world's frame
  kPlatterAlone,  ///< the table's frame at angle 0
  kHand           ///< the world's frame
};

/// Ground truth of one frame, which the recording does not contain. hits has the same indices as
/// the arrays of exact, and is valid where exact.hit(). p_body and normal_body of a hit are in the
/// frame of its body.
struct TrueSamples {
  std::uint32_t scanner = 0;
  std::vector<BodyKind> bodies;  ///< by exact.body()
  SampleGrid exact;              ///< without noise
  MeasuredGrid measured;         ///< recorded values (before rounding), or why there is none
  std::vector<SampleHit> hits;
};

/// All scanners take a frame at each instant; in the sequence the frames of one instant follow each
/// other in the order of the scanners. The object and the platter turn, scanners and room are
/// static (except for a scanner's travel and a knock): at the angle a of a frame
///   p_world = T_world_table * wobble(a) * Ry(a) * p_table,
/// where wobble includes the runout. Objects that move on the platter are mapped back to their
/// initial position: p_table of their points does not change.
///
/// The table's frame is the one that the turntable's axis and centre determine for scanner 0 at the
/// first frame (thesis eq. 3.10), so that a calibration finds it again: scanner 0, not yet knocked,
/// is at x = 0 on the side of -Z. The objects stand as given if it has azimuth and aim 0 and the
/// table its nominal placement; otherwise they are rotated with it.
///
/// Depth is along z in steps of the scanner's depth unit, rounded, 0 if no sample counts. Line
/// scanners deliver points. Each value is a function of (seed, scanner, frame, sample) alone.
class VirtualScan : public FrameSequence {
 public:
  /// objects: platter at angle 0. Fails with kInvalidOption if an option is out of range or there
  /// are no or more than 64 scanners, and as Scene::create does.
  static Result<VirtualScan> create(std::vector<TriangleMesh> objects,
                                    const VirtualScanOptions& options);
  VirtualScan(VirtualScan&&) noexcept;
  VirtualScan& operator=(VirtualScan&&) noexcept;
  ~VirtualScan() override;

  const SequenceHeader& header() const override;
  const std::vector<FrameInfo>& frames() const override;
  /// Rendered anew in each call, on the calling thread.
  Result<Frame> read(std::size_t position) const override;

  /// Number of samples of a scanner taken so far, by outcome: index i counts Miss(i) of
  /// samples.hpp. Every call of read() adds to it.
  std::array<std::uint64_t, kMissCount> tally(std::size_t scanner) const;

  // Ground truth.
  /// Every sample of a frame, also of a dropped one. Fails with kNotFound.
  Result<TrueSamples> samples(std::size_t position) const;
  /// In the table's frame, at angle 0.
  std::span<const TriangleMesh> objects() const;
  /// Objects, then the body of the platter if it has a thickness; table frame.
  const Scene& scene() const;
  /// Maps the points of a frame, those on the objects, to the table's frame at angle 0, with
  /// everything included. The recording itself contains no knock and no move.
  Pose T_table_sensor(std::size_t position) const;
  double angle_rad(std::size_t position) const;
  /// In the frame of scanner 0 at the first frame, before it is knocked.
  const TurntableInfo& turntable() const;
  /// Static surroundings, in the world's frame; nullptr without a room.
  const Scene* room() const;
  /// Maps the world's frame to the table's, which follows the objects as in T_table_sensor.
  Pose T_table_world(std::size_t position) const;
  /// Height of the point at which scanners without an aim height of their own look; world.
  double aim_height_m() const;
  /// Rotation about the y axis from the objects as given to objects().
  Pose T_table_given() const;

 private:
  struct Impl;
  explicit VirtualScan(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
