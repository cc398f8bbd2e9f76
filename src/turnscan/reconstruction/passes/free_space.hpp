#pragma once
// Where a pass saw that there is nothing.

#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

class FreeSpace {
 public:
  static constexpr std::size_t kMaxViews = 40;

  /// Nothing is known to be empty.
  FreeSpace() = default;
  /// Asks up to kMaxViews of the surface's views, evenly spread. Nearer than margin_m to what a
  /// ray met counts for nothing.
  FreeSpace(const PassSurface& surface, double margin_m);
  /// Empty is, too, what another pass saw to be.
  void add(const FreeSpace& other, const Pose& T_other_here);
  /// Whether several views of one pass saw past this place, or it lies in its platter. Of the views
  /// only every stride-th is asked.
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
