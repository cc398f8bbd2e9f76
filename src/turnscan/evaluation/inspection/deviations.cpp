#include <turnscan/evaluation/inspection/deviations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>

namespace turnscan {

namespace {

constexpr Rgb kWithinTolerance{222, 222, 222}, kUnknownDeviation{128, 128, 128};
constexpr Rgb kLittleAbove{253, 200, 140}, kFarAbove{140, 20, 10};
constexpr Rgb kLittleBelow{160, 205, 235}, kFarBelow{8, 40, 120};

Rgb blend_colors(const Rgb& from, const Rgb& to, double share) {
  const auto mix = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround((1.0 - share) * a + share * b));
  };
  return {mix(from.r, to.r), mix(from.g, to.g), mix(from.b, to.b)};
}

}  // namespace

Result<std::vector<float>> deviations_from(const TriangleMesh& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(reference, "reference"));
  if (reference.empty()) {
    return fail(ErrorCode::kTooFewPoints, "deviations: the reference has no triangles; check it");
  }
  const MeshDistance distance(reference);
  const PseudoNormals normals(reference);
  std::vector<float> out(points.size(), std::numeric_limits<float>::quiet_NaN());
  context.begin_phase("deviations", 0);
  TURNSCAN_TRY(parallel_for(points.size(), 1024, context, [&](std::size_t i) {
    const Vec3d p = points[i].cast<double>();
    const auto hit = distance.closest(p);
    if (hit.triangle == MeshDistance::kNone) return;
    const double side = (p - hit.point).dot(normals.at(hit.point, hit.triangle));
    out[i] = static_cast<float>(std::copysign(hit.distance, side));
  }));
  return out;
}

Rgb deviation_color(double deviation_m, double tolerance_m, double range_m) {
  if (!std::isfinite(deviation_m)) return kUnknownDeviation;
  const double away = std::abs(deviation_m);
  if (away <= tolerance_m) return kWithinTolerance;
  const double width = range_m - tolerance_m;
  const double share = width > 0.0 ? std::clamp((away - tolerance_m) / width, 0.0, 1.0) : 1.0;
  return deviation_m > 0.0 ? blend_colors(kLittleAbove, kFarAbove, share)
                           : blend_colors(kLittleBelow, kFarBelow, share);
}

std::string deviations_csv(std::span<const Vec3f> points, std::span<const float> deviations_m) {
  std::string text = "x_mm,y_mm,z_mm,deviation_mm\n";
  for (std::size_t i = 0; i < points.size() && i < deviations_m.size(); ++i) {
    const Vec3d p = 1e3 * points[i].cast<double>();
    fmt::format_to(std::back_inserter(text), "{:.4f},{:.4f},{:.4f},{:.5f}\n", p.x(), p.y(), p.z(),
                   1e3 * double(deviations_m[i]));
  }
  return text;
}

}  // namespace turnscan
