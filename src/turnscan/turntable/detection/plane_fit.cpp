#include <Eigen/LU>
#include <algorithm>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/detection/plane_fit.hpp>

namespace turnscan::detection {

namespace {

constexpr std::uint64_t kSeed = 0x706c616e65ULL;

std::optional<Plane> plane_through(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d n = (b - a).cross(c - a);
  const double longest = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
  if (!(n.norm() > 0.05 * longest)) return std::nullopt;
  Plane plane{n.normalized(), 0.0};
  plane.offset = plane.normal.dot(a);
  if (plane.offset > 0.0) plane = {-plane.normal, -plane.offset};
  return plane;
}

/// A sparse sample of the unassigned pixels, for counting.
struct Sample {
  std::vector<std::int32_t> pixels;
  std::vector<Vec3f> points;
};

Sample sample_of(const ScanPixels& scan, const std::vector<std::uint8_t>& free) {
  std::vector<std::int32_t> all;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i]) all.push_back(static_cast<std::int32_t>(i));
  }
  constexpr std::size_t kMax = 6000;
  Sample sample;
  sample.pixels = evenly_spread(all, kMax);
  for (const std::int32_t i : sample.pixels) sample.points.push_back(scan.point[std::size_t(i)]);
  return sample;
}

/// A random still pixel near another; -1 if there is none.
std::int32_t neighbour(const ScanPixels& scan, const std::vector<std::uint8_t>& free,
                       std::int32_t pixel, int reach, std::uint64_t key) {
  const int x = pixel % scan.width + int((uniform01(mix64(key)) - 0.5) * 2 * reach);
  const int y = pixel / scan.width + int((uniform01(mix64(key ^ 0x9e37ULL)) - 0.5) * 2 * reach);
  if (x < 0 || y < 0 || x >= scan.width || y >= scan.height) return -1;
  const std::int32_t there = y * scan.width + x;
  return free[std::size_t(there)] ? there : -1;
}

std::size_t count_near(const std::vector<Vec3f>& points, const Plane& plane, double tolerance) {
  const Vec3f n = plane.normal.cast<float>();
  const auto d = static_cast<float>(plane.offset), t = static_cast<float>(tolerance);
  std::size_t count = 0;
  for (const Vec3f& p : points) count += std::abs(n.dot(p) - d) < t ? 1 : 0;
  return count;
}

std::optional<Plane> best_hypothesis(const ScanPixels& scan, const std::vector<std::uint8_t>& free,
                                     double tolerance, std::uint64_t round) {
  const Sample sample = sample_of(scan, free);
  if (sample.pixels.size() < 50) return std::nullopt;
  constexpr std::size_t kTrials = 500;
  struct Trial {
    std::size_t count = 0;
    Plane plane;
  };
  std::vector<Trial> trials(kTrials);
  parallel_for(kTrials, 16, [&](std::size_t t) {
    const std::uint64_t key = hash_key(kSeed, round, t);
    const std::int32_t a =
        sample.pixels[std::size_t(uniform01(key) * double(sample.pixels.size()))];
    const int reach = 6 << (t % 3);  // 6, 12 and 24 pixels: small and large surfaces
    const std::int32_t b = neighbour(scan, free, a, reach, mix64(key ^ 1));
    const std::int32_t c = neighbour(scan, free, a, reach, mix64(key ^ 2));
    if (b < 0 || c < 0) return;
    const auto point = [&](std::int32_t i) {
      return Vec3d(scan.point[std::size_t(i)].cast<double>());
    };
    const auto plane = plane_through(point(a), point(b), point(c));
    if (plane) trials[t] = {count_near(sample.points, *plane, tolerance), *plane};
  });
  const auto best =
      std::max_element(trials.begin(), trials.end(),
                       [](const Trial& l, const Trial& r) { return l.count < r.count; });
  if (best->count < 20) return std::nullopt;
  return best->plane;
}

std::vector<std::int32_t> near_plane(const ScanPixels& scan, const std::vector<std::uint8_t>& free,
                                     const Plane& plane, double tolerance) {
  std::vector<std::int32_t> out;
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i] && std::abs(plane.height(scan.point[i].cast<double>())) < tolerance)
      out.push_back(static_cast<std::int32_t>(i));
  }
  return out;
}

/// Refines an approximate hypothesis to the least-squares plane of the nearby pixels, with
/// shrinking tolerances.
std::optional<FoundPlane> refine(const ScanPixels& scan, const RayTable& rays,
                                 const std::vector<std::uint8_t>& free, Plane plane,
                                 double tolerance, const RunContext& context) {
  FoundPlane out;
  for (const double wide : {2.0, 1.5, 1.0, 1.0}) {
    out.pixels = near_plane(scan, free, plane, wide * tolerance);
    const auto fit = fit_plane(scan, rays, out.pixels);
    if (!fit || context.cancelled()) return std::nullopt;
    plane = fit->plane;
  }
  out.plane = plane;
  out.tolerance_m = tolerance;
  out.pixels = near_plane(scan, free, plane, tolerance);
  return out;
}

}  // namespace

