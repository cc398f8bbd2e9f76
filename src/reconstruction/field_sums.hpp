#pragma once
// What views say about the samples around a surface, summed while they come. Internal to the
// volumetric method.

#include <memory>
#include <span>
#include <turnscan/reconstruction/brick_view.hpp>

namespace turnscan {

/// Views of earlier batches, each of which stands for `weight` views.
struct EarlierViews {
  std::span<const DepthView> views;
  float weight = 1.0f;
};

/// Sums in bricks of 8^3 samples at fixed places of the table frame; the platter, y = 0, lies
/// halfway between the lowest layer of bricks 0 and the next. A brick has sums as soon as a view
/// measured a surface within the truncation of one of its samples; of the others only how many
/// views saw past all of it is known. What earlier views saw of a brick that gets sums late is
/// looked up in those kept.
class FieldSums {
 public:
  FieldSums() = default;
  explicit FieldSums(const VolumeScale& scale) : scale_(scale) {}

  const VolumeScale& scale() const { return scale_; }
  std::size_t bytes() const { return bytes_; }

  /// Adds views, in order, on all cores: the same sums for any number of threads, not for other
  /// batches. Fails with kResourceLimit when a brick or the
  /// table of bricks does not fit the scale's max_bytes.
  Result<> add(std::span<const DepthView> batch, const EarlierViews& before);

  /// Where views saw a surface within the truncation a sample gets their mean distance along the
  /// rays; where they saw past it, it is clear; conflicts go by the evidence. The rest has weight
  /// 0. Bricks that lie in the box or touch it.
  Volume settle(const Box& box) const;

  /// The same at a coarser level, whose samples are means of 2^3, 4^3 or 8^3: the finest that has
  /// at most `most_bricks` bricks, or the coarsest.
  Volume settle_coarsely(std::size_t most_bricks) const;

 private:
  /// Bricks that views are asked about together.
  struct Group {
    std::array<std::unique_ptr<bricks::BrickSums>, bricks::kGroup> sums;
    std::array<float, bricks::kGroup> clear{};  ///< views that saw past the whole brick
  };
  /// One bit a brick of a group.
  using Bits = std::uint64_t;

  /// What is known of one brick.
  struct BrickKnown {
    const bricks::BrickSums* sums = nullptr;
    float clear = 0.0f;
  };
  BrickKnown brick(const Volume::Index& at) const;
  float least_weight() const;
  Volume coarse(int factor, const Volume::Index& low, const Volume::Index& high) const;
  void coarse_brick(Volume& volume, std::size_t b, const Volume::Index& at, int factor,
                    float least) const;
  Vec3d sample_position(const Volume::Index& brick) const;
  std::array<float, 3> first_sample(const Volume::Index& brick) const;
  Result<> cover(std::span<const DepthView> batch, const EarlierViews& before);
  Box measured_box(std::span<const DepthView> batch) const;
  void grow(const Volume::Index& low, const Volume::Index& high, const EarlierViews& before);
  void look_back_at_groups(std::span<const std::size_t> groups, const EarlierViews& before);
  Bits add_to(Group& group, const Volume::Index& first) const;
  std::unique_ptr<bricks::BrickSums> first_sums(std::span<const bricks::Sights> sights,
                                                std::size_t brick, const float first[3],
                                                std::size_t& view) const;
  void look_back_at_bricks(std::span<const Bits> made, const EarlierViews& before);
  void look_back(std::size_t group, std::size_t brick, std::span<const BrickView> before,
                 float weight);
  std::size_t group_index(const Volume::Index& group) const;
  Volume::Index first_brick(std::size_t group) const;

  VolumeScale scale_;
  Volume::Index low_{}, size_{};  ///< in groups; the grid's brick 0 begins at the origin
  std::vector<Group> groups_;
  std::vector<BrickView> batch_;  ///< the views that are being added
  std::size_t bytes_ = 0;
};

/// Points that a view measured, edges left out, table frame.
template <class Take>
void for_each_point(const DepthView& view, const Take& take) {
  const Eigen::Matrix3f back = view.rotation.transpose();
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t word = view.pixels[std::size_t(y) * std::size_t(view.width) + x];
      if ((word & 0xffffu) == 0 || (word & DepthView::kEdge) != 0) continue;
      const float z = float(word & 0xffffu) * view.unit_m + view.bias_m;
      const float s = view.parallel ? 1.0f : z;
      take(Vec3f(back *
                 (Vec3f((float(x) - view.cx) / view.fx * s, (float(y) - view.cy) / view.fy * s, z) -
                  view.translation)));
    }
  }
}

/// Collects points to find the box around them, but for the outermost 2 in 10,000 of each side,
/// which may be stray.
class RobustBox {
 public:
  void add(const Vec3f& p) {
    for (int a = 0; a < 3; ++a) values_[std::size_t(a)].push_back(p[a]);
  }
  void add(const RobustBox& other);
  Box box();

 private:
  std::array<std::vector<float>, 3> values_;
};

}  // namespace turnscan
