#pragma once
// A truncated signed distance field (TSDF) around the observed surface, in bricks of samples.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/grid/grid_index.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::tsdf {

struct Foot;

/// A platter on which the object lay in one of several passes, in the object's frame.
struct Platter {
  Vec3d up = Vec3d::UnitY();  ///< unit vector
  double offset_m = 0.0;
  /// Height of a point above it.
  double above(const Vec3d& p) const { return up.dot(p) - offset_m; }
};
Platter platter_of(const Pose& T_object_table);

/// Largest depth of a point below any of the platters; negative if it is above all of them.
double below_platters(std::span<const Platter> platters, const Vec3d& p);

struct VolumeScale {
  double cell_m = 0.001;  ///< the voxel size: distance between samples
  /// Along its ray, a measurement affects samples up to this far before and behind it.
  double truncation_m = 0.005;
  /// Up to this far behind it with full weight; from there to the truncation distance the weight
  /// falls to 0.
  double full_weight_behind_m = 0.003;
  float edge_weight = 0.1f;          ///< of measurements beside an edge
  std::optional<Cylinder> cylinder;  ///< the region that is reconstructed
  std::optional<double> floor_m;     ///< on a platter: lowest height at which samples are used
  /// With several passes: nothing of the object is below any of them. Then there is no cylinder.
  std::vector<Platter> platters;
  std::size_t max_bytes = std::size_t(600) << 20;
};

/// Samples at origin + cell * (i, j, k), in bricks of 8^3 that exist only where a surface may be.
/// Negative is inside.
class Volume {
 public:
  Vec3d origin_m = Vec3d::Zero();
  double cell_m = 0.0;
  double truncation_m = 0.0;
  GridIndex bricks;
  std::vector<std::int32_t> slot;  ///< per brick: index of its samples, or -1
  std::vector<float> uniform;      ///< per brick without samples: +1 free, -1 inside, 0 unknown
  std::vector<float> value;        ///< 512 per slot, metres
  std::vector<float> weight;       ///< 512 per slot; 0: unknown

  /// Sets the number of bricks along each axis; none has samples, all are unknown.
  void set_bricks(const GridCoords& size);
  std::size_t brick_count() const { return slot.size(); }
  Vec3d position(int i, int j, int k) const { return origin_m + cell_m * Vec3d(i, j, k); }
  std::size_t slots() const { return value.size() / kBrickSamples; }
  /// Position of a brick's first sample in value and weight; the brick must have samples.
  std::size_t first_sample(std::size_t brick) const {
    return std::size_t(slot[brick]) * kBrickSamples;
  }
  /// Gives a brick samples, all equal to `start` with weight 0.
  void allocate(std::size_t brick, float start);
  /// The bricks with samples, in ascending order.
  std::vector<std::size_t> allocated_bricks() const;
};

/// Averages known samples with their known neighbours, by their weights. Fails with kCancelled, and
/// then leaves the volume as it was after the last complete round.
Result<> smooth(Volume& volume, int rounds, const RunContext& context);

/// Decides unobserved samples by the harmonic function that continues the known ones, positive
/// beyond the volume; below the floor of a platter the walls continue downwards and end flat at y =
/// 0, except where the bottom is round. With several passes, only what none of them observed ends
/// on a platter, and flat. Enclosed free spaces that do not reach the outside are filled. Fails
/// with kCancelled, and then leaves the volume partly processed.
Result<> close_holes(Volume& volume, const VolumeScale& scale, const Foot& foot,
                     const RunContext& context);

/// The first layer of samples that is used above a platter.
int floor_layer(const Volume& volume, double floor_m);

/// Converts to the input of isosurface(). Fails as BrickGrid does.
Result<BrickGrid> to_grid(const Volume& volume, std::size_t max_bytes);

}  // namespace turnscan::tsdf
