// Orientation by flood fill, and cutting a surface apart where it is not a 2-manifold.

#include <algorithm>
#include <array>
#include <tuple>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

namespace turnscan {
namespace {

using mesh::EdgeTable;
using mesh::kNone;
using mesh::next_in_triangle;
using mesh::origin;
using mesh::previous_in_triangle;
using mesh::Triangle;

constexpr int kMaxCutRounds = 24;

void turn(TriangleMesh& mesh, std::size_t t) {
  std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
}

/// Per half edge its partner on a two-triangle edge, kNone elsewhere.
std::vector<std::uint32_t> partners(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh.triangles, mesh.vertices.size());
  std::vector<std::uint32_t> partner(3 * mesh.triangles.size(), kNone);
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto around = edges.half_edges(e);
    if (around.size() != 2 || around[0] / 3 == around[1] / 3) continue;
    partner[around[0]] = around[1];
    partner[around[1]] = around[0];
  }
  return partner;
}

/// Piece of each triangle, connected by two-triangle edges; `turned` marks the triangles to be
/// flipped so that all agree with the piece's first.
std::size_t flood_orientation(const TriangleMesh& mesh, std::vector<std::uint32_t>& piece,
                              std::vector<std::uint8_t>& turned) {
  const std::vector<std::uint32_t> partner = partners(mesh);
  piece.assign(mesh.triangles.size(), kNone);
  turned.assign(mesh.triangles.size(), 0);
  std::vector<std::uint32_t> queue;
  std::uint32_t pieces = 0;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (piece[seed] != kNone) continue;
    piece[seed] = pieces;
    queue.assign(1, seed);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (std::uint32_t h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
        if (partner[h] == kNone || piece[partner[h] / 3] != kNone) continue;
        const std::uint32_t other = partner[h] / 3;
        const bool disagree = origin(mesh, h) == origin(mesh, partner[h]);
        piece[other] = pieces;
        turned[other] = turned[queue[i]] ^ std::uint8_t(disagree);
        queue.push_back(other);
      }
    }
    ++pieces;
  }
  return pieces;
}

class ManifoldCutter {
 public:
  explicit ManifoldCutter(TriangleMesh& mesh) : mesh_(mesh) {}

  /// One round; true if there was nothing to do.
  bool round() {
    glue();
    const bool split = separate_fans();
    return !split_crowded_edges() && !split;
  }

  void drop_at_crowded_edges() {
    const EdgeTable edges(mesh_.triangles, mesh_.vertices.size());
    std::vector<std::uint8_t> drop(mesh_.triangles.size(), 0);
    for (std::size_t e = 0; e < edges.edge_count(); ++e) {
      const auto around = edges.half_edges(e);
      if (is_sound(around)) continue;
      for (std::size_t i = 1; i < around.size(); ++i) drop[around[i] / 3] = 1;
    }
    mesh::drop_triangles(mesh_, drop);
  }

 private:
  bool is_sound(std::span<const std::uint32_t> around) const {
    return around.size() == 1 ||
           (around.size() == 2 && origin(mesh_, around[0]) != origin(mesh_, around[1]));
  }

  Vec3d position(std::uint32_t v) const { return mesh_.vertices[v].cast<double>(); }

  /// Unit vector in the triangle of h, away from h and perpendicular to it.
  Vec3d into_triangle(std::uint32_t h) const {
    const Vec3d a = position(origin(mesh_, h)), b = position(origin(mesh_, next_in_triangle(h)));
    const Vec3d c = position(origin(mesh_, previous_in_triangle(h)));
    const Vec3d along = (b - a).normalized();
    return (c - a - along * along.dot(c - a)).normalized();
  }

  /// Decides which half edges stay together: for each edge the opposite pairs that continue each
  /// other most smoothly.
  void glue() {
    const EdgeTable edges(mesh_.triangles, mesh_.vertices.size());
    glued_.assign(3 * mesh_.triangles.size(), kNone);
    for (std::size_t e = 0; e < edges.edge_count(); ++e) {
      const auto around = edges.half_edges(e);
      if (around.size() == 1) continue;
      if (around.size() == 2) {
        if (is_sound(around)) join(around[0], around[1]);
      } else {
        glue_smoothest(around);
      }
    }
  }

  void join(std::uint32_t g, std::uint32_t h) {
    glued_[g] = h;
    glued_[h] = g;
  }

  void glue_smoothest(std::span<const std::uint32_t> around) {
    struct Pair {
      double bend;
      std::uint32_t g, h;
      bool operator<(const Pair& o) const {
        return std::tie(bend, g, h) < std::tie(o.bend, o.g, o.h);
      }
    };
    // With more triangles on one edge it is not a surface; pairing them all would take too long.
    constexpr std::size_t kMaxCompared = 64;
    if (around.size() > kMaxCompared) around = around.first(kMaxCompared);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Vec3d in = into_triangle(around[i]);
      for (std::size_t j = i + 1; j < around.size(); ++j) {
        if (origin(mesh_, around[i]) == origin(mesh_, around[j])) continue;
        pairs.push_back({in.dot(into_triangle(around[j])), around[i], around[j]});
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const Pair& pair : pairs) {
      if (glued_[pair.g] == kNone && glued_[pair.h] == kNone) join(pair.g, pair.h);
    }
  }

