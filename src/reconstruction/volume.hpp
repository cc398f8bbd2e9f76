#pragma once
// Signed distances around what the views saw, in bricks of samples. Internal to the volumetric
// method.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/isosurface.hpp>
#include <turnscan/reconstruction/depth_view.hpp>
#include <turnscan/reconstruction/field_kernel.hpp>
#include <turnscan/turntable/crop.hpp>

namespace turnscan {

struct VolumeScale {
  double cell_m = 0.001;
  double truncation_m = 0.005;       ///< measurements farther than this from a sample say nothing
  double behind_m = 0.003;           ///< beyond this behind a surface they fade
  float edge_weight = 0.1f;          ///< of measurements beside an edge
  std::optional<Cylinder> cylinder;  ///< what counts
  std::optional<double> floor_m;     ///< on a platter: lowest height at which samples are looked up
  std::size_t max_bytes = std::size_t(600) << 20;
};

/// Samples at origin + cell * (i, j, k), in bricks of 8^3 that exist only where a surface may be.
/// Negative is inside.
class Volume {
 public:
  static constexpr int kSide = 8;
  using Index = std::array<int, 3>;

  Vec3d origin_m = Vec3d::Zero();
  double cell_m = 0.0;
  double truncation_m = 0.0;
  Index bricks{};                  ///< along each axis
  std::vector<std::int32_t> slot;  ///< per brick: number of its samples, or -1
  std::vector<float> uniform;      ///< per brick without samples: +1 clear, -1 inside, 0 unknown
  std::vector<float> value;        ///< 512 per slot, metres
  std::vector<float> weight;       ///< 512 per slot; 0: unknown

  std::size_t brick_count() const { return slot.size(); }
  std::size_t brick_index(const Index& b) const {
    return std::size_t(b[0]) + std::size_t(bricks[0]) *
                                   (std::size_t(b[1]) + std::size_t(bricks[1]) * std::size_t(b[2]));
  }
  Index brick_at(std::size_t brick) const {
    const auto nx = std::size_t(bricks[0]), ny = std::size_t(bricks[1]);
    return {int(brick % nx), int(brick / nx % ny), int(brick / nx / ny)};
  }
  bool contains(const Index& b) const {
    return b[0] >= 0 && b[1] >= 0 && b[2] >= 0 && b[0] < bricks[0] && b[1] < bricks[1] &&
           b[2] < bricks[2];
  }
  Vec3d position(int i, int j, int k) const { return origin_m + cell_m * Vec3d(i, j, k); }
  std::size_t slots() const { return value.size() / detail::kBrickCells; }
  /// Gives a brick samples, at first `start` with weight 0.
  void touch(std::size_t brick, float start);
};

/// Averages known samples with their known neighbours, by their weights.
void smooth(Volume& volume, int rounds);

/// Decides what no view saw: the harmonic function that continues what is known, positive beyond
/// the volume; below the floor of a platter the walls go on down and end flat at y = 0. Enclosed
/// clear spaces that do not reach the outside are filled.
void close_volume(Volume& volume, const VolumeScale& scale, const RunContext& context);

/// For isosurface().
Result<BrickGrid> to_grid(const Volume& volume, std::size_t max_bytes);

detail::ViewKernel kernel_of(const DepthView& view);

}  // namespace turnscan
