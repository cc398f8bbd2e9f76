#pragma once
// Free space observed by passes.

#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

class FreeSpace {
 public:
  static constexpr std::size_t kMaxViews = 40;

  /// Nothing is known to be empty.
  FreeSpace() = default;
  /// Uses up to kMaxViews of the surface's views, evenly spread. Space within margin_m of a
  /// measured depth is not counted as free.
  FreeSpace(const PassSurface& surface, double margin_m);
  /// Adds the free space of another pass.
  void add(const FreeSpace& other, const Pose& T_other_here);
  /// Whether several views of one pass saw past this point, or it is inside its platter. Only every
  /// stride-th view is used.
  bool empty_at(const Vec3f& p, std::size_t stride = 1) const;

 private:
  struct OfPass {
    SharedViews owner;
    std::vector<const views::DepthView*> views;
    float margin_m, floor_m;
    Eigen::Isometry3f T_table_here;
  };
  std::vector<OfPass> passes_;
};

}  // namespace turnscan::passes