  /// Gives every fan of glued triangles its own vertex.
  bool separate_fans() {
    DisjointSets fans(glued_.size());
    for (std::uint32_t h = 0; h < glued_.size(); ++h) {
      if (glued_[h] == kNone || glued_[h] < h) continue;
      fans.join(h, next_in_triangle(glued_[h]));
      fans.join(next_in_triangle(h), glued_[h]);
    }
    std::vector<std::uint8_t> taken(mesh_.vertices.size(), 0);
    std::vector<std::uint32_t> vertex_of(glued_.size(), kNone);
    bool split = false;
    for (std::uint32_t h = 0; h < glued_.size(); ++h) {
      const std::uint32_t v = origin(mesh_, h);
      std::uint32_t& vertex = vertex_of[fans.root(h)];
      if (vertex == kNone) {
        vertex = taken[v] != 0 ? mesh::duplicate_vertex(mesh_, v) : v;
        split |= vertex != v;
        taken[v] = 1;
      }
      corners_.push_back(vertex);
    }
    for (std::uint32_t h = 0; h < corners_.size(); ++h) {
      mesh_.triangles[h / 3][h % 3] = corners_[h];
    }
    corners_.clear();
    return split;
  }

  /// Two glued pairs (or open half edges) may still connect the same two vertices. All but the
  /// first are split at their middle, which makes their edges distinct. A triangle is split at most
  /// once per round.
  bool split_crowded_edges() {
    const EdgeTable edges(mesh_.triangles, mesh_.vertices.size());
    std::vector<std::uint8_t> busy(mesh_.triangles.size(), 0);
    bool any = false;
    for (std::size_t e = 0; e < edges.edge_count(); ++e) {
      const auto around = edges.half_edges(e);
      if (is_sound(around)) continue;
      any = true;
      bool first = true;
      for (const std::uint32_t h : around) {
        const std::uint32_t g = glued_[h];
        if (g != kNone && g < h) continue;
        if (!first) split_edge(h, g, busy);
        first = false;
      }
    }
    return any;
  }

  void split_edge(std::uint32_t h, std::uint32_t g, std::vector<std::uint8_t>& busy) {
    if (busy[h / 3] != 0 || (g != kNone && busy[g / 3] != 0)) return;
    const std::uint32_t ends[2] = {origin(mesh_, h), origin(mesh_, next_in_triangle(h))};
    const std::uint32_t middle = mesh::add_mean_vertex(mesh_, ends);
    for (const std::uint32_t side : {h, g}) {
      if (side == kNone) continue;
      busy[side / 3] = 1;
      Triangle half = mesh_.triangles[side / 3];
      half[side % 3] = middle;
      mesh_.triangles[side / 3][next_in_triangle(side) % 3] = middle;
      mesh_.triangles.push_back(half);
    }
  }

  TriangleMesh& mesh_;
  std::vector<std::uint32_t> glued_, corners_;
};

}  // namespace

Result<TriangleMesh> orient_consistently(const TriangleMesh& mesh) {
  TURNSCAN_TRY(validate_mesh(mesh));
  TriangleMesh oriented = mesh;
  std::vector<std::uint32_t> piece;
  std::vector<std::uint8_t> turned;
  flood_orientation(mesh, piece, turned);
  for (std::size_t t = 0; t < turned.size(); ++t) {
    if (turned[t] != 0) turn(oriented, t);
  }
  return oriented;
}

Result<TriangleMesh> orient_outward(const TriangleMesh& mesh) {
  TURNSCAN_ASSIGN(TriangleMesh oriented, orient_consistently(mesh));
  std::vector<std::uint32_t> piece;
  std::vector<std::uint8_t> turned;
  const std::size_t pieces = flood_orientation(oriented, piece, turned);
  std::vector<Vec3d> centroid(pieces, Vec3d::Zero());
  std::vector<double> area(pieces, 0.0), volume(pieces, 0.0);
  const auto corner = [&](std::size_t t, std::size_t c) -> Vec3d {
    return oriented.vertices[oriented.triangles[t][c]].cast<double>();
  };
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const double a = mesh::doubled_area_normal(oriented, t).norm();
    centroid[piece[t]] += a / 3.0 * (corner(t, 0) + corner(t, 1) + corner(t, 2));
    area[piece[t]] += a;
  }
  for (std::size_t p = 0; p < pieces; ++p) {
    if (area[p] > 0.0) centroid[p] /= area[p];
  }
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const Vec3d& o = centroid[piece[t]];
    volume[piece[t]] += (corner(t, 0) - o).dot((corner(t, 1) - o).cross(corner(t, 2) - o));
  }
  for (std::size_t t = 0; t < piece.size(); ++t) {
    if (volume[piece[t]] < 0.0) turn(oriented, t);
  }
  return oriented;
}

Result<TriangleMesh> make_manifold(const TriangleMesh& mesh) {
  TURNSCAN_TRY(validate_mesh(mesh));
  TriangleMesh cut = mesh;
  std::vector<std::uint8_t> drop(cut.triangles.size(), 0);
  for (std::size_t t = 0; t < drop.size(); ++t) {
    const auto& [a, b, c] = cut.triangles[t];
    drop[t] = a == b || b == c || c == a;
  }
  mesh::drop_triangles(cut, drop);
  mesh::compact_vertices(cut);
  for (int round = 0;; ++round) {
    ManifoldCutter cutter(cut);
    if (cutter.round()) break;
    // Triangles stacked many times over may need too many rounds; these end here.
    if (round >= kMaxCutRounds) cutter.drop_at_crowded_edges();
  }
  mesh::compact_vertices(cut);
  return cut;
}

}  // namespace turnscan
