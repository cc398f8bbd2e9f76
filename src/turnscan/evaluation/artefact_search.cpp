#include <turnscan/evaluation/artefact_search.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/random.hpp>

namespace turnscan::artefact {

namespace {

constexpr std::size_t kMaxScored = 20000;
constexpr std::size_t kMinSupport = 50;
constexpr std::uint64_t kSeed = 2634;
constexpr std::uint64_t kTrials = 3000;

/// An even selection of about kMaxScored of the points.
std::vector<std::size_t> thinned(std::size_t n) {
  const std::size_t step = (n + kMaxScored - 1) / kMaxScored;
  std::vector<std::size_t> picked;
  for (std::size_t i = 0; i < n; i += std::max<std::size_t>(step, 1)) picked.push_back(i);
  return picked;
}

template <class Surface>
std::size_t support(const Points& points, const std::vector<std::size_t>& picked,
                    const Surface& surface, double tolerance_m) {
  std::size_t count = 0;
  for (const std::size_t i : picked) {
    const Vec3d& p = points.positions[i];
    if (std::abs(surface.distance(p)) <= tolerance_m && points.agrees(i, surface.normal(p)))
      ++count;
  }
  return count;
}

/// Keeps the surface with the largest support.
template <class Surface>
class Best {
 public:
  void offer(const Surface& surface, std::size_t count) {
    if (count > count_) {
      count_ = count;
      surface_ = surface;
    }
  }
  std::optional<Surface> get() const { return count_ >= kMinSupport ? surface_ : std::nullopt; }

 private:
  std::size_t count_ = 0;
  std::optional<Surface> surface_;
};

/// A picked point, from draw `counter` of a trial.
std::size_t draw(const std::vector<std::size_t>& picked, std::uint64_t trial,
                 std::uint64_t counter) {
  const double u = uniform01(hash_key(kSeed, trial, counter));
  return picked[static_cast<std::size_t>(u * double(picked.size()))];
}

/// A point with a distance from `from` between `least` and `most`; nullopt after a few attempts.
std::optional<Vec3d> draw_near(const Points& points, const std::vector<std::size_t>& picked,
                               const Vec3d& from, double least, double most, std::uint64_t trial,
                               std::uint64_t stream) {
  for (std::uint64_t attempt = 0; attempt < 30; ++attempt) {
    const Vec3d& p = points.positions[draw(picked, trial, stream + attempt)];
    const double d = (p - from).norm();
    if (d >= least && d <= most) return p;
  }
  return std::nullopt;
}

/// The centres of the two spheres of this radius through three points; none if these are too far
/// apart for it.
std::vector<Vec3d> centers_through(const Vec3d& a, const Vec3d& b, const Vec3d& c, double radius) {
  const Vec3d u = b - a, v = c - a, n = u.cross(v);
  const double n2 = n.squaredNorm();
  if (!(n2 > 1e-6 * u.squaredNorm() * v.squaredNorm())) return {};
  // Circumcentre of the triangle, relative to a.
  const Vec3d middle = (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n2);
  const double height2 = radius * radius - middle.squaredNorm();
  if (height2 < 0.0) return {};
  const Vec3d up = std::sqrt(height2) / std::sqrt(n2) * n;
  return {a + middle + up, a + middle - up};
}

}  // namespace

bool Points::agrees(std::size_t i, const Vec3d& surface_normal) const {
  constexpr double kCosine = 0.70710678118654752;  // 45 deg
  return normals.empty() || normals[i].dot(surface_normal) >= kCosine;
}

std::optional<Sphere> find_sphere(const Points& points, double radius,
                                  const std::vector<Sphere>& others, const RunContext& context) {
  std::vector<std::size_t> picked;
  for (const std::size_t i : thinned(points.positions.size())) {
    const Vec3d& p = points.positions[i];
    const bool taken = std::any_of(others.begin(), others.end(), [&](const Sphere& o) {
      return (p - o.center).norm() < 1.2 * o.radius;
    });
    if (!taken) picked.push_back(i);
  }
  if (picked.size() < kMinSupport) return std::nullopt;
  Best<Sphere> best;
  for (std::uint64_t trial = 0; trial < kTrials && !context.cancelled(); ++trial) {
    const Vec3d a = points.positions[draw(picked, trial, 0)];
    const auto b = draw_near(points, picked, a, 0.3 * radius, 1.6 * radius, trial, 100);
    const auto c = draw_near(points, picked, a, 0.3 * radius, 1.6 * radius, trial, 200);
    if (!b || !c) continue;
    for (const Vec3d& center : centers_through(a, *b, *c, radius)) {
      const bool clear = std::all_of(others.begin(), others.end(), [&](const Sphere& o) {
        return (center - o.center).norm() > radius + o.radius;
      });
      const Sphere sphere{center, radius};
      if (clear) best.offer(sphere, support(points, picked, sphere, 0.05 * radius));
    }
  }
  return best.get();
}

std::optional<Plane> find_plane(const Points& points, const RunContext& context) {
  constexpr double kTolerance_m = 1e-3;
  const std::vector<std::size_t> picked = thinned(points.positions.size());
  Best<Plane> best;
  for (std::uint64_t trial = 0; trial < kTrials && !context.cancelled(); ++trial) {
    std::array<Vec3d, 3> p;
    for (std::uint64_t i = 0; i < 3; ++i) p[i] = points.positions[draw(picked, trial, i)];
    const Vec3d u = p[1] - p[0], v = p[2] - p[0], n = u.cross(v);
    if (!(n.squaredNorm() > 0.01 * u.squaredNorm() * v.squaredNorm())) continue;
    Plane plane{p[0], n.normalized()};
    best.offer(plane, support(points, picked, plane, kTolerance_m));
    plane.unit = -plane.unit;
    if (!points.normals.empty()) best.offer(plane, support(points, picked, plane, kTolerance_m));
  }
  return best.get();
}

}  // namespace turnscan::artefact
