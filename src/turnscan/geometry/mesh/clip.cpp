#include <algorithm>
#include <cmath>
#include <turnscan/geometry/mesh/clip.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/mesh/planar_outlines.hpp>
#include <utility>

namespace turnscan {

namespace {

using mesh::kNone;
using mesh::next_in_triangle;
using mesh::origin;
using mesh::Outline;
using mesh::previous_in_triangle;
using mesh::Triangle;

/// Vertices nearer to the plane than this are treated as if at this distance inside: edges are cut
/// beside their ends.
constexpr double kNear_m = 1e-6;

class Clipper {
 public:
  Clipper(const TriangleMesh& mesh, const HalfSpace& inside) : in_(mesh), plane_(inside) {}

  Result<ClippedMesh> run() {
    const MeshReport check = check_mesh(in_);
    measure();
    out_.mesh = in_;
    out_.mesh.triangles.clear();
    for (std::uint32_t v = 0; v < in_.vertices.size(); ++v) out_.vertex_source.push_back({v, v});
    cut_edges();
    for (std::uint32_t t = 0; t < in_.triangles.size(); ++t) add_triangle(t);
    if (check.closed && check.manifold && check.oriented) TURNSCAN_TRY(close());
    drop_unused();
    if (!in_.normals.empty()) out_.mesh.normals = vertex_normals(out_.mesh);
    return std::move(out_);
  }

 private:
  void measure() {
    height_.resize(in_.vertices.size());
    for (std::size_t v = 0; v < height_.size(); ++v) {
      const double h = plane_.normal.dot(in_.vertices[v].cast<double>()) - plane_.offset_m;
      height_[v] = std::abs(h) < kNear_m ? kNear_m : h;
    }
  }
  bool inside(std::uint32_t v) const { return height_[v] > 0.0; }

  /// Adds a vertex on each edge that crosses the plane.
  void cut_edges() {
    cut_.assign(3 * in_.triangles.size(), kNone);
    const mesh::EdgeTable edges(in_.triangles, in_.vertices.size());
    for (std::size_t e = 0; e < edges.edge_count(); ++e) {
      const auto around = edges.half_edges(e);
      std::uint32_t a = origin(in_, around[0]), b = origin(in_, next_in_triangle(around[0]));
      if (inside(a) == inside(b)) continue;
      if (a > b) std::swap(a, b);
      const std::uint32_t cut = add_between(a, b);
      for (const std::uint32_t h : around) cut_[h] = cut;
    }
  }

  std::uint32_t add_between(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t both[] = {a, b};
    const std::uint32_t v = mesh::add_mean_vertex(out_.mesh, both);
    const double share = height_[a] / (height_[a] - height_[b]);
    const Vec3d from = in_.vertices[a].cast<double>(), to = in_.vertices[b].cast<double>();
    out_.mesh.vertices[v] = (from + share * (to - from)).cast<float>();
    out_.vertex_source.push_back({a, b});
    return v;
  }

  void add(const Triangle& triangle, std::uint32_t source) {
    out_.mesh.triangles.push_back(triangle);
    out_.source.push_back(source);
  }

  void add_triangle(std::uint32_t t) {
    const Triangle& corners = in_.triangles[t];
    const auto count =
        std::count_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return inside(v); });
    if (count == 3) return add(corners, t);
    if (count == 0) return;
    // The half edge that leaves the corner that is alone on its side.
    std::uint32_t h = 3 * t;
    while (inside(origin(in_, h)) != (count == 1)) ++h;
    const std::uint32_t alone = origin(in_, h), leave = cut_[h];
    const std::uint32_t arrive = cut_[previous_in_triangle(h)];
    if (count == 1) {
      add({alone, leave, arrive}, t);
      cuts_.emplace_back(leave, arrive);
      return;
    }
    const std::uint32_t next = origin(in_, next_in_triangle(h));
    const std::uint32_t last = origin(in_, previous_in_triangle(h));
    add({next, last, arrive}, t);
    add({next, arrive, leave}, t);
    cuts_.emplace_back(arrive, leave);
  }

