#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/points/base.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::points {

namespace {

/// A wall of the footprint, seen from above: horizontal position and outward normal, and its arc
/// length on the outline.
struct Wall {
  Vec3f p;  ///< y: lowest measured height there
  Vec3f n;  ///< horizontal, unit length
  double length_m = 0.0;
  Rgb color;
};

/// Robust lowest measured height: the 0.5 % quantile.
float lowest_height(const PointCloud& cloud) {
  std::vector<float> y;
  for (const Vec3f& p : cloud.points) y.push_back(p.y());
  const auto low = y.begin() + std::ptrdiff_t(y.size() / 200);
  std::nth_element(y.begin(), low, y.end());
  return *low;
}

/// Candidates of the lowest band, one per cell of the plan.
std::vector<Wall> find_walls(const PointCloud& cloud, double cell_m, double top_m) {
  std::vector<std::uint32_t> picked;
  std::vector<Vec3f> plan;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    const Vec3f& n = cloud.normals[i];
    if (cloud.points[i].y() > top_m || std::hypot(n.x(), n.z()) < 0.3f) continue;
    picked.push_back(i);
    plan.emplace_back(cloud.points[i].x(), 0.0f, cloud.points[i].z());
  }
  std::vector<Wall> walls;
  auto grid = voxels::VoxelGrid::build(plan, cell_m, RunContext());
  if (!grid) return walls;
  for (const voxels::VoxelGrid::Voxel& voxel : grid->voxels()) {
    Wall wall{Vec3f::Zero(), Vec3f::Zero(), 0.0, {}};
    float lowest = static_cast<float>(top_m);
    for (std::uint32_t k = voxel.begin; k < voxel.end; ++k) {
      const std::uint32_t i = picked[grid->order()[k]];
      wall.p += cloud.points[i];
      wall.n += Vec3f(cloud.normals[i].x(), 0.0f, cloud.normals[i].z());
      lowest = std::min(lowest, cloud.points[i].y());
      if (!cloud.colors.empty()) wall.color = cloud.colors[i];
    }
    // Opposite walls of a thin part that share a cell cancel out; such cells are skipped.
    if (wall.n.norm() < 0.3f * float(voxel.count())) continue;
    wall.p /= float(voxel.count());
    wall.p.y() = lowest;
    wall.n.normalize();
    walls.push_back(wall);
  }
  return walls;
}

/// Arc length per wall from the number of walls around it.
void measure_lengths(std::vector<Wall>& walls, double cell_m) {
  std::vector<Vec3f> plan;
  for (const Wall& wall : walls) plan.emplace_back(wall.p.x(), 0.0f, wall.p.z());
  const KdTree tree(plan);
  const double reach = 3.0 * cell_m;
  std::vector<std::pair<std::uint32_t, float>> near;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    tree.radius(plan[i], static_cast<float>(reach), near);
    const auto same_side = std::count_if(near.begin(), near.end(), [&](const auto& hit) {
      return walls[hit.first].n.dot(walls[i].n) > 0.3f;
    });
    walls[i].length_m = 2.0 * reach / double(std::max<std::ptrdiff_t>(1, same_side));
  }
}

/// Winding number of the outline around (x, z), from its oriented pieces (Barill et al. 2018, in
/// the plane): 1 inside, 0 outside and in hollows; gaps of the outline change it only nearby.
double winding_number(const std::vector<Wall>& walls, double x, double z, double cell_m) {
  double sum = 0.0;
  for (const Wall& wall : walls) {
    const double dx = wall.p.x() - x, dz = wall.p.z() - z;
    // Within half a cell the piece is not a point: soften its kernel.
    const double r2 = std::max(dx * dx + dz * dz, 0.25 * cell_m * cell_m);
    sum += wall.length_m * (wall.n.x() * dx + wall.n.z() * dz) / r2;
  }
  return sum / (kTurn);
}

void add(PointCloud& cloud, const Vec3f& p, const Vec3f& n, bool colored, Rgb color) {
  cloud.points.push_back(p);
  cloud.normals.push_back(n);
  cloud.weights.push_back(1.0f);
  if (colored) cloud.colors.push_back(color);
}

const Wall& nearest_wall(const std::vector<Wall>& walls, double x, double z) {
  return *std::min_element(walls.begin(), walls.end(), [&](const Wall& a, const Wall& b) {
    return std::hypot(a.p.x() - x, a.p.z() - z) < std::hypot(b.p.x() - x, b.p.z() - z);
  });
}

}  // namespace

BaseResult close_base(const PointCloud& oriented, double cell_m, double reach_m) {
  BaseResult out;
  if (oriented.size() < 20 || oriented.normals.size() != oriented.size()) return out;
  const float lowest = lowest_height(oriented);
  if (lowest > reach_m) return out;
  std::vector<Wall> walls = find_walls(oriented, cell_m, lowest + 4.0 * cell_m);
  if (walls.size() < 8) return out;
  measure_lengths(walls, cell_m);
  const bool colored = !oriented.colors.empty();
  const float step = static_cast<float>(cell_m);
  for (const Wall& wall : walls) {
    for (float y = wall.p.y() - step; y > 0.25f * step; y -= step) {
      add(out.added, Vec3f(wall.p.x(), y, wall.p.z()), wall.n, colored, wall.color);
      ++out.walls;
    }
  }
  Box box;
  for (const Wall& wall : walls) box.add(wall.p.cast<double>());
  const int x0 = int(std::floor(box.min.x() / cell_m)), x1 = int(std::floor(box.max.x() / cell_m));
  const int z0 = int(std::floor(box.min.z() / cell_m)), z1 = int(std::floor(box.max.z() / cell_m));
  const std::size_t nx = std::size_t(x1 - x0 + 1), nz = std::size_t(z1 - z0 + 1);
  std::vector<std::uint8_t> inside(nx * nz, 0);
  parallel_for(nx * nz, 64, [&](std::size_t i) {
    const double x = (x0 + double(i % nx) + 0.5) * cell_m, z = (z0 + double(i / nx) + 0.5) * cell_m;
    inside[i] = winding_number(walls, x, z, cell_m) > 0.5 ? 1 : 0;
  });
  for (std::size_t i = 0; i < inside.size(); ++i) {
    if (!inside[i]) continue;
    const double x = (x0 + double(i % nx) + 0.5) * cell_m, z = (z0 + double(i / nx) + 0.5) * cell_m;
    add(out.added, Vec3f(float(x), 0.0f, float(z)), -Vec3f::UnitY(), colored,
        colored ? nearest_wall(walls, x, z).color : Rgb());
    out.area_m2 += cell_m * cell_m;
  }
  return out;
}

}  // namespace turnscan::points
