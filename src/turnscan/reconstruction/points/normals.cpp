#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/points/normals.hpp>

namespace turnscan::points {

namespace {

/// Candidates seen from opposite sides of a thin part must not share a plane.
constexpr float kSameSide = 0.2f;

struct Neighbourhood {
  Vec3d sum = Vec3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Vec3d towards = Vec3d::Zero();
  double weight = 0.0;
  std::size_t count = 0;
};

Neighbourhood collect(const Candidates& c, const voxels::VoxelGrid& grid, std::size_t i, double r) {
  const Vec3d p = c.cloud.points[i].cast<double>();
  const voxels::VoxelIndex low = grid.index_of(p - Vec3d::Constant(r));
  const voxels::VoxelIndex high = grid.index_of(p + Vec3d::Constant(r));
  const Vec3f own = c.towards_sensor[i].normalized();
  Neighbourhood out;
  grid.for_each_in_box(low, high, [&](std::uint32_t v) {
    const voxels::VoxelGrid::Voxel& voxel = grid.voxels()[v];
    for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) {
      const std::uint32_t j = grid.order()[k];
      const Vec3d d = c.cloud.points[j].cast<double>() - p;
      const Vec3f& towards = c.towards_sensor[j];
      if (d.squaredNorm() > r * r || own.dot(towards) < kSameSide * towards.norm()) continue;
      const double w = c.cloud.weights[j];
      out.sum += w * d;
      out.squares += w * d * d.transpose();
      out.towards += w * towards.cast<double>();
      out.weight += w;
      ++out.count;
    }
  });
  return out;
}

Vec3f normal_of(const Candidates& c, std::size_t i, const Neighbourhood& n) {
  Vec3d towards = c.towards_sensor[i].cast<double>();
  if (towards.norm() < 0.2) towards = n.towards;  // seen from both sides: as most neighbours
  if (n.count < 3 || !(n.weight > 0.0))
    return towards.norm() > 0.0 ? Vec3f(towards.normalized().cast<float>()) : Vec3f::UnitY();
  const Vec3d mean = n.sum / n.weight;
  const Eigen::Matrix3d covariance = n.squares / n.weight - mean * mean.transpose();
  const Vec3d normal = estimation::symmetric_eigen(covariance).vectors.col(0);
  return (normal.dot(towards) < 0.0 ? Vec3d(-normal) : normal).cast<float>();
}

}  // namespace

Result<> estimate_normals(Candidates& candidates, double radius_m, const RunContext& context) {
  const std::size_t n = candidates.cloud.size();
  context.begin_phase("normals", n);
  TURNSCAN_ASSIGN(const voxels::VoxelGrid grid,
                  voxels::VoxelGrid::build(candidates.cloud.points, 0.5 * radius_m, context));
  std::vector<Vec3f> normals(n);
  TURNSCAN_TRY(parallel_for(n, 256, context, [&](std::size_t i) {
    normals[i] = normal_of(candidates, i, collect(candidates, grid, i, radius_m));
    context.advance();
  }));
  candidates.cloud.normals = std::move(normals);
  return {};
}

}  // namespace turnscan::points
