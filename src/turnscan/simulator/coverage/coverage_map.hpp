#pragma once
// How well a scan covers the parts of an object, which it misses, and why: from the samples of
// every frame, counted on the surface.

#include <array>
#include <cstdint>
#include <span>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <vector>

namespace turnscan {

struct CoverageMapOptions {
  double cell_m = 3e-3;       ///< size of the patches and cells of the surface
  double thin_per_mm2 = 0.5;  ///< a density below this is thin
  int holes = 10;             ///< number of the largest holes that are listed
  bool noise = false;         ///< ignore samples that the noise model would drop
};

OptionTable describe(CoverageMapOptions& options);

/// A frame of the scan.
struct CoveragePose {
  std::uint32_t scanner = 0;               ///< index in the scanners
  Pose T_table_sensor = Pose::Identity();  ///< the platter's rotation compensated
  Pose T_table_room = Pose::Identity();    ///< of the room, if there is one
  std::uint32_t pass = 0;                  ///< 0, or index in the further passes, plus one
};

/// Pose of the objects in another pass: the same meshes, moved rigidly.
struct CoveragePass {
  const Scene* scene = nullptr;          ///< table frame of this pass
  Pose T_first_pass = Pose::Identity();  ///< maps its table frame to that of the first pass, so
                                         ///< that the objects coincide
};

enum class CoverageState : std::uint8_t {
  kCovered,
  kThin,        ///< covered, but with a density below thin_per_mm2
  kMissed,      ///< no sample, though visible from outside at the scanners' heights
  kUnreachable  ///< no sample, and not visible from anywhere at these heights and distance
};
inline constexpr std::size_t kCoverageStateCount = 4;

/// "covered", "thin", "missed", "unreachable".
std::string_view name_of(CoverageState state);

/// The surface within a cube of cell_m that faces the same of the six directions along the axes;
/// slivers that a cube cuts off belong to a neighbour.
struct CoverageCell {
  double area_m2 = 0.0;
  Vec3d center = Vec3d::Zero();  ///< of its surface; table frame
  std::uint32_t samples = 0;
  std::uint32_t views = 0;          ///< frames with a sample here
  double best_incidence_rad = 0.0;  ///< of its samples; 90 deg without any
  double best_sigma_m = 0.0;        ///< predicted, of a single sample; NaN without any
  CoverageState state = CoverageState::kCovered;
  Miss reason = Miss::kNone;         ///< for missed and unreachable ones, see coverage_map
  std::uint32_t hole = 0xffffffffu;  ///< index in CoverageMap::holes, if it is listed

  double density_per_mm2() const { return area_m2 > 0.0 ? samples / (1e6 * area_m2) : 0.0; }
};

/// A face of the mesh, or a part of one that is larger than cell_m.
struct CoveragePatch {
  std::array<Vec3f, 3> corners;
  std::uint32_t object = 0, face = 0;
  std::uint32_t cell = 0;     ///< that contains its centre
  std::uint32_t samples = 0;  ///< in the patch itself; the cell's density is less noisy
};

/// A connected set of cells without samples.
struct CoverageHole {
  double area_m2 = 0.0;
  Vec3d center = Vec3d::Zero();  ///< of its surface; table frame
  Vec3d size_m = Vec3d::Zero();  ///< of its bounding box
  Miss reason = Miss::kNone;     ///< the reason of the largest part of its area
  double unreachable_m2 = 0.0;   ///< part of its area
};

struct CoverageMap {
  std::vector<CoveragePatch> patches;  ///< in the order of objects and faces
  std::vector<CoverageCell> cells;
  std::vector<CoverageHole> holes;  ///< the largest first
  double area_m2 = 0.0;
  std::array<double, kCoverageStateCount> state_m2{};
  std::array<double, kMissCount> reason_m2{};  ///< of the area without samples
  std::uint64_t samples = 0;                   ///< on the objects
  std::size_t hole_count = 0;                  ///< of all holes
  double cell_m = 0.0;                         ///< as used, see coverage_map

  /// Share of the area with samples, thin or not, 0 to 1.
  double covered() const;
  /// The same relative to the area that is not unreachable.
  double covered_of_reachable() const;
};

/// scene: table frame, platter at angle 0; its first objects are `objects`, whose surface is
/// counted; everything else in it only occludes. Vertex colours give the albedo, 0.8 without.
///
/// A cell without a sample is examined at its largest patch. Of the frames whose sensor is on its
/// side (at most about 64 of a matrix scanner; for a line scanner those whose line passes over it),
/// the one that came farthest gives the reason: out of view, out of range, grazing, first eye
/// blocked (that of the rays), other eye blocked. Without such a frame: receiver blocked, by the
/// object itself. A cell that such a frame does see is between the samples and is thin. It is
/// unreachable if it is not visible from 48 directions around the table within the scanners'
/// largest incidence, from their greatest distance and from their lowest height to their highest.
/// incidence, from their greatest distance and from their lowest height to their highest.
/// room: static surroundings, in a frame of their own; they occlude, too, but are ignored for what
/// is unreachable, since elsewhere they may not be in the way.
///
/// further_passes: the map is that of all passes together, in the table frame of the first. A pass
/// reaches what is visible from any point around its table.
///
/// cell_m is enlarged if there would be more than 4 million patches. The result does not depend on
/// the number of threads. Fails with kInvalidOption (options, no scanner, a pose of a scanner or
/// pass that does not exist), kTooFewPoints (objects without a face) and kCancelled.
Result<CoverageMap> coverage_map(const Scene& scene, std::span<const TriangleMesh> objects,
                                 std::span<const ScannerModel> scanners,
                                 std::span<const CoveragePose> poses,
                                 const CoverageMapOptions& options, const RunContext& context,
                                 const Scene* room = nullptr,
                                 std::span<const CoveragePass> further_passes = {});

/// The patches, each with its own corners, coloured: covered from blue over green to yellow by the
/// logarithm of density (from thin_per_mm2 to 256 times that), thin orange, missed red, unreachable
/// grey.
TriangleMesh coverage_mesh(const CoverageMap& map, const CoverageMapOptions& options);

}  // namespace turnscan
