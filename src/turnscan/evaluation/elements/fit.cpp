#include <turnscan/evaluation/elements/fit.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/geometry/estimation/normal_equations.hpp>

namespace turnscan::elements {

namespace {

using estimation::Matrix6d;
using estimation::Vector6d;
using Equations = estimation::NormalEquations<6>;

/// Where the points are and how far they reach.
struct Extent {
  Vec3d middle = Vec3d::Zero();
  double arm_m = 0.0, weight = 0.0;
};

Extent extent_of(std::span<const Sample> samples) {
  Extent out;
  for (const Sample& s : samples) {
    out.middle += s.weight * s.point;
    out.weight += s.weight;
  }
  out.middle /= out.weight;
  double squares = 0.0;
  for (const Sample& s : samples) squares += s.weight * (s.point - out.middle).squaredNorm();
  out.arm_m = std::sqrt(squares / out.weight);
  return out;
}

Vector6d row_of(const Shape& shape, const Changes& freedoms, const Vec3d& p) {
  return freedoms.transpose() * gradient(shape, p);
}

void add(const Sample& s, const Shape& shape, const Changes& freedoms, Equations& equations) {
  equations.add(row_of(shape, freedoms, s.point), -distance(shape, s.point), s.weight);
}

/// The normal matrix with ones for the freedoms that the shape does not have.
std::optional<Matrix6d> firm(const Matrix6d& normal, Kind kind, double weight) {
  constexpr double kLeast = 1e-10;  // of the largest eigenvalue: what single precision resolves
  Matrix6d out = normal / weight;
  for (int i = freedoms_of(kind); i < 6; ++i) out(i, i) = 1.0;
  const auto eigen = estimation::symmetric_eigen(out);
  if (!(eigen.values[0] > kLeast * eigen.values[5])) return std::nullopt;
  return out;
}

std::optional<Shape> solve(std::span<const Sample> samples, const Extent& extent, Shape shape) {
  constexpr int kIterations = 50;
  constexpr double kSettled = 1e-9;  // of the points' reach
  Vector6d step = Vector6d::Ones();
  for (int i = 0; i < kIterations && step.norm() > 1e-12; ++i) {
    shape = moved_along(shape, extent.middle);
    const Changes ways = freedoms(shape, extent.arm_m);
    Equations equations;
    for (const Sample& s : samples) add(s, shape, ways, equations);
    const auto normal = firm(equations.normal, shape.kind, extent.weight);
    if (!normal) return std::nullopt;
    step = estimation::solve_ldlt(*normal, Vector6d(equations.right / extent.weight));
    shape = changed(shape, ways * step);
    if (!shape.point.allFinite() || !(shape.radius_m >= 0.0)) return std::nullopt;
  }
  const bool cone = shape.kind != Kind::kCone ||
                    (shape.half_angle_rad > 0.0 && std::cos(shape.half_angle_rad) > 0.0);
  if (!cone || !(step.norm() <= kSettled * extent.arm_m)) return std::nullopt;
  return moved_along(shape, extent.middle);
}

/// The block of each point: that of the nearest seed. A seed is the point farthest from the others.
std::vector<std::size_t> blocks_of(std::span<const Sample> samples, const Vec3d& middle,
                                   std::size_t count) {
  std::vector<std::size_t> block(samples.size(), 0);
  std::vector<double> away(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    away[i] = (samples[i].point - middle).squaredNorm();
  for (std::size_t b = 0; b < count; ++b) {
    const auto seed = std::max_element(away.begin(), away.end()) - away.begin();
    const Vec3d at = samples[static_cast<std::size_t>(seed)].point;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double d = (samples[i].point - at).squaredNorm();
      if (b > 0 && !(d < away[i])) continue;
      away[i] = d;
      block[i] = b;
    }
  }
  return block;
}

/// V_G of the header, in the freedoms; nullopt if a block holds what alone determines the shape.
std::optional<Matrix6d> jackknife(std::span<const Sample> samples, const Extent& extent,
                                  const Shape& shape, std::size_t count) {
  const std::vector<std::size_t> block = blocks_of(samples, extent.middle, count);
  const Changes ways = freedoms(shape, extent.arm_m);
  std::vector<Equations> parts(count);
  Equations all;
  for (std::size_t i = 0; i < samples.size(); ++i) add(samples[i], shape, ways, parts[block[i]]);
  for (const Equations& part : parts) all.add(part);
  Matrix6d covariance = Matrix6d::Zero();
  for (const Equations& part : parts) {
    const auto rest = firm(all.normal - part.normal, shape.kind, extent.weight);
    if (!rest) return std::nullopt;
    const Vector6d change = estimation::solve_ldlt(*rest, Vector6d(part.right / extent.weight));
    covariance += change * change.transpose();
  }
  return Matrix6d(covariance * (double(count - 1) / double(count)));
}

/// Columns whose outer products sum up to the positive part of a symmetric matrix.
Matrix6d positive_root(const Matrix6d& a) {
  const auto eigen = estimation::symmetric_eigen(a);
  return eigen.vectors * eigen.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

void add_spread(std::span<const Sample> samples, const Extent& extent, Fit& fit) {
  constexpr std::size_t kBlocks = 30, kLeastBlocks = 10;
  constexpr double kProbe_m = 1e-6;
  const Changes ways = freedoms(fit.shape, extent.arm_m);
  fit.spread = kProbe_m * ways;
  const std::size_t finer = is_section(fit.shape.kind) ? 2 : 4;
  const std::size_t count = std::min(kBlocks, samples.size() / finer);
  if (count < kLeastBlocks) return;
  const auto coarse = jackknife(samples, extent, fit.shape, count);
  const auto fine = jackknife(samples, extent, fit.shape, finer * count);
  if (!coarse || !fine) return;
  const Matrix6d missing = positive_root(*coarse - *fine);
  fit.spread = ways * positive_root(*coarse + missing * missing.transpose());
  fit.known = true;
}

}  // namespace

std::optional<Shape> fit_shape(std::span<const Sample> samples, const Shape& start) {
  if (samples.size() < static_cast<std::size_t>(freedoms_of(start.kind))) return std::nullopt;
  const Extent extent = extent_of(samples);
  if (!(extent.arm_m > 0.0)) return std::nullopt;
  return solve(samples, extent, start);
}

Fit judged_fit(std::span<const Sample> samples, const Shape& shape) {
  const Extent extent = extent_of(samples);
  Fit fit;
  fit.shape = shape;
  double low = std::numeric_limits<double>::infinity(), high = -low, squares = 0.0;
  for (const Sample& s : samples) {
    const double d = distance(fit.shape, s.point);
    low = std::min(low, d);
    high = std::max(high, d);
    squares += s.weight * d * d;
  }
  fit.form_m = high - low;
  fit.rms_m = std::sqrt(squares / extent.weight);
  add_spread(samples, extent, fit);
  return fit;
}

}  // namespace turnscan::elements
