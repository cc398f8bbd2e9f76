#pragma once
// Virtual scanners that look at objects on a turntable. To the rest of turnscan it is a recording
// like any other.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/simulator/noise/noise.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <turnscan/simulator/scanner/scanner_model.hpp>
#include <turnscan/simulator/scene/rig.hpp>
#include <turnscan/simulator/scene/room.hpp>
#include <turnscan/simulator/scene/scene.hpp>
#include <turnscan/simulator/scene/turntable_motion.hpp>
#include <vector>

namespace turnscan {

struct VirtualScanner {
  ScannerModel model;
  ScannerPlacement placement;
};

struct PlatterOptions {
  bool visible = true;
  double radius_m = 0.15;
  double thickness_m = 0.0;  ///< 0: a disc
};

OptionTable describe(PlatterOptions& options);

struct MeasureOptions {
  std::string noise = "gaussian:1.5mm";  ///< see parse_noise_options
  double mixed_pixels = 0.0;             ///< share of the silhouette's pixels, 0 to 1
  double mixed_reach_m = 0.08;           ///< how far behind the edge they may lie
  int seed = 1;
};

OptionTable describe(MeasureOptions& options);

enum class RecordedCalibration {
  kTrue,     ///< where the turntable is
  kNominal,  ///< where it was meant to be: without TablePlacement
  kNone      ///< neither turntable nor poses
};

/// What the recording says beside the frames.
struct RecordOptions {
  RecordedCalibration calibration = RecordedCalibration::kTrue;
  bool angles = true;
  bool color = false;  ///< a colour image with each depth image, registered to it
  int pass = 0;
};

OptionTable describe(RecordOptions& options);

struct VirtualScanOptions {
  std::vector<VirtualScanner> scanners;
  MotionOptions motion;
  PlatterOptions platter;
  TablePlacement table;
  RoomOptions room;
  MeasureOptions measure;
  RecordOptions record;
  std::uint32_t first_instant = 0;  ///< of the random numbers; see VirtualPasses
};

/// All about one frame that the recording does not say. Of the arrays of exact, hits has the same
/// places; it says something where exact.hit(). A hit's p_body and normal_body are in the table's
/// frame at angle 0 for body 0 (objects and platter), in the world's for body 1 (the room).
struct TrueSamples {
  std::uint32_t scanner = 0;
  SampleGrid exact;       ///< without noise
  MeasuredGrid measured;  ///< what is recorded (before it is rounded), or why nothing is
  std::vector<SampleHit> hits;
};

/// All scanners take a frame at each instant; in the sequence the frames of one instant follow each
/// other in the order of the scanners. The object and the platter turn, scanners and room stay
/// (but for a scanner's travel): at the angle a of a frame
///   p_world = T_world_table * wobble(a) * Ry(a) * p_table.
///
/// The table's frame is the one that the turntable's axis and centre give to scanner 0 at the first
/// frame (thesis eq. 3.10), so that a calibration finds it again: scanner 0 is at x = 0 on the side
/// of -Z. The objects stand as given while it is there with azimuth and aim 0 and the table in
/// its place; else they are turned with it.
///
/// Depth is along z in steps of the scanner's depth unit, rounded, 0 where no sample counts. Line
/// scanners give points. Each value is a function of (seed, scanner, frame, sample) alone.
class VirtualScan : public FrameSequence {
 public:
  /// objects: platter at angle 0. Fails with kInvalidOption when an option is out of range or there
  /// are no or more than 64 scanners, and as Scene::create does.
  static Result<VirtualScan> create(std::vector<TriangleMesh> objects,
                                    const VirtualScanOptions& options);
  VirtualScan(VirtualScan&&) noexcept;
  VirtualScan& operator=(VirtualScan&&) noexcept;
  ~VirtualScan() override;

  const SequenceHeader& header() const override;
  const std::vector<FrameInfo>& frames() const override;
  /// Rendered anew at each call, on the calling thread.
  Result<Frame> read(std::size_t position) const override;

  /// How many samples of a scanner were taken so far, by what became of them: position i counts
  /// Miss(i) of samples.hpp. Every call of read() adds to it.
  std::array<std::uint64_t, kMissCount> tally(std::size_t scanner) const;

  // The truth.
  /// Every sample of a frame, also of a dropped one. Fails with kNotFound.
  Result<TrueSamples> samples(std::size_t position) const;
  /// In the table's frame, at angle 0.
  std::span<const TriangleMesh> objects() const;
  /// Objects, then the body of the platter if it has a thickness; table frame.
  const Scene& scene() const;
  /// Takes the points of a frame to the table's frame at angle 0: everything included.
  Pose T_table_sensor(std::size_t position) const;
  double angle_rad(std::size_t position) const;
  /// In the frame of scanner 0 at the first frame.
  const TurntableInfo& turntable() const;
  /// What does not turn, in the world's frame; nullptr without a room.
  const Scene* room() const;
  Pose T_table_world(std::size_t position) const;
  /// Height of the point that scanners without one of their own look at; world.
  double aim_height_m() const;
  /// About the y axis, from the objects as they were given to objects().
  Pose T_table_given() const;

 private:
  struct Impl;
  explicit VirtualScan(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace turnscan
