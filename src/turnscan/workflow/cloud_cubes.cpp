#include <turnscan/workflow/cloud_cubes.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <unordered_map>
#include <unordered_set>

namespace turnscan {

namespace {

using Cell = Eigen::Vector3i;

/// Cells of a grid along the axes that has a point in the middle of each.
struct Lattice {
  double edge_m = 0.0;
  std::vector<Cell> cells;  ///< of the points; empty if they do not lie on one
};

/// Median distance of the points to their k-th neighbour, or to the farthest if there are fewer.
double median_distance(const std::vector<Vec3f>& points, std::size_t k) {
  const KdTree tree(points);
  std::vector<float> squared(points.size());
  parallel_for(points.size(), 1024, [&](std::size_t i) {
    std::vector<std::uint32_t> index(k + 1);
    std::vector<float> d(k + 1);
    const std::size_t found = tree.knn(points[i], k + 1, index.data(), d.data());
    squared[i] = found > 0 ? d[found - 1] : 0.0f;
  });
  const auto middle = squared.begin() + std::ptrdiff_t(squared.size() / 2);
  std::nth_element(squared.begin(), middle, squared.end());
  return std::sqrt(double(*middle));
}

Lattice lattice_of(const std::vector<Vec3f>& points) {
  constexpr double kOnGrid = 0.02;        // of an edge; the files' 32-bit floats need 0.001
  constexpr double kMostCells = 1 << 20;  // along an axis: a cell's key has 63 bits
  const double apart = median_distance(points, 1);
  if (!(apart > 0.0)) return {};
  // A distance of neighbours is rounded; over the longest side it is exact.
  const Box box = bounds(points);
  const double longest = box.size().maxCoeff();
  const double edge = longest / std::max(1.0, std::round(longest / apart));
  if (longest > kMostCells * edge) return {};
  std::vector<Cell> cells;
  cells.reserve(points.size());
  for (const Vec3f& p : points) {
    const Vec3d place = (p.cast<double>() - box.min) / edge;
    const Vec3d cell = place.array().round();
    if ((place - cell).cwiseAbs().maxCoeff() > kOnGrid) return {};
    cells.push_back(cell.cast<int>());
  }
  return {edge, std::move(cells)};
}

std::uint64_t key_of(const Cell& cell) {
  return (std::uint64_t(cell.x() + 1) << 42) | (std::uint64_t(cell.y() + 1) << 21) |
         std::uint64_t(cell.z() + 1);
}

/// The largest weight but for 5 % of the points; 0 if there is none.
double high_weight(const std::vector<float>& weights) {
  std::vector<float> sorted;
  for (const float w : weights)
    if (w > 0.0f && std::isfinite(w)) sorted.push_back(w);
  if (sorted.empty()) return 0.0;
  const auto high = sorted.begin() + std::ptrdiff_t(sorted.size() * 95 / 100);
  std::nth_element(sorted.begin(), high, sorted.end());
  return *high;
}

/// The side of a cube towards +axis or -axis.
void add_face(const Vec3f& center, float half, int axis, float side, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  Vec3f out = Vec3f::Zero(), u = Vec3f::Zero(), v = Vec3f::Zero();
  out[axis] = side * half;
  u[(axis + 1) % 3] = half;
  v[(axis + 2) % 3] = side * half;
  for (const Vec3f& corner : {Vec3f(-u - v), Vec3f(u - v), Vec3f(u + v), Vec3f(-u + v)})
    mesh.vertices.push_back(center + out + corner);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

CloudCubes::CloudCubes(const PointCloud& cloud) : cloud_(cloud), colors_(cloud.colors) {
  if (cloud.empty()) return;
  Lattice lattice = lattice_of(cloud.points);
  half_ =
      float(lattice.cells.empty() ? 0.3 * median_distance(cloud.points, 4) : 0.5 * lattice.edge_m);
  cells_ = std::move(lattice.cells);
  if (!colors_.empty()) return;
  brightest_ = high_weight(cloud.weights);
  if (brightest_ > 0.0)
    for (const float w : cloud.weights) colors_.push_back(viridis(w > 0.0f ? w / brightest_ : 0.0));
}

CloudCubes::CloudCubes(const PointCloud& cloud, std::vector<Eigen::Vector3i> cells, float half_m)
    : cloud_(cloud), cells_(std::move(cells)), half_(half_m), colors_(cloud.colors) {}

Result<TriangleMesh> CloudCubes::mesh(double min_weight) const {
  std::vector<std::uint32_t> shown;
  for (std::uint32_t i = 0; i < cloud_.size(); ++i)
    if (cloud_.weights.empty() || cloud_.weights[i] >= min_weight) shown.push_back(i);
  if (shown.empty())
    return fail(ErrorCode::kTooFewPoints, "none of {} points has a weight of {:g} or more",
                cloud_.size(), min_weight);
  std::unordered_set<std::uint64_t> filled;
  if (on_grid()) {
    filled.reserve(shown.size());
    for (const std::uint32_t i : shown) filled.insert(key_of(cells_[i]));
  }
  TriangleMesh mesh;
  for (const std::uint32_t i : shown) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        if (!filled.empty()) {
          Cell next = cells_[i];
          next[axis] += side;
          if (filled.count(key_of(next)) > 0) continue;
        }
        add_face(cloud_.points[i], half_, axis, float(side), mesh);
      }
    }
    if (!colors_.empty()) mesh.colors.resize(mesh.vertices.size(), colors_[i]);
  }
  return mesh;
}

