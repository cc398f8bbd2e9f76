#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <vector>

namespace turnscan {
namespace {

using mesh::EdgeTable;
using mesh::next_in_triangle;
using mesh::Triangle;

constexpr std::size_t kMaxCavities = 64;

class MeshChecker {
 public:
  MeshChecker(const TriangleMesh& mesh, const RunContext& context)
      : mesh_(mesh),
        context_(context),
        use_(mesh.triangles.size(), 0),
        broken_(mesh.vertices.size(), 0) {}

  const std::vector<std::uint8_t>& broken() const { return broken_; }

  /// Incomplete once the context is cancelled.
  MeshReport run() {
    report_.vertices = mesh_.vertices.size();
    report_.triangles = mesh_.triangles.size();
    classify_triangles();
    if (!context_.cancelled()) count_edges_and_fans();
    if (context_.cancelled()) return report_;
    measure_pieces();
    report_.closed = !mesh_.triangles.empty() && report_.edges > 0 && report_.boundary_edges == 0;
    report_.manifold = report_.invalid_triangles == 0 && report_.repeated_vertices == 0 &&
                       report_.non_manifold_edges == 0 && report_.non_manifold_vertices == 0;
    report_.oriented = report_.misoriented_edges == 0;
    report_.outward =
        report_.closed && report_.manifold && report_.oriented && pieces_face_outward();
    return report_;
  }

 private:
  Vec3d corner(std::size_t t, int c) const {
    return mesh_.vertices[mesh_.triangles[t][std::size_t(c)]].cast<double>();
  }

  void classify_triangles() {
    std::vector<std::uint8_t> referenced(mesh_.vertices.size(), 0);
    for (std::size_t t = 0; t < use_.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (std::max({a, b, c}) >= mesh_.vertices.size() || !mesh_.vertices[a].allFinite() ||
          !mesh_.vertices[b].allFinite() || !mesh_.vertices[c].allFinite()) {
        ++report_.invalid_triangles;
        continue;
      }
      referenced[a] = referenced[b] = referenced[c] = 1;
      const bool repeated = a == b || b == c || c == a;
      report_.repeated_vertices += repeated;
      use_[t] = !repeated;
      const double area =
          0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm();
      report_.area_m2 += area;
      report_.degenerate_triangles += repeated || !(area > 0.0);
    }
    const auto count = std::size_t(std::count(referenced.begin(), referenced.end(), 1));
    report_.unreferenced_vertices = mesh_.vertices.size() - count;
  }

  std::uint32_t origin(std::uint32_t h) const { return mesh_.triangles[h / 3][h % 3]; }

  void count_edges_and_fans() {
    const EdgeTable edges(mesh_.triangles, mesh_.vertices.size(), use_);
    report_.edges = edges.edge_count();
    DisjointSets fans(3 * mesh_.triangles.size());  // of corners
    for (std::size_t e = 0; e < edges.edge_count() && !context_.cancelled(); ++e) {
      const auto around = edges.half_edges(e);
      if (around.size() != 2)
        for (const std::uint32_t h : {around[0], next_in_triangle(around[0])})
          broken_[origin(h)] = 1;
      report_.boundary_edges += around.size() == 1;
      report_.non_manifold_edges += around.size() > 2;
      report_.misoriented_edges += around.size() == 2 && origin(around[0]) == origin(around[1]);
      for (std::size_t i = 1; i < around.size(); ++i) join_corners(fans, around[0], around[i]);
    }
    std::vector<std::uint8_t> fans_at(mesh_.vertices.size(), 0);
    for (std::uint32_t h = 0; h < 3 * use_.size() && !context_.cancelled(); ++h) {
      if (!use_[h / 3] || fans.root(h) != h) continue;
      std::uint8_t& count = fans_at[origin(h)];
      report_.non_manifold_vertices += count == 1;
      if (count > 0) broken_[origin(h)] = 1;
      count = std::min<std::uint8_t>(2, count + 1);
    }
  }

  void join_corners(DisjointSets& fans, std::uint32_t g, std::uint32_t h) const {
    const std::uint32_t g_end = next_in_triangle(g), h_end = next_in_triangle(h);
    const bool same_way = origin(g) == origin(h);
    fans.join(g, same_way ? h : h_end);
    fans.join(g_end, same_way ? h_end : h);
  }

