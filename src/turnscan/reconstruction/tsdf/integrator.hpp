#pragma once
// Incremental integration of views into a TSDF (Curless and Levoy 1996), with free space.

#include <memory>
#include <span>
#include <turnscan/reconstruction/tsdf/range_bounds.hpp>

namespace turnscan::tsdf {

/// Bricks along a group.
inline constexpr int kGroupSide = 4;

inline GridCoords brick_of_group(const GridCoords& first, std::size_t b) {
  return {first[0] + int(b & 3), first[1] + int(b >> 2 & 3), first[2] + int(b >> 4)};
}

inline int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

inline GridCoords minus(const GridCoords& a, const GridCoords& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Views of earlier batches, each of which represents `weight` views.
struct EarlierViews {
  std::span<const views::DepthView> views;
  float weight = 1.0f;
};

/// Sums over views in bricks of 8^3 samples at fixed positions of the table frame; the platter, y =
/// 0, is halfway between the lowest layer of bricks 0 and the next. A brick gets sums once a view
/// measures a surface within the truncation distance of one of its samples; for other bricks only
/// the number of views that saw past the whole brick is stored. For bricks that get sums late, the
/// observations of earlier views are looked up in the views that were kept.
class Integrator {
 public:
  Integrator() = default;
  explicit Integrator(const VolumeScale& scale) : scale_(scale) {}

  const VolumeScale& scale() const { return scale_; }
  std::size_t bytes() const { return bytes_; }

  /// Adds views in order, on all cores: the sums do not depend on the number of threads, but do
  /// depend on the batches. Fails with kResourceLimit if the bricks or their table exceed the
  /// scale's max_bytes.
  Result<> integrate(std::span<const views::DepthView> batch, const EarlierViews& before,
                     const RunContext& context = {});

  /// Where views saw a surface within the truncation distance, a sample gets their mean distance
  /// along the rays; where they saw past it, it is free; conflicts are decided by the evidence.
  /// Other samples have weight 0. Contains the bricks that intersect or touch the box.
  Result<Volume> extract_volume(const Box& box, const RunContext& context = {}) const;

  /// The same at a coarser level, whose samples are means of 2^3, 4^3 or 8^3: the finest that has
  /// at most `most_bricks` bricks, or the coarsest.
  Volume extract_coarse_volume(std::size_t most_bricks) const;

 private:
  /// Bricks whose visibility is computed together.
  struct BrickGroup {
    std::array<std::unique_ptr<BrickSums>, kGroupBricks> sums;
    std::array<float, kGroupBricks> free{};  ///< number of views that saw past the whole brick
  };
  /// One bit for each brick of a group.
  using BrickMask = std::uint64_t;

  /// The stored observations of one brick.
  struct BrickEvidence {
    const BrickSums* sums = nullptr;
    float free = 0.0f;
  };
  BrickEvidence evidence(const GridCoords& brick) const;
  float least_weight() const;
  Volume coarse_volume(int factor, const GridCoords& low, const GridCoords& high) const;
  void fill_coarse_brick(Volume& volume, std::size_t b, const GridCoords& first, int factor,
                         float least) const;

  Vec3d sample_position(const GridCoords& brick) const;
  std::array<float, 3> first_sample(const GridCoords& brick) const;
  GridCoords first_brick(std::size_t group) const;

  Result<> cover(std::span<const views::DepthView> batch, const EarlierViews& before);
  Box volume_box(std::span<const views::DepthView> batch) const;
  void grow(const GridCoords& low, const GridCoords& high, const EarlierViews& before);
  void add_earlier_free_bricks(std::span<const std::size_t> groups, const EarlierViews& before);

  BrickMask integrate_into(BrickGroup& group, const GridCoords& first) const;
  std::unique_ptr<BrickSums> first_sums(std::span<const VisibilityMasks> visibility,
                                        std::size_t brick, const float first[3],
                                        std::size_t& view) const;
  Result<> add_earlier_free_samples(std::span<const BrickMask> made, const EarlierViews& before,
                                    const RunContext& context);
  void add_earlier_free_samples(std::size_t group, std::size_t brick,
                                std::span<const RangeBounds> before, float weight);

  VolumeScale scale_;
  GridCoords low_{};  ///< the first group; the grid's brick 0 begins at the origin
  GridIndex grid_;    ///< groups, from low_ on
  std::vector<BrickGroup> groups_;
  std::vector<RangeBounds> batch_;  ///< the views that are being integrated
  std::size_t bytes_ = 0;
  float views_ = 0.0f;  ///< number integrated
};

}  // namespace turnscan::tsdf
