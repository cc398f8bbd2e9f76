#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/mesh/vertex_neighbours.hpp>

namespace turnscan {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double>;
using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The plate's term of a vertex couples all its neighbours with each other: hubs of large fans
/// would fill the matrix, so they get the membrane's.
constexpr std::size_t kLargestPlateDegree = 64;
/// Of a region. The factor then takes some 5 GB.
constexpr std::size_t kMaxUnknowns = 2000000;

/// Movable vertices that are connected, or that touch the same fixed vertex: the plate's term of
/// that vertex couples them. Regions that touch no fixed vertex at all are left out.
std::vector<std::vector<std::uint32_t>> find_regions(const mesh::VertexNeighbours& adjacency,
                                                     const std::vector<std::uint8_t>& movable) {
  std::vector<std::vector<std::uint32_t>> regions;
  std::vector<std::uint8_t> seen(movable.size(), 0);
  for (std::uint32_t seed = 0; seed < movable.size(); ++seed) {
    if (movable[seed] == 0 || seen[seed] != 0) continue;
    std::vector<std::uint32_t> region, queue(1, seed);
    seen[seed] = 1;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t v = queue[i];
      if (movable[v] != 0) region.push_back(v);
      for (const std::uint32_t n : adjacency.of(v)) {
        if (seen[n] != 0 || (movable[v] == 0 && movable[n] == 0)) continue;
        seen[n] = 1;
        queue.push_back(n);
      }
    }
    const bool held = region.size() < queue.size();
    if (held) regions.push_back(std::move(region));
  }
  return regions;
}

/// Minimises (1 - tension) * sum over vertices |sum over neighbours (x_i - x_j)|^2 / degree
/// + tension * sum over edges |x_i - x_j|^2 over one region (Kobbelt, Campagna, Vorsatz, Seidel
/// 1998, "Interactive multi-resolution modeling on arbitrary meshes").
class PlateSystem {
 public:
  PlateSystem(const TriangleMesh& mesh, const mesh::VertexNeighbours& adjacency,
              const std::vector<std::uint32_t>& region, const std::vector<std::uint32_t>& place,
              const RelaxOptions& options)
      : mesh_(mesh), adjacency_(adjacency), region_(region), place_(place) {
    origin_ = mesh.vertices[region[0]].cast<double>();
    right_ = Columns3::Zero(Eigen::Index(region.size()), 3);
    assemble(options.tension);
  }

  Result<> solve(std::vector<Vec3f>& vertices) {
    SparseMatrix matrix(right_.rows(), right_.rows());
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    triplets_ = {};
    const Eigen::SimplicialLLT<SparseMatrix> factors(matrix);  // of the lower triangle
    if (factors.info() != Eigen::Success)
      return fail(ErrorCode::kLibrary, "sparse system: not positive definite; check the mesh");
    const Columns3 moved = factors.solve(right_);
    if (!moved.allFinite())
      return fail(ErrorCode::kLibrary, "sparse system: the solution is not finite; check the mesh");
    for (std::size_t i = 0; i < region_.size(); ++i) {
      const Vec3d p = moved.row(Eigen::Index(i)).transpose() + origin_;
      vertices[region_[i]] = p.cast<float>();
    }
    return {};
  }

 private:
  void assemble(double tension) {
    std::vector<std::uint32_t> rows = region_;
    for (const std::uint32_t v : region_) {
      const auto around = adjacency_.of(v);
      rows.insert(rows.end(), around.begin(), around.end());
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (const std::uint32_t v : rows) {
      const bool hub = adjacency_.of(v).size() > kLargestPlateDegree;
      if (!hub && tension < 1.0) add_plate(v, 1.0 - tension);
      if (hub || tension > 0.0) add_membrane(v, hub ? 1.0 : tension);
    }
  }

  void add_plate(std::uint32_t v, double weight) {
    const auto around = adjacency_.of(v);
    row_.assign(1, {v, double(around.size())});
    for (const std::uint32_t n : around) row_.emplace_back(n, -1.0);
    add_square(weight / double(around.size()));
  }

  /// Half of each edge's term; the other half comes with its other end (or is that of a fixed
  /// edge's end and then counts half, too).
  void add_membrane(std::uint32_t v, double weight) {
    for (const std::uint32_t n : adjacency_.of(v)) {
      row_.assign({{v, 1.0}, {n, -1.0}});
      add_square(0.5 * weight);
    }
  }

  /// Adds weight * (row . x)^2.
  void add_square(double weight) {
    for (const auto& [i, a] : row_) {
      const std::uint32_t row = place_[i];
      if (row == mesh::kNone) continue;
      for (const auto& [j, b] : row_) {
        const std::uint32_t column = place_[j];
        if (column == mesh::kNone) {
          right_.row(row) -=
              weight * a * b * (mesh_.vertices[j].cast<double>() - origin_).transpose();
        } else if (column <= row) {
          triplets_.emplace_back(int(row), int(column), weight * a * b);
        }
      }
    }
  }

  const TriangleMesh& mesh_;
  const mesh::VertexNeighbours& adjacency_;
  const std::vector<std::uint32_t>& region_;
  const std::vector<std::uint32_t>& place_;  // vertex -> row, kNone for fixed ones
  Vec3d origin_;
  Columns3 right_;
  std::vector<Triplet> triplets_;
  std::vector<std::pair<std::uint32_t, double>> row_;
};

}  // namespace

OptionTable describe(RelaxOptions& options) {
  OptionTable table;
  table.number("relax-tension", options.tension, Quantity::kNone, {0.0, 1.0},
               "Stiffness of filled surfaces: 0 is a bent plate, 1 a soap film.");
  return table;
}

Result<TriangleMesh> relax(const TriangleMesh& mesh, const std::vector<std::uint8_t>& movable,
                           const RelaxOptions& options, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  RelaxOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  if (movable.size() != mesh.vertices.size()) {
    return fail(ErrorCode::kInvalidOption,
                "relax: {} marks for {} vertices; give one for each vertex", movable.size(),
                mesh.vertices.size());
  }
  const mesh::VertexNeighbours adjacency(mesh);
  const auto regions = find_regions(adjacency, movable);
  for (const auto& region : regions)
    if (region.size() > kMaxUnknowns)
      return fail(ErrorCode::kResourceLimit,
                  "relax: a region has {} vertices, more than {}; relax fewer at a time",
                  region.size(), kMaxUnknowns);
  std::vector<std::uint32_t> place(mesh.vertices.size(), mesh::kNone);
  for (const auto& region : regions) {
    for (std::size_t i = 0; i < region.size(); ++i) place[region[i]] = std::uint32_t(i);
  }
  TriangleMesh relaxed = mesh;
  TURNSCAN_TRY(parallel_for(regions.size(), 1, context, [&](std::size_t r) {
    PlateSystem system(mesh, adjacency, regions[r], place, options);
    return system.solve(relaxed.vertices);
  }));
  if (!relaxed.normals.empty()) {
    const std::vector<Vec3f> normals = vertex_normals(relaxed);
    for (const auto& region : regions) {
      for (const std::uint32_t v : region) relaxed.normals[v] = normals[v];
    }
  }
  return relaxed;
}

}  // namespace turnscan
