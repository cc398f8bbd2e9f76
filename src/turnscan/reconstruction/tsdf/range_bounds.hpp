#pragma once
// Min/max-depth bounds of a view: its observation of a brick without visiting each sample.

#include <turnscan/reconstruction/tsdf/brick_kernel.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>
#include <vector>

namespace turnscan::tsdf {

/// Observation of a brick by a view, as in VisibilityMasks.
enum class Visibility : std::uint8_t { kUnobserved, kFree, kPartlyFree, kNearSurface };

/// A view prepared for samples of one scale, with bounds of the depths around each pixel. The view
/// must outlive it.
class RangeBounds {
 public:
  RangeBounds() = default;
  /// Reuses the allocated memory. Invalidates the bounds of the previous view.
  void set_view(const views::DepthView& view, const VolumeScale& scale);
  /// Computes the bounds that the kernel needs for the visibility of groups and parts of bricks.
  void compute();

  /// For the kernel.
  const BrickKernelView& operator*() const { return view_; }

  /// Visibility of one brick of a group, as the kernel computes it, from the pixels instead of
  /// bounds. first: the position of the group's first sample, table frame.
  Visibility visibility(const float first[3], std::size_t brick) const;

 private:
  /// Range of the raw values of the pixels in a window.
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
