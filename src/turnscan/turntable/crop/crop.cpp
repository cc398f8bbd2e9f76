#include <algorithm>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan {

OptionTable describe(CropOptions& o) {
  OptionTable table;
  table.flag("crop", o.enabled, "Keep only the cylinder above the platter")
      .number("crop-margin", o.margin_m, Quantity::kLength, {-0.05, 0.2},
              "Height above the platter below which returns are dropped")
      .number("crop-radius", o.radius_m, Quantity::kLength, {1e-3, 100.0},
              "Radius of the cylinder; automatic: the platter's, or more where the object reaches "
              "beyond it")
      .number("crop-height", o.height_m, Quantity::kLength, {1e-3, 100.0},
              "Height of the cylinder");
  return table;
}

SensorCrop::SensorCrop(const Cylinder& cylinder, const Pose& T_table_sensor)
    : rotation_(T_table_sensor.linear().cast<float>()),
      translation_(T_table_sensor.translation().cast<float>()),
      margin_(static_cast<float>(cylinder.margin_m)),
      height_(static_cast<float>(cylinder.height_m)),
      radius_squared_(static_cast<float>(cylinder.radius_m * cylinder.radius_m)) {}

bool SensorCrop::keeps(const Vec3f& p_sensor) const {
  const Vec3f p = rotation_ * p_sensor + translation_;
  return p.y() > margin_ && p.y() < height_ && p.x() * p.x() + p.z() * p.z() < radius_squared_;
}

FramePoints crop(const FramePoints& points, const SensorCrop& crop) {
  return kept_points(points, [&](const Vec3f& p) { return crop.keeps(p); });
}

PlatterReturns measure_platter(const std::vector<Vec3f>& p_table, double radius_m) {
  constexpr auto kReach = float(PlatterReturns::kReach_m);
  constexpr std::size_t kMaxHeights = 200000;  // more add no information and have to be sorted
  std::vector<float> heights;
  const float r2 = static_cast<float>(radius_m * radius_m);
  for (const Vec3f& p : p_table) {
    if (std::abs(p.y()) < kReach && p.x() * p.x() + p.z() * p.z() < r2) heights.push_back(p.y());
  }
  if (heights.size() < 200) return {};
  PlatterReturns out;
  out.count = heights.size();
  const std::size_t stride = 1 + heights.size() / kMaxHeights;
  for (std::size_t i = 0; i * stride < heights.size(); ++i) heights[i] = heights[i * stride];
  heights.resize((heights.size() + stride - 1) / stride);
  // The platter is the densest height: the median of the densest 3 mm window.
  std::sort(heights.begin(), heights.end());
  std::size_t best = 0, best_begin = 0, best_end = 0;
  for (std::size_t begin = 0, end = 0; begin < heights.size(); ++begin) {
    while (end < heights.size() && heights[end] < heights[begin] + 0.003f) ++end;
    if (end - begin > best) best = end - begin, best_begin = begin, best_end = end;
  }
  const float middle = heights[(best_begin + best_end) / 2];
  std::vector<float> below;
  for (float h : heights) {
    if (h <= middle) below.push_back(middle - h);
  }
  out.dense_share = double(best) / double(heights.size());
  out.height_m = middle;
  std::nth_element(below.begin(), below.begin() + std::ptrdiff_t(below.size() / 2), below.end());
  out.sigma_m = estimation::kMadToSigma * below[below.size() / 2];
  return out;
}

std::optional<double> find_platter_radius(const std::vector<Vec3f>& p_table,
                                          const PlatterReturns& platter) {
  constexpr double kRing = 0.004;
  constexpr std::size_t kRings = 150;
  constexpr double kMinDensity = 2e4;  // returns per square metre: one in 50 mm^2
  if (!platter.plane()) return std::nullopt;
  std::vector<double> density(kRings, 0.0);
  const double band = std::max(4.0 * platter.sigma_m, 0.001);
  for (const Vec3f& p : p_table) {
    const double r = std::hypot(p.x(), p.z());
    if (std::abs(p.y() - platter.height_m) < band && r < kRing * kRings)
      density[static_cast<std::size_t>(r / kRing)] += 1.0;
  }
  for (std::size_t i = 0; i < kRings; ++i)
    density[i] /= EIGEN_PI * kRing * kRing * double(2 * i + 1);
  const auto densest = std::max_element(density.begin(), density.end());
  if (*densest < kMinDensity) return std::nullopt;
  const auto end =
      std::find_if(densest, density.end(), [&](double d) { return d < 0.3 * *densest; });
  if (end == density.end()) return std::nullopt;
  return kRing * double(end - density.begin());
}

}  // namespace turnscan