  void measure_pieces() {
    DisjointSets sets(mesh_.vertices.size());
    for (std::size_t t = 0; t < use_.size(); ++t) {
      if (!use_[t]) continue;
      sets.join(mesh_.triangles[t][0], mesh_.triangles[t][1]);
      sets.join(mesh_.triangles[t][0], mesh_.triangles[t][2]);
    }
    std::vector<std::uint32_t> piece_of_root(mesh_.vertices.size(), ~0u);
    piece_.assign(use_.size(), 0);
    std::size_t triangles = 0;
    for (std::size_t t = 0; t < use_.size(); ++t) {
      if (!use_[t]) continue;
      ++triangles;
      std::uint32_t& piece = piece_of_root[sets.root(mesh_.triangles[t][0])];
      if (piece == ~0u) {
        piece = std::uint32_t(volumes_.size());
        volumes_.push_back(0.0);
        anchors_.push_back(corner(t, 0));
      }
      piece_[t] = piece;
      const Vec3d& o = anchors_[piece];  // near the piece: avoids cancellation far from the origin
      volumes_[piece] += (corner(t, 0) - o).dot((corner(t, 1) - o).cross(corner(t, 2) - o)) / 6.0;
    }
    report_.components = int(volumes_.size());
    for (const double volume : volumes_) report_.volume_m3 += volume;
    const auto referenced = (long long)(mesh_.vertices.size() - report_.unreferenced_vertices);
    report_.euler = referenced - (long long)report_.edges + (long long)triangles;
  }

  bool pieces_face_outward() const {
    std::size_t cavities = 0;
    for (std::uint32_t piece = 0; piece < volumes_.size() && !context_.cancelled(); ++piece) {
      if (volumes_[piece] > 0.0) continue;
      if (++cavities > kMaxCavities || !(volumes_[piece] < 0.0)) return false;
      if (!inside_a_solid_piece(anchors_[piece])) return false;
    }
    return true;
  }

  /// Winding number of the pieces with positive volume around p, by solid angles (Van Oosterom and
  /// Strackee 1983).
  bool inside_a_solid_piece(const Vec3d& p) const {
    double angle = 0.0;
    for (std::size_t t = 0; t < use_.size(); ++t) {
      if (!use_[t] || !(volumes_[piece_[t]] > 0.0)) continue;
      const Vec3d a = corner(t, 0) - p, b = corner(t, 1) - p, c = corner(t, 2) - p;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                                la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle > 2.0 * std::numbers::pi;
  }

  const TriangleMesh& mesh_;
  const RunContext& context_;
  MeshReport report_;
  std::vector<std::uint8_t> use_;     // per triangle: used for edges
  std::vector<std::uint8_t> broken_;  // per vertex
  std::vector<std::uint32_t> piece_;
  std::vector<double> volumes_;
  std::vector<Vec3d> anchors_;  // a vertex of each piece
};

}  // namespace

MeshReport check_mesh(const TriangleMesh& mesh, std::vector<std::uint8_t>* broken) {
  const RunContext context;
  MeshChecker checker(mesh, context);
  const MeshReport report = checker.run();
  if (broken) *broken = checker.broken();
  return report;
}

MeshReport check_surface(const TriangleMesh& mesh, const RunContext& context) {
  MeshReport report = MeshChecker(mesh, context).run();
  report.crossing_edges = self_intersections(mesh, {}, context).edges;
  return report;
}

std::string MeshReport::text() const {
  std::string text = triangles == 0 ? "empty" : watertight() ? "watertight" : "not watertight";
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {} {}", count, what);
  };
  add(invalid_triangles, "invalid triangles");
  add(repeated_vertices, "triangles that repeat a vertex");
  add(boundary_edges, "boundary edges");
  add(non_manifold_edges, "edges of three or more triangles");
  add(non_manifold_vertices, "vertices where surfaces touch");
  add(misoriented_edges, "edges between triangles of opposite orientation");
  add(crossing_edges, "edges that pass through other triangles");
  if (closed && manifold && oriented && !outward) text += ", inside out";
  return text + fmt::format(", {} {}, {} vertices, {} triangles", components,
                            components == 1 ? "piece" : "pieces", vertices, triangles);
}

}  // namespace turnscan
