#include <turnscan/evaluation/inspection/deviations.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
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

double weight_of(std::span<const float> weights, std::size_t i) {
  return weights.empty() ? 1.0 : double(weights[i]);
}

void must_fit(std::span<const float> deviations, std::span<const float> weights) {
  if (!weights.empty() && weights.size() != deviations.size())
    throw std::invalid_argument("deviations: one weight each, or none");
}

}  // namespace

struct SignedDistance::Impl {
  MeshDistance distance;
  PseudoNormals normals;
};

SignedDistance::SignedDistance(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SignedDistance::SignedDistance(SignedDistance&&) noexcept = default;
SignedDistance& SignedDistance::operator=(SignedDistance&&) noexcept = default;
SignedDistance::~SignedDistance() = default;

Result<SignedDistance> SignedDistance::to(const TriangleMesh& reference,
                                          const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(reference, "reference"));
  if (reference.empty()) {
    return fail(ErrorCode::kTooFewPoints, "deviations: the reference has no triangles; check it");
  }
  TURNSCAN_ASSIGN(MeshDistance distance, MeshDistance::create(reference, context));
  TURNSCAN_ASSIGN(PseudoNormals normals, PseudoNormals::create(reference, context));
  return SignedDistance(std::make_unique<Impl>(Impl{std::move(distance), std::move(normals)}));
}

double SignedDistance::at(const Vec3d& point) const {
  const auto hit = impl_->distance.closest(point);
  if (hit.triangle == MeshDistance::kNone) return std::numeric_limits<double>::quiet_NaN();
  const double side = (point - hit.point).dot(impl_->normals.at(hit.point, hit.triangle));
  return std::copysign(hit.distance, side);
}

Result<std::vector<float>> deviations_from(const TriangleMesh& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context) {
  TURNSCAN_ASSIGN(const SignedDistance distance, SignedDistance::to(reference, context));
  return deviations_from(distance, points, context);
}

Result<std::vector<float>> deviations_from(const SignedDistance& reference,
                                           std::span<const Vec3f> points,
                                           const RunContext& context) {
  std::vector<float> out(points.size());
  context.begin_phase("deviations", 0);
  TURNSCAN_TRY(parallel_for(points.size(), 1024, context, [&](std::size_t i) {
    out[i] = static_cast<float>(reference.at(points[i].cast<double>()));
  }));
  return out;
}

DeviationFigures deviation_figures(std::span<const float> deviations_m,
                                   std::span<const float> weights, double tolerance_m) {
  must_fit(deviations_m, weights);
  DeviationFigures out;
  double sum = 0.0;
  for (std::size_t i = 0; i < deviations_m.size(); ++i) {
    const double d = deviations_m[i], weight = weight_of(weights, i);
    if (!std::isfinite(d)) continue;
    out.lowest_m = out.count == 0 ? d : std::min(out.lowest_m, d);
    out.highest_m = out.count == 0 ? d : std::max(out.highest_m, d);
    ++out.count;
    sum += weight;
    out.mean_m += weight * d;
    out.rms_m += weight * d * d;
    (d > tolerance_m ? out.above : d < -tolerance_m ? out.below : out.within) += weight;
  }
  if (!(sum > 0.0)) return {};
  for (double* value : {&out.mean_m, &out.rms_m, &out.within, &out.above, &out.below})
    *value /= sum;
  out.rms_m = std::sqrt(out.rms_m);
  return out;
}

std::vector<double> deviation_histogram(std::span<const float> deviations_m,
                                        std::span<const float> weights, double range_m,
                                        std::size_t bins) {
  must_fit(deviations_m, weights);
  std::vector<double> out(bins, 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < deviations_m.size() && bins > 0; ++i) {
    const double d = deviations_m[i], weight = weight_of(weights, i);
    if (!std::isfinite(d)) continue;
    const double at = std::clamp(0.5 * (d / range_m + 1.0), 0.0, 1.0) * double(bins);
    out[std::min(bins - 1, static_cast<std::size_t>(at))] += weight;
    sum += weight;
  }
  for (double& share : out) share = sum > 0.0 ? share / sum : 0.0;
  return out;
}

std::vector<float> surface_shares(const TriangleMesh& mesh) {
  std::vector<double> shares(mesh.vertices.size(), 0.0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) shares[v] += triangle_area(mesh, t) / 3.0;
  return {shares.begin(), shares.end()};
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
