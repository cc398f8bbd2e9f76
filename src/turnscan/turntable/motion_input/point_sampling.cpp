#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/motion_input/point_sampling.hpp>

namespace turnscan::motion {

namespace {

/// Half width of the surface over which a normal is estimated. With a wider one, normals of noses
/// and ears would be so wrong that steps towards the angles overshoot.
constexpr double kWindow_m = 0.004;

struct Normal {
  Vec3d n;
  double sigma;
};

/// Plane through the depth values of a window, in inverse depth.
std::optional<Normal> normal_at(const std::vector<float>& z, int width, int height, int x, int y,
                                int reach, const CameraIntrinsics& camera, double noise_m,
                                double spacing_m) {
  const float middle = z[std::size_t(y) * std::size_t(width) + std::size_t(x)];
  if (x < reach || y < reach || x + reach >= width || y + reach >= height) return std::nullopt;
  const double limit = 2.5 * spacing_m * reach + 4.0 * noise_m;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vec3d right = Vec3d::Zero();
  int count = 0;
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const float there = z[std::size_t(y + v) * std::size_t(width) + std::size_t(x + u)];
      if (!(there > 0.0f) || std::abs(there - middle) > limit) continue;
      const Vec3d a(u, v, 1.0);
      sum += a * a.transpose();
      right += a / double(there);
      ++count;
    }
  }
  const int all = (2 * reach + 1) * (2 * reach + 1);
  if (4 * count < 3 * all) return std::nullopt;
  const Vec3d m = estimation::solve_ldlt(sum, right);
  // A mixed pixel is off the plane of its neighbours.
  double squares = 0.0;
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const float there = z[std::size_t(y + v) * std::size_t(width) + std::size_t(x + u)];
      if (!(there > 0.0f) || std::abs(there - middle) > limit) continue;
      const double off = there - 1.0 / (m.x() * u + m.y() * v + m.z());
      squares += off * off;
    }
  }
  const double rms = std::sqrt(squares / std::max(1, count - 3));
  if (rms > 2.0 * noise_m + 0.25 * spacing_m) return std::nullopt;
  if (std::abs(middle - 1.0 / m.z()) > 3.5 * noise_m + 0.25 * spacing_m) return std::nullopt;
  // 1/z = m . (u, v, 1) with u = fx X/Z + cx - x: multiply out for the plane's normal.
  Normal out;
  out.n = Vec3d(camera.fx * m.x(), camera.fy * m.y(), 0.0);
  out.n.z() = m.z();
  out.sigma = noise_m / (spacing_m * std::sqrt(std::max(1.0, sum(0, 0))));
  return out;
}

/// Converts m of normal_at, given about pixel (x, y), to the unit normal towards the sensor.
Vec3d unit_normal(const Vec3d& scaled, const Vec3d& ray, const Vec3d& p) {
  // 1 = gx (X - ray.x Z) + gy (Y - ray.y Z) + c Z: the normal is (gx, gy, c - gx ray.x - gy ray.y).
  Vec3d n(scaled.x(), scaled.y(), scaled.z() - scaled.x() * ray.x() - scaled.y() * ray.y());
  n.normalize();
  return n.dot(p) > 0.0 ? Vec3d(-n) : n;
}

/// Maximum for scans whose point spacing is below their noise.
constexpr std::size_t kMaxNeighbours = 100;

std::size_t place_of(std::uint64_t key, std::size_t count) {
  return std::size_t(uniform01(key) * double(count));
}

/// Plane through the points nearest to p; nullopt if they are not in a plane.
std::optional<SurfaceSample> plane_at(const FrameSurface& surface, const Vec3f& p,
                                      std::size_t neighbours, const Viewpoint& viewpoint) {
  std::array<std::uint32_t, kMaxNeighbours> index{};
  std::array<float, kMaxNeighbours> squared{};
  if (surface.tree.knn(p, neighbours, index.data(), squared.data()) < neighbours)
    return std::nullopt;
  const std::span near(index.data(), neighbours);
  Vec3d mean = Vec3d::Zero();
  for (const auto i : near) mean += surface.points[i].cast<double>() / double(neighbours);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto i : near) {
    const Vec3d d = surface.points[i].cast<double>() - mean;
    spread += d * d.transpose() / double(neighbours);
  }
  const auto eigen = estimation::symmetric_eigen(spread);
  const Vec3d& e = eigen.values;
  if (!(e[1] > 0.0) || e[0] > 0.05 * e[1]) return std::nullopt;
  Vec3d n = eigen.vectors.col(0);
  if (n.dot(viewpoint.direction_from(p.cast<double>())) < 0.0) n = -n;
  return SurfaceSample{p, n.cast<float>(),
                       float(std::sqrt(std::max(e[0], 0.0) / e[1] / double(neighbours)))};
}

}  // namespace

void sample_depth(const MotionData& data, const RayTable& rays, const DepthForeground& depth,
                  std::uint64_t seed, std::size_t wanted, MotionFrame& frame,
                  std::vector<Vec3f>& cloud) {
  const FrameSurface& surface = depth.surface;
  const std::vector<std::int32_t>& pixels = depth.pixels;
  if (pixels.size() < 50) return;
  // One of each stretch of rows, so that all parts are represented; then another round.
  const double stretch = std::max(1.0, double(pixels.size()) / double(wanted));
  const std::size_t tries = std::min(2 * wanted, 3 * pixels.size());
  for (std::size_t t = 0; t < tries && frame.samples.size() < wanted; ++t) {
    const double place =
        std::fmod((double(t) + uniform01(hash_key(seed, t))) * stretch, double(pixels.size()));
    const auto i = std::size_t(pixels[std::size_t(place)]);
    const int x = int(i) % surface.width, y = int(i) / surface.width;
    const double z = surface.z[i], spacing = z / data.camera.fx;
    const auto pixel = std::size_t(y + surface.top) * std::size_t(data.camera.width) +
                       std::size_t(x + surface.left);
    const Vec3d ray(rays.x()[pixel], rays.y()[pixel], 1.0), p = ray * z;
    if (t % 4 == 0) cloud.push_back(p.cast<float>());
    const int reach = std::clamp(int(std::lround(kWindow_m / spacing)), 1, 6);
    const auto normal = normal_at(surface.z, surface.width, surface.height, x, y, reach,
                                  data.camera, data.noise_m, spacing);
    if (!normal) continue;
    const Vec3d n = unit_normal(normal->n, ray, p);
    if (-n.dot(p.normalized()) < 0.3) continue;
    frame.samples.push_back({p.cast<float>(), n.cast<float>(), float(normal->sigma)});
  }
}

void sample_points(const FrameSurface& surface, const Viewpoint& viewpoint, std::uint64_t seed,
                   std::size_t wanted, MotionFrame& frame, std::vector<Vec3f>& cloud) {
  for (const std::size_t neighbours : {std::size_t{20}, kMaxNeighbours}) {
    frame.samples.clear();
    for (std::size_t t = 0; t < 2 * wanted && frame.samples.size() < wanted; ++t) {
      const Vec3f p = surface.points[place_of(hash_key(seed, t), surface.points.size())];
      if (neighbours != kMaxNeighbours) cloud.push_back(p);
      const auto sample = plane_at(surface, p, neighbours, viewpoint);
      if (sample) frame.samples.push_back(*sample);
    }
    if (frame.samples.size() >= wanted / 4) return;
  }
}

}  // namespace turnscan::motion
