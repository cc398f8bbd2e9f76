#include <cmath>
#include <turnscan/reconstruction/passes/free_space.hpp>

namespace turnscan::passes {

namespace {

/// One view may be misled by mixed pixels at a silhouette.
constexpr int kWitnesses = 2;

bool sees_past(const views::DepthView& view, const Vec3f& p_table, float margin_m) {
  const Vec3f p = view.rotation * p_table + view.translation;
  if (!(p.z() > 0.01f) && !view.parallel) return false;
  const Eigen::Vector2f at = view.project(p);
  // Comparisons in float: what is far outside does not fit an int.
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

FreeSpace::FreeSpace(const PassSurface& surface, double margin_m)
    : margin_m_(float(margin_m)),
      floor_m_(surface.floor_m ? float(*surface.floor_m - margin_m) : -1e9f) {
  const std::size_t count = surface.views.size(), most = std::min(count, kMostViews);
  for (std::size_t i = 0; i < most; ++i) views_.push_back(&surface.views[i * count / most]);
}

bool FreeSpace::empty_at(const Vec3f& p_table, std::size_t stride) const {
  if (p_table.y() < floor_m_) return true;
  int witnesses = 0;
  for (std::size_t v = 0; v < views_.size(); v += stride)
    if (sees_past(*views_[v], p_table, margin_m_) && ++witnesses == kWitnesses) return true;
  return false;
}

}  // namespace turnscan::passes
