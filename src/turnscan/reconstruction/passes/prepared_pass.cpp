#include <cmath>
#include <numeric>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

namespace {

constexpr std::size_t kVoting = 350, kCoarse = 500, kMedium = 4000;
/// Points closer than this in front of a surface may be due to noise, or to the mesh's smoothing.
constexpr double kFreeSigmas = 3.0, kFreeLeast = 0.001;

constexpr std::size_t kColorNeighbors = 12, kMinColored = 5;
constexpr float kSameSide = 0.5f;

double extent(const PassSurface& surface) { return bounds(surface.points).size().norm(); }

Vec3d mean(const std::vector<Vec3f>& points) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3f& p : points) sum += p.cast<double>();
  return sum / double(std::max<std::size_t>(1, points.size()));
}

Eigen::Matrix3d mean_squares(const std::vector<Vec3f>& points, const Vec3d& middle) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vec3f& p : points) {
    const Vec3d d = p.cast<double>() - middle;
    sum += d * d.transpose();
  }
  return sum / double(std::max<std::size_t>(1, points.size()));
}

}  // namespace

std::vector<Eigen::Matrix3f> color_gradients(std::span<const Vec3f> points,
                                             std::span<const Vec3f> normals,
                                             std::span<const Vec3f> colors) {
  std::vector<Eigen::Matrix3f> out(colors.size(), Eigen::Matrix3f::Zero());
  if (colors.empty()) return out;
  const KdTree tree(points);
  parallel_for(points.size(), 256, [&](std::size_t i) {
    if (!colors[i].allFinite()) return;
    std::array<std::uint32_t, kColorNeighbors> near{};
    std::array<float, kColorNeighbors> squared{};
    const std::size_t found = tree.knn(points[i], kColorNeighbors, near.data(), squared.data());
    Eigen::Matrix3f matrix = Eigen::Matrix3f::Zero(), vector = Eigen::Matrix3f::Zero();
    std::size_t known = 0;
    for (std::size_t k = 0; k < found; ++k) {
      if (normals[near[k]].dot(normals[i]) < kSameSide || !colors[near[k]].allFinite()) continue;
      const Vec3f apart = points[near[k]] - points[i];
      const Vec3f along = apart - apart.dot(normals[i]) * normals[i];
      matrix += along * along.transpose();
      vector += (colors[near[k]] - colors[i]) * along.transpose();
      ++known;
    }
    if (known < kMinColored) return;
    const float spread = matrix.trace();
    // The gradient along the normal is zero.
    matrix +=
        spread * normals[i] * normals[i].transpose() + 0.01f * spread * Eigen::Matrix3f::Identity();
    out[i] = vector * matrix.inverse();
  });
  return out;
}

SurfaceLevel::SurfaceLevel(const PassSurface& surface, std::size_t count, int side,
                           double reach_share)
    : samples(thinned(surface, count)),
      reach_m(reach_share * extent(surface)),
      nearest(samples, side, reach_m),
      color_gradients(passes::color_gradients(samples.points, samples.normals, samples.colors)) {}

PreparedPass::PreparedPass(const PassSurface& pass)
    : surface(&pass),
      extent_m(extent(pass)),
      area_m2(std::accumulate(pass.areas.begin(), pass.areas.end(), 0.0)),
      votes(pass, kVoting, 1, 0.0),
      coarse(pass, kCoarse, 48, 0.12),
      medium(pass, kMedium, 72, 0.03),
      middle(mean(coarse.samples.points)),
      scatter(mean_squares(coarse.samples.points, middle)),
      free(pass, kFreeSigmas * pass.noise_m + kFreeLeast),
      tree(pass.points),
      color_gradients(passes::color_gradients(pass.points, pass.normals, pass.colors)),
      beside_m(float(1.3 * std::sqrt(area_m2 / double(pass.points.size())))) {}

}  // namespace turnscan::passes