  /// The cut edges, which have the kept surface to their left, as outlines.
  std::vector<Outline> outlines() const {
    std::vector<std::uint32_t> next(out_.mesh.vertices.size(), kNone);
    for (const auto& [from, to] : cuts_) next[from] = to;
    std::vector<Outline> out;
    for (const auto& cut : cuts_) {
      Outline outline;
      for (std::uint32_t v = cut.first; next[v] != kNone;) {
        outline.push_back(v);
        v = std::exchange(next[v], kNone);
      }
      if (outline.size() > 2) out.push_back(std::move(outline));
    }
    return out;
  }

  Result<> close() {
    const std::vector<Outline> all = outlines();
    if (all.empty()) return {};
    const Vec3d u = plane_.normal.unitOrthogonal(), v = plane_.normal.cross(u);
    std::vector<Eigen::Vector2d> flat(out_.mesh.vertices.size(), Eigen::Vector2d::Zero());
    for (const Outline& outline : all)
      for (const std::uint32_t i : outline) {
        const Vec3d p = out_.mesh.vertices[i].cast<double>();
        flat[i] = {u.dot(p), v.dot(p)};
      }
    if (const auto face = mesh::triangulate_outlines(flat, all))
      for (const Triangle& triangle : *face) add(triangle, ClippedMesh::kCutFace);
    else
      TURNSCAN_TRY(close_each());
    for (std::size_t t = 0; t < out_.source.size(); ++t)
      if (out_.source[t] == ClippedMesh::kCutFace) out_.cut_area_m2 += triangle_area(out_.mesh, t);
    return {};
  }

  Result<> close_each() {
    out_.outlines_cross = true;
    drop_unused();
    FillHolesOptions plain;
    plain.refine = plain.fair = false;
    TURNSCAN_ASSIGN(FilledMesh filled, fill_holes(out_.mesh, plain, {}));
    out_.source.resize(filled.filled.size(), ClippedMesh::kCutFace);
    out_.vertex_source.resize(filled.mesh.vertices.size());
    for (std::size_t t = 0; t < filled.filled.size(); ++t) {
      if (!filled.filled[t]) continue;
      const Triangle& corners = filled.mesh.triangles[t];
      const auto [old, added] = std::minmax_element(corners.begin(), corners.end());
      if (*added >= out_.mesh.vertices.size())
        out_.vertex_source[*added] = out_.vertex_source[*old];
    }
    out_.mesh = std::move(filled.mesh);
    return {};
  }

  void drop_unused() {
    std::vector<std::uint8_t> used(out_.mesh.vertices.size(), 0);
    for (const Triangle& triangle : out_.mesh.triangles)
      for (const std::uint32_t v : triangle) used[v] = 1;
    std::size_t kept = 0;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v]) out_.vertex_source[kept++] = out_.vertex_source[v];
    out_.vertex_source.resize(kept);
    mesh::compact_vertices(out_.mesh);
  }

  const TriangleMesh& in_;
  const HalfSpace& plane_;
  std::vector<double> height_;      ///< per vertex, above the plane, m; never near 0
  std::vector<std::uint32_t> cut_;  ///< per half edge: the vertex where it crosses the plane, or
                                    ///< kNone
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cuts_;  ///< edges in the plane
  ClippedMesh out_;
};

}  // namespace

Result<ClippedMesh> clip(const TriangleMesh& mesh, const HalfSpace& inside) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (!(std::abs(inside.normal.norm() - 1.0) < 1e-9) || !std::isfinite(inside.offset_m))
    return fail(ErrorCode::kInvalidOption, "clip: the plane has no normal of unit length");
  return Clipper(mesh, inside).run();
}

}  // namespace turnscan
