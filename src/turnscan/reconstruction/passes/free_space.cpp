#include <cmath>
#include <turnscan/core/spread.hpp>
#include <turnscan/reconstruction/passes/free_space.hpp>

namespace turnscan::passes {

namespace {

/// A single view may be wrong because of mixed pixels at a silhouette.
constexpr int kWitnesses = 2;

bool sees_past(const views::DepthView& view, const Vec3f& p_table, float margin_m) {
  const Vec3f p = view.rotation * p_table + view.translation;
  if (!(p.z() > 0.01f) && !view.parallel) return false;
  const Eigen::Vector2f at = view.project(p);
  // Compares as float: points far outside would overflow an int.
  if (!(at.x() > 0.0f && at.y() > 0.0f && at.x() < float(view.width - 1) &&
        at.y() < float(view.height - 1)))
    return false;
  const std::uint32_t word =
      view.pixels[std::size_t(std::lround(at.y())) * std::size_t(view.width) +
                  std::size_t(std::lround(at.x()))];
  const std::uint32_t free = word >> 17 << 1;
  return free != 0 && p.z() < float(free) * view.unit_m + view.bias_m - margin_m;
}

}  // namespace

FreeSpace::FreeSpace(const PassSurface& surface, double margin_m) {
  OfPass own{surface.views,
             {},
             float(margin_m),
             surface.floor_m ? float(*surface.floor_m - margin_m) : -1e9f,
             Eigen::Isometry3f::Identity()};
  for (const std::size_t i : evenly_spread(own.owner ? own.owner->size() : 0, kMaxViews))
    own.views.push_back(&(*own.owner)[i]);
  passes_.push_back(std::move(own));
}

void FreeSpace::add(const FreeSpace& other, const Pose& T_other_here) {
  for (OfPass pass : other.passes_) {
    pass.T_table_here = pass.T_table_here * T_other_here.cast<float>();
    passes_.push_back(std::move(pass));
  }
}

bool FreeSpace::empty_at(const Vec3f& p, std::size_t stride) const {
  for (const OfPass& pass : passes_) {
    const Vec3f p_table = pass.T_table_here * p;
    if (p_table.y() < pass.floor_m) return true;
    int witnesses = 0;
    for (std::size_t v = 0; v < pass.views.size(); v += stride)
      if (sees_past(*pass.views[v], p_table, pass.margin_m) && ++witnesses == kWitnesses)
        return true;
  }
  return false;
}

}  // namespace turnscan::passes
