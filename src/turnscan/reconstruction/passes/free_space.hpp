#pragma once
// Where a pass saw that there is nothing.

#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

class FreeSpace {
 public:
  static constexpr std::size_t kMostViews = 40;

  /// Asks up to kMostViews of the surface's views, evenly spread; the surface must outlive it.
  /// Nearer than margin_m to what a ray met counts for nothing.
  FreeSpace(const PassSurface& surface, double margin_m);
  /// Whether several views saw past this place, or it lies in the platter. Of the views only every
  /// stride-th is asked.
  bool empty_at(const Vec3f& p_table, std::size_t stride = 1) const;

 private:
  std::vector<const views::DepthView*> views_;
  float margin_m_, floor_m_;
};

}  // namespace turnscan::passes
