#pragma once
// What views say about the samples around a surface, summed while they come. Internal to the
// volumetric method.

#include <memory>
#include <span>
#include <turnscan/reconstruction/volume.hpp>

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
  static constexpr int kSuper = 4;  ///< bricks along a super-brick
  static constexpr std::size_t kBricksOfSuper = 64;
  struct Super {
    std::array<std::unique_ptr<detail::BrickSums>, kBricksOfSuper> sums;
    std::array<float, kBricksOfSuper> clear{};  ///< views that saw past the whole brick
    float clear_all = 0.0f;                     ///< past all of them
  };

  /// What is known of one brick.
  struct BrickView {
    const detail::BrickSums* sums = nullptr;
    float clear = 0.0f;
  };
  BrickView brick(const Volume::Index& at) const;
  float least_weight() const;
  Volume coarse(int factor, const Volume::Index& low, const Volume::Index& high) const;
  void coarse_brick(Volume& volume, std::size_t b, const Volume::Index& at, int factor,
                    float least) const;
  Vec3d sample_position(const Volume::Index& brick) const;
  Result<> cover(std::span<const DepthView> batch, const EarlierViews& before);
  void look_back(Super& super, const Volume::Index& first, const EarlierViews& before) const;
  void add_to(Super& super, const Volume::Index& first, std::span<const DepthView> batch,
              std::span<const detail::ViewKernel> kernels, const EarlierViews& before);
  void look_back(detail::BrickSums& sums, const Vec3d& low, const EarlierViews& before) const;
  std::size_t super_index(const Volume::Index& super) const;
  Volume::Index first_brick(std::size_t super) const;

  VolumeScale scale_;
  Volume::Index low_{}, size_{};  ///< in super-bricks; the grid's brick 0 begins at the origin
  std::vector<Super> supers_;
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
  Box box();

 private:
  std::array<std::vector<float>, 3> values_;
};

}  // namespace turnscan