TriangleMesh CloudCubes::coarser(double min_weight) const {
  PointCloud coarse;
  std::vector<Cell> coarse_cells;
  std::unordered_map<std::uint64_t, std::size_t> index;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const float weight = cloud_.weights.empty() ? 1.0f : cloud_.weights[i];
    if (!cloud_.weights.empty() && !(weight >= min_weight)) continue;
    const Cell& cell = cells_[i];
    const Cell odd(cell.x() & 1, cell.y() & 1, cell.z() & 1);
    const auto [at, added] = index.try_emplace(key_of((cell - odd) / 2), coarse.size());
    if (added) {
      coarse_cells.push_back((cell - odd) / 2);
      coarse.points.push_back(cloud_.points[i] +
                              half_ * (Vec3f::Ones() - 2.0f * odd.cast<float>()));
      coarse.weights.push_back(weight);
      if (!colors_.empty()) coarse.colors.push_back(colors_[i]);
    } else if (weight > coarse.weights[at->second]) {
      coarse.weights[at->second] = weight;
      if (!colors_.empty()) coarse.colors[at->second] = colors_[i];
    }
  }
  if (coarse.empty()) return {};
  return CloudCubes(coarse, std::move(coarse_cells), 2.0f * half_)
      .mesh(0.0)
      .value_or(TriangleMesh());
}

Result<TriangleMesh> cubes_of(const PointCloud& cloud, double min_weight,
                              const RunContext& context) {
  const CloudCubes cubes(cloud);
  TURNSCAN_TRY(context.check());
  return cubes.mesh(min_weight);
}

Result<TriangleMesh> read_shown(const std::string& path, double min_weight,
                                const RunContext& context) {
  const bool pcd = ending_of(path) == ".pcd";
  if (!pcd) {
    auto mesh = read_mesh(path, {}, context);
    // A PLY file without triangles is a cloud.
    if (mesh || mesh.error().code != ErrorCode::kTooFewPoints || ending_of(path) != ".ply")
      return mesh;
  }
  TURNSCAN_ASSIGN(const CloudFile file, read_cloud(path));
  auto cubes = cubes_of(file.cloud, min_weight, context);
  if (!cubes) cubes.error().path = path;
  return cubes;
}

}  // namespace turnscan
