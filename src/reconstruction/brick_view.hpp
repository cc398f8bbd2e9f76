#pragma once
// Views as the loops over bricks need them. Internal to the volumetric method.

#include <turnscan/reconstruction/brick_kernel.hpp>
#include <turnscan/reconstruction/volume.hpp>
#include <vector>

namespace turnscan {

/// A view, placed for samples of one scale, with bounds on what it saw around each pixel. The view
/// must outlive it.
class BrickView {
 public:
  BrickView() = default;
  /// Uses the memory of what it held before.
  void place(const DepthView& view, const VolumeScale& scale);
  /// Needed to look at groups and parts of bricks with the kernel.
  void bound();

  const bricks::View& operator*() const { return view_; }

  /// What look_at_group says about one brick, from the pixels instead of bounds.
  enum class Sight { kNothing, kClear, kPartly, kSurface };
  Sight look_at(const float first[3], std::size_t brick) const;

 private:
  /// Of the pixels of a window, raw.
  struct Window {
    std::uint32_t nearest = 65535, farthest = 0;  ///< measured
    std::uint32_t least = 65535, most = 0;        ///< free depths
  };
  Window window_at(float x, float y, float z) const;
  void set_lens(const DepthView& view);
  void set_steps(const DepthView& view, double cell_m);
  void set_level(const DepthView& view, int side, double cell_m, double nearest_m,
                 bricks::Level& level) const;

  bricks::View view_{};
  std::vector<std::uint32_t> bounds_of_bricks_, bounds_of_parts_;
};

}  // namespace turnscan