ScanPixels pixels_of(const AveragedScan& scan) {
  const RayTable rays(scan.intrinsics);
  ScanPixels out;
  out.width = scan.depth_m.width;
  out.height = scan.depth_m.height;
  const std::size_t n = scan.depth_m.pixels.size();
  out.point.assign(n, Vec3f::Zero());
  out.still.assign(n, 0);
  out.frame_noise_m = scan.typical_noise_m();
  out.noise_m = out.frame_noise_m / std::sqrt(double(scan.frames));
  const float limit = scan.frames < 4 ? std::numeric_limits<float>::infinity()
                                      : float(std::max(0.002, 4.0 * out.frame_noise_m));
  float nearest = std::numeric_limits<float>::max();
  out.still_limit_m = limit;
  out.deviation_m = scan.noise_m.pixels;
  for (std::size_t i = 0; i < n; ++i) {
    const float z = scan.depth_m.pixels[i];
    const Vec3f p(rays.x()[i] * z, rays.y()[i] * z, z);
    if (!(z > 0.0f) || !p.allFinite()) continue;
    out.point[i] = p;
    out.still[i] = scan.noise_m.pixels[i] > limit ? 0 : 1;
    if (out.still[i]) nearest = std::min(nearest, z);
  }
  out.nearest_m = nearest;
  return out;
}

std::optional<PlaneEstimate> fit_plane(const ScanPixels& scan, const RayTable& rays,
                                       const std::vector<std::int32_t>& pixels) {
  if (pixels.size() < 10) return std::nullopt;
  // 1 / z = m . (x, y, 1) with m = normal / offset: linear, and noise is in z alone.
  Vec3d m = Vec3d::Zero();
  double limit = std::numeric_limits<double>::infinity();
  Eigen::Matrix3d normal;
  std::vector<double> sizes;
  for (int step = 0; step < 3; ++step) {
    normal.setZero();
    Vec3d right = Vec3d::Zero();
    for (const std::int32_t i : pixels) {
      const auto k = std::size_t(i);
      const double z = scan.point[k].z();
      const Vec3d ray(rays.x()[k], rays.y()[k], 1.0);
      const double size = step == 0 ? 0.0 : std::abs(z * m.dot(ray) - 1.0) / m.norm();
      const double weight = z * z * estimation::huber_weight(size, limit);
      normal += weight * ray * ray.transpose();
      right += weight / z * ray;
    }
    m = estimation::solve_ldlt(normal, right);
    if (!m.allFinite() || !(m.norm() > 1e-9)) return std::nullopt;
    sizes.clear();
    for (const std::int32_t i : pixels) {
      const Vec3d p = scan.point[std::size_t(i)].cast<double>();
      sizes.push_back(std::abs(m.dot(p) - 1.0) / m.norm());
    }
    limit = std::max(estimation::kHuber95 * estimation::kMadToSigma * median(sizes), 1e-9);
  }
  PlaneEstimate out;
  out.plane.normal = m.normalized();
  out.plane.offset = 1.0 / m.norm();
  if (out.plane.offset > 0.0) out.plane = {-out.plane.normal, -out.plane.offset};
  double squares = 0.0;
  for (const double s : sizes) squares += s * s;
  out.rms_m = std::sqrt(squares / double(sizes.size()));
  const double sigma = limit / estimation::kHuber95 * m.norm();  // of z * m . ray - 1
  out.covariance = sigma * sigma * normal.inverse();
  return out;
}

std::vector<FoundPlane> find_planes(const ScanPixels& scan, const RayTable& rays, int most,
                                    std::size_t least_pixels, const RunContext& context) {
  std::vector<FoundPlane> out;
  std::vector<std::uint8_t> free = scan.still;
  const double tolerance = std::clamp(4.0 * scan.noise_m, 0.0025, 0.012);
  for (int round = 0; round < most && !context.cancelled(); ++round) {
    const auto plane = best_hypothesis(scan, free, tolerance, std::uint64_t(round));
    if (!plane) break;
    auto found = refine(scan, rays, free, *plane, tolerance, context);
    if (!found || found->pixels.size() < least_pixels) break;
    for (const std::int32_t i : found->pixels) free[std::size_t(i)] = 0;
    out.push_back(std::move(*found));
  }
  return out;
}

}  // namespace turnscan::detection
