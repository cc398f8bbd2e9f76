#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/low_pass.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/mesh/vertex_neighbours.hpp>

namespace turnscan {
namespace {

/// Tolerance of the residual relative to the norm of the right side.
constexpr double kTolerance = 1e-3;
constexpr int kMaxIterations = 20000;
/// Edges shorter than this share of the mean are treated as this long.
constexpr double kShortestEdge = 0.5;

using Rows = std::vector<Vec3d>;

/// The ends of boundary edges, which are fixed.
std::vector<std::uint8_t> boundary_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> out(mesh.vertices.size(), 0);
  const mesh::EdgeTable edges(mesh.triangles, mesh.vertices.size());
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto on_edge = edges.half_edges(e);
    if (on_edge.size() != 1) continue;
    out[mesh::origin(mesh, on_edge[0])] = 1;
    out[mesh::origin(mesh, mesh::next_in_triangle(on_edge[0]))] = 1;
  }
  return out;
}

/// (D + L C D^-1 L) u = -L C D^-1 L x, where D holds the number of neighbours, L = D minus the
/// adjacency, x the positions and u their displacements. On an even mesh with edges e, L / D scales
/// a wave of length w by (pi e / w)^2, so C is the inverse square of that.
class LowPass {
 public:
  LowPass(const TriangleMesh& mesh, double wavelength_m)
      : mesh_(mesh), neighbours_(mesh), fixed_(boundary_vertices(mesh)) {
    weigh(wavelength_m);
  }

  Result<std::vector<Vec3f>> solve(const RunContext& context) const {
    Rows moved(size(), Vec3d::Zero());
    Rows residual = start();
    Rows conditioned = precondition(residual), direction = conditioned;
    Vec3d product = dot(residual, conditioned);
    const double wanted = kTolerance * kTolerance * product.sum();
    for (int i = 0; product.sum() > wanted; ++i) {
      if (i % 16 == 0) TURNSCAN_TRY(context.check());
      if (i == kMaxIterations || !product.allFinite())
        return fail(ErrorCode::kLibrary, "smooth: no solution was found; choose a shorter length");
      const Rows image = apply(direction);
      const Vec3d along = dot(direction, image);
      // The three coordinates are solved in parallel; one may converge before the others.
      const Vec3d step = ratio(product, along);
      parallel_for(size(), 4096, [&](std::size_t v) {
        moved[v] += step.cwiseProduct(direction[v]);
        residual[v] -= step.cwiseProduct(image[v]);
      });
      conditioned = precondition(residual);
      const Vec3d next = dot(residual, conditioned), turn = ratio(next, product);
      parallel_for(size(), 4096, [&](std::size_t v) {
        direction[v] = conditioned[v] + turn.cwiseProduct(direction[v]);
      });
      product = next;
    }
    std::vector<Vec3f> out(size());
    for (std::size_t v = 0; v < size(); ++v)
      out[v] = (mesh_.vertices[v].cast<double>() + moved[v]).cast<float>();
    return out;
  }

 private:
  std::size_t size() const { return mesh_.vertices.size(); }
  std::span<const std::uint32_t> around(std::size_t v) const {
    return neighbours_.of(std::uint32_t(v));
  }

  static Vec3d ratio(const Vec3d& a, const Vec3d& b) {
    Vec3d out = Vec3d::Zero();
    for (int c = 0; c < 3; ++c)
      if (b[c] > 0.0) out[c] = a[c] / b[c];
    return out;
  }

  void weigh(double wavelength_m) {
    std::vector<double> edge(size(), 0.0);
    parallel_for(size(), 4096, [&](std::size_t v) {
      for (const std::uint32_t n : around(v))
        edge[v] += double((mesh_.vertices[n] - mesh_.vertices[v]).squaredNorm());
      if (!around(v).empty()) edge[v] = std::sqrt(edge[v] / double(around(v).size()));
    });
    double mean = 0.0;
    for (const double e : edge) mean += e / double(size());
    plate_.assign(size(), 0.0);
    for (std::size_t v = 0; v < size(); ++v) {
      if (around(v).empty()) fixed_[v] = 1;
      if (fixed_[v]) continue;
      const double e = std::max(edge[v], kShortestEdge * mean);
      plate_[v] = std::pow(wavelength_m / (std::numbers::pi * e), 4) / double(around(v).size());
    }
    diagonal_.assign(size(), 1.0);
    parallel_for(size(), 4096, [&](std::size_t v) {
      if (fixed_[v]) return;
      const auto count = double(around(v).size());
      diagonal_[v] = count + plate_[v] * count * count;
      for (const std::uint32_t n : around(v)) diagonal_[v] += plate_[n];
    });
  }

  /// L rows, with the sum of `value` over the neighbours.
  template <class Value>
  Vec3d laplacian(std::size_t v, const Value& value) const {
    Vec3d sum = double(around(v).size()) * value(v);
    for (const std::uint32_t n : around(v)) sum -= value(n);
    return sum;
  }

  Rows plate_of(const Rows& x) const {
    Rows bent(size());
    parallel_for(size(), 4096, [&](std::size_t v) {
      bent[v] = plate_[v] * laplacian(v, [&](std::size_t n) { return x[n]; });
    });
    Rows out(size());
    parallel_for(size(), 4096, [&](std::size_t v) {
      out[v] =
          fixed_[v] ? Vec3d::Zero().eval() : laplacian(v, [&](std::size_t n) { return bent[n]; });
    });
    return out;
  }

  Rows start() const {
    Rows x(size());
    for (std::size_t v = 0; v < size(); ++v)
      x[v] = (mesh_.vertices[v] - mesh_.vertices[0]).cast<double>();
    Rows out = plate_of(x);
    for (Vec3d& row : out) row = -row;
    return out;
  }

  Rows apply(const Rows& u) const {
    Rows out = plate_of(u);
    parallel_for(size(), 4096, [&](std::size_t v) {
      if (!fixed_[v]) out[v] += double(around(v).size()) * u[v];
    });
    return out;
  }

  Rows precondition(const Rows& residual) const {
    Rows out(size());
    parallel_for(size(), 4096, [&](std::size_t v) { out[v] = residual[v] / diagonal_[v]; });
    return out;
  }

  /// In the order of the vertices, so that the sums do not depend on the number of threads.
  static Vec3d dot(const Rows& a, const Rows& b) {
    Vec3d sum = Vec3d::Zero();
    for (std::size_t v = 0; v < a.size(); ++v) sum += a[v].cwiseProduct(b[v]);
    return sum;
  }

  const TriangleMesh& mesh_;
  const mesh::VertexNeighbours neighbours_;
  std::vector<std::uint8_t> fixed_;
  std::vector<double> plate_, diagonal_;
};

}  // namespace

Result<TriangleMesh> low_pass(const TriangleMesh& mesh, double wavelength_m,
                              const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (!(wavelength_m > 0.0) || !std::isfinite(wavelength_m))
    return fail(ErrorCode::kInvalidOption, "smooth: the length must be positive");
  if (mesh.triangles.empty()) return mesh;
  TriangleMesh out = mesh;
  TURNSCAN_ASSIGN(out.vertices, LowPass(mesh, wavelength_m).solve(context));
  if (!out.normals.empty()) out.normals = vertex_normals(out);
  return out;
}

}  // namespace turnscan
