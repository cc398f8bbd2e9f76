#pragma once
// Min/max-depth bounds of a view: what it saw of a brick of samples, without looking at each.

#include <turnscan/reconstruction/tsdf/brick_kernel.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>
#include <vector>

namespace turnscan::tsdf {

/// What a view says about a brick, as VisibilityMasks.
enum class Visibility : std::uint8_t { kUnobserved, kFree, kPartlyFree, kNearSurface };

/// A view, prepared for samples of one scale, with bounds of the depths around each pixel. The view
/// must outlive it.
class RangeBounds {
 public:
  RangeBounds() = default;
  /// Uses the memory of what it held before. Bounds of the last view are gone.
  void set_view(const views::DepthView& view, const VolumeScale& scale);
  /// Needed for the visibility of groups and parts of bricks by the kernel.
  void compute();

  /// For the kernel.
  const BrickKernelView& operator*() const { return view_; }

  /// Of one brick of a group, as the kernel has it, from the pixels instead of bounds. first: the
  /// position of the group's first sample, table frame.
  Visibility visibility(const float first[3], std::size_t brick) const;

 private:
  /// Of the pixels of a window, raw.
  struct DepthRange {
    std::uint32_t nearest = 65535, farthest = 0;  ///< measured
    std::uint32_t least = 65535, most = 0;        ///< free depths
  };
  DepthRange depth_range_around(float x, float y, float z) const;
  void set_projection(const views::DepthView& view);
  void set_steps(const views::DepthView& view, double cell_m);
  void set_level(const views::DepthView& view, int side, double cell_m, double nearest_m,
                 BoundsLevel& level) const;

  BrickKernelView view_{};
  std::vector<std::uint32_t> brick_bounds_, part_bounds_;
};

}  // namespace turnscan::tsdf
