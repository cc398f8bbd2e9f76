// Merging, dropping, splitting and joining.

#include <algorithm>
#include <array>
#include <bit>
#include <turnscan/core/arc_tangent.hpp>
#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/search/knn.hpp>

namespace turnscan {
namespace {

using mesh::Triangle;

std::uint64_t hash_of(const Vec3f& p) {
  const auto bits = [](float x) { return std::uint64_t(std::bit_cast<std::uint32_t>(x + 0.0f)); };
  return mix64(mix64(bits(p.x()) << 32 | bits(p.y())) ^ bits(p.z()));
}

/// For each vertex the first one at the same position (-0 equals 0), by an open hash table.
std::vector<std::uint32_t> first_at_same_place(const std::vector<Vec3f>& points) {
  constexpr std::uint32_t kFree = ~0u;
  const std::size_t capacity = std::bit_ceil(2 * points.size() + 2);
  std::vector<std::uint32_t> table(capacity, kFree), first(points.size());
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    std::size_t slot = std::size_t(hash_of(points[v])) & (capacity - 1);
    while (table[slot] != kFree && points[table[slot]] != points[v]) {
      slot = (slot + 1) & (capacity - 1);
    }
    if (table[slot] == kFree) table[slot] = v;
    first[v] = table[slot];
  }
  return first;
}

/// Joins chains of vertices within a distance of each other; `first` is idempotent and stays so.
void join_near(const std::vector<Vec3f>& points, double distance_m,
               std::vector<std::uint32_t>& first) {
  std::vector<Vec3f> distinct;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    if (first[v] != v) continue;
    distinct.push_back(points[v]);
    ids.push_back(v);
  }
  const KdTree tree(distinct);
  DisjointSets sets(points.size());
  std::vector<std::pair<std::uint32_t, float>> near;
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    tree.radius(distinct[i], float(distance_m), near);
    for (const auto& [j, squared_distance] : near) sets.join(ids[i], ids[j]);
  }
  for (std::uint32_t& v : first) v = sets.root(v);
}

bool repeats_a_vertex(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

void mark_copies(const std::vector<Triangle>& triangles, std::vector<std::uint8_t>& drop) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Triangle key = triangles[t];
    std::sort(key.begin(), key.end());
    sorted.emplace_back(key, t);
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) drop[sorted[i].second] = 1;
  }
}

}  // namespace

Result<TriangleMesh> merge_vertices(const TriangleMesh& mesh, double tolerance_m) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (!(tolerance_m >= 0.0)) {
    return fail(ErrorCode::kInvalidOption, "merge vertices: tolerance {} m; give 0 or more",
                tolerance_m);
  }
  TriangleMesh merged = mesh;
  mesh::compact_vertices(merged);
  std::vector<std::uint32_t> first = first_at_same_place(merged.vertices);
  if (tolerance_m > 0.0) join_near(merged.vertices, tolerance_m, first);
  std::vector<std::uint8_t> drop(merged.triangles.size(), 0);
  for (std::size_t t = 0; t < merged.triangles.size(); ++t) {
    for (std::uint32_t& v : merged.triangles[t]) v = first[v];
    drop[t] = repeats_a_vertex(merged.triangles[t]);
  }
  mesh::drop_triangles(merged, drop);
  mesh::compact_vertices(merged);
  return merged;
}

Result<TriangleMesh> remove_degenerate(const TriangleMesh& mesh) {
  TURNSCAN_TRY(validate_mesh(mesh));
  TriangleMesh rest = mesh;
  std::vector<std::uint8_t> drop(rest.triangles.size(), 0);
  mark_copies(rest.triangles, drop);
  for (std::size_t t = 0; t < drop.size(); ++t) {
    drop[t] |= repeats_a_vertex(rest.triangles[t]) ||
               !(mesh::doubled_area_normal(rest, t).squaredNorm() > 0.0);
  }
  mesh::drop_triangles(rest, drop);
  mesh::compact_vertices(rest);
  return rest;
}

Result<std::vector<TriangleMesh>> split_components(const TriangleMesh& mesh) {
  TURNSCAN_TRY(validate_mesh(mesh));
  DisjointSets sets(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(a, c);
  }
  std::vector<std::uint32_t> piece_of_root(mesh.vertices.size(), ~0u);
  std::vector<std::vector<std::uint32_t>> pieces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t& piece = piece_of_root[sets.root(mesh.triangles[t][0])];
    if (piece == ~0u) {
      piece = std::uint32_t(pieces.size());
      pieces.emplace_back();
    }
    pieces[piece].push_back(t);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  std::vector<TriangleMesh> parts;
  parts.reserve(pieces.size());
  for (const auto& piece : pieces) parts.push_back(mesh::extract(mesh, piece));
  return parts;
}

TriangleMesh join_meshes(const std::vector<TriangleMesh>& meshes) {
  TriangleMesh joined;
  bool normals = true, colors = true;
  for (const TriangleMesh& mesh : meshes) {
    normals &= mesh.normals.size() == mesh.vertices.size();
    colors &= mesh.colors.size() == mesh.vertices.size();
  }
  for (const TriangleMesh& mesh : meshes) {
    const auto offset = std::uint32_t(joined.vertices.size());
    const auto add = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(joined.vertices, mesh.vertices);
    if (normals) add(joined.normals, mesh.normals);
    if (colors) add(joined.colors, mesh.colors);
    for (const auto& [a, b, c] : mesh.triangles) {
      joined.triangles.push_back({a + offset, b + offset, c + offset});
    }
    if (joined.name.empty()) joined.name = mesh.name;
  }
  return joined;
}

std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh) {
  struct Share {
    Vec3d normal = Vec3d::Zero();
    std::array<double, 3> angle{};
  };
  std::vector<Share> shares(mesh.triangles.size());
  parallel_for(shares.size(), 4096, [&](std::size_t t) {
    const Vec3d normal = mesh::doubled_area_normal(mesh, t).normalized();
    if (!(normal.squaredNorm() > 0.5)) return;
    shares[t].normal = normal;
    const Triangle& v = mesh.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d at = mesh.vertices[v[c]].cast<double>();
      const Vec3d u = mesh.vertices[v[(c + 1) % 3]].cast<double>() - at;
      const Vec3d w = mesh.vertices[v[(c + 2) % 3]].cast<double>() - at;
      // A weight: seven digits suffice.
      shares[t].angle[c] = double(arc_tangent(float(u.cross(w).norm()), float(u.dot(w))));
    }
  });
  std::vector<Vec3d> sums(mesh.vertices.size(), Vec3d::Zero());
  for (std::size_t t = 0; t < shares.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c)
      sums[mesh.triangles[t][c]] += shares[t].normal * shares[t].angle[c];
  }
  std::vector<Vec3f> normals(sums.size());
  parallel_for(sums.size(), 4096,
               [&](std::size_t v) { normals[v] = sums[v].normalized().cast<float>(); });
  return normals;
}

}  // namespace turnscan
