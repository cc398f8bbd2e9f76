#include <algorithm>
#include <cmath>
#include <cstdint>
#include <turnscan/core/cube_table.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/implicit_mesh.hpp>

namespace turnscan::objects {

namespace {

constexpr int kBlock = 8;  // cells along a block's side
constexpr int kCorners = kBlock + 1;
// No vertex comes nearer to a grid corner than this part of an edge: two would fall together.
constexpr float kCornerMargin = 0.005f;

using Key = std::uint64_t;  // of a vertex: the grid edge that it lies on
using KeyTriangle = std::array<Key, 3>;

struct Cell {
  int x, y, z;
};

class Mesher {
 public:
  Mesher(const SignedDistance& distance, const ImplicitGrid& grid, const RunContext& context)
      : distance_(distance), grid_(grid), context_(context) {
    const Vec3f size = (grid.max - grid.min) / grid.cell;
    for (int a = 0; a < 3; ++a)
      blocks_[a] = static_cast<int>(std::ceil(size[a] / kBlock)), corners_[a] = blocks_[a] * kBlock;
  }

  Result<TriangleMesh> mesh() const {
    const std::size_t count = std::size_t(blocks_[0]) * blocks_[1] * blocks_[2];
    std::vector<std::vector<KeyTriangle>> blocks(count);
    TURNSCAN_TRY(parallel_for(blocks.size(), 1, context_,
                              [&](std::size_t i) { blocks[i] = triangles_of_block(i); }));
    std::vector<KeyTriangle> triangles;
    for (const auto& block : blocks) triangles.insert(triangles.end(), block.begin(), block.end());
    TURNSCAN_ASSIGN(TriangleMesh out, index(triangles));
    for (int round = 0; round < grid_.smoothing; ++round)
      TURNSCAN_TRY(merge_clustered_vertices(out));
    TURNSCAN_TRY(set_normals(out));
    return out;
  }

 private:
  Vec3f position(int x, int y, int z) const {
    return grid_.min + grid_.cell * Vec3f(float(x), float(y), float(z));
  }

  Key corner_key(const Cell& c) const {
    return (Key(c.z) * (corners_[1] + 1) + c.y) * (corners_[0] + 1) + c.x;
  }

  Cell corner_of(Key key) const {
    const Key nx = corners_[0] + 1, ny = corners_[1] + 1;
    return {int(key % nx), int(key / nx % ny), int(key / nx / ny)};
  }

  std::vector<KeyTriangle> triangles_of_block(std::size_t index) const {
    const int bx = int(index) % blocks_[0], by = int(index) / blocks_[0] % blocks_[1],
              bz = int(index) / blocks_[0] / blocks_[1];
    const Cell origin{bx * kBlock, by * kBlock, bz * kBlock};
    const Vec3f half = Vec3f::Constant(0.5f * kBlock * grid_.cell);
    const float reach = 1.5f * half.norm();
    if (std::abs(distance_(position(origin.x, origin.y, origin.z) + half)) > reach) return {};
    std::vector<float> values(kCorners * kCorners * kCorners);
    std::size_t i = 0;
    for (int z = 0; z < kCorners; ++z)
      for (int y = 0; y < kCorners; ++y)
        for (int x = 0; x < kCorners; ++x, ++i)
          values[i] = distance_(position(origin.x + x, origin.y + y, origin.z + z));
    return triangles_of_values(origin, values);
  }

  std::vector<KeyTriangle> triangles_of_values(const Cell& origin,
                                               const std::vector<float>& values) const {
    std::vector<KeyTriangle> out;
    for (int z = 0; z < kBlock; ++z) {
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) {
          unsigned inside = 0;
          for (unsigned c = 0; c < 8; ++c) {
            const int dx = c & 1, dy = c >> 1 & 1, dz = c >> 2;
            const int at = ((z + dz) * kCorners + y + dy) * kCorners + x + dx;
            inside |= unsigned(values[at] < 0.0f) << c;
          }
          add_cell({origin.x + x, origin.y + y, origin.z + z}, inside, out);
        }
      }
    }
    return out;
  }

  void add_cell(const Cell& cell, unsigned inside, std::vector<KeyTriangle>& out) const {
    for (const CubeTriangle& t : cube_triangles(inside)) {
      KeyTriangle keys;
      for (int k = 0; k < 3; ++k) keys[k] = vertex_key(cell, t[k]);
      out.push_back(keys);
    }
  }

  Key vertex_key(const Cell& cell, int cell_edge) const {
    const CubeEdge edge = cube_edge(cell_edge);
    const Cell corner{cell.x + (edge.corner & 1), cell.y + (edge.corner >> 1 & 1),
                      cell.z + (edge.corner >> 2)};
    return corner_key(corner) * 3 + Key(edge.axis);
  }

  Result<TriangleMesh> index(const std::vector<KeyTriangle>& triangles) const {
    std::vector<Key> keys;
    keys.reserve(triangles.size() * 3);
    for (const KeyTriangle& t : triangles) keys.insert(keys.end(), t.begin(), t.end());
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    TriangleMesh out;
    out.vertices.resize(keys.size());
    TURNSCAN_TRY(parallel_for(keys.size(), 256, context_,
                              [&](std::size_t i) { out.vertices[i] = vertex(keys[i]); }));
    out.triangles.resize(triangles.size());
    parallel_for(triangles.size(), 1024, [&](std::size_t i) {
      for (int k = 0; k < 3; ++k)
        out.triangles[i][k] = static_cast<std::uint32_t>(
            std::lower_bound(keys.begin(), keys.end(), triangles[i][k]) - keys.begin());
    });
    return out;
  }

  Vec3f vertex(Key key) const {
    const Cell c = corner_of(key / 3);
    const Vec3f a = position(c.x, c.y, c.z);
    const Cell d{c.x + (key % 3 == 0), c.y + (key % 3 == 1), c.z + (key % 3 == 2)};
    const Vec3f b = position(d.x, d.y, d.z);
    return a + root_between(a, b) * (b - a);
  }

  /// False position with halving of the end that stays (Illinois; Dowell and Jarratt 1971).
  float root_between(const Vec3f& a, const Vec3f& b) const {
    float t0 = 0.0f, t1 = 1.0f, f0 = distance_(a), f1 = distance_(b), t = 0.5f;
    for (int i = 0; i < 8; ++i) {
      t = (t0 * f1 - t1 * f0) / (f1 - f0);
      const float f = distance_(a + t * (b - a));
      if (std::abs(f) < 1e-4f * grid_.cell) break;
      if ((f < 0.0f) != (f1 < 0.0f)) {
        t0 = t1, f0 = f1;
      } else {
        f0 *= 0.5f;
      }
      t1 = t, f1 = f;
    }
    return std::clamp(t, kCornerMargin, 1.0f - kCornerMargin);
  }

  /// Gradient from the corners of a small tetrahedron.
  Vec3f gradient(const Vec3f& p) const {
    const float e = 0.02f * grid_.cell;
    Vec3f sum = Vec3f::Zero();
    for (const Vec3f& k : {Vec3f(1, -1, -1), Vec3f(-1, -1, 1), Vec3f(-1, 1, -1), Vec3f(1, 1, 1)})
      sum += k * distance_(p + e * k);
    return sum / (4.0f * e);
  }

  Vec3f onto_surface(Vec3f p) const {
    for (int i = 0; i < 2; ++i) {
      const Vec3f g = gradient(p);
      const float square = std::max(g.squaredNorm(), 0.25f);
      p -= std::clamp(distance_(p), -grid_.cell, grid_.cell) / square * g;
    }
    return p;
  }

  Result<> merge_clustered_vertices(TriangleMesh& mesh) const {
    std::vector<Vec3f> sum(mesh.vertices.size(), Vec3f::Zero());
    std::vector<float> count(mesh.vertices.size(), 0.0f);
    for (const auto& t : mesh.triangles) {
      const Vec3f total = mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]];
      for (const std::uint32_t v : t) sum[v] += total - mesh.vertices[v], count[v] += 2.0f;
    }
    return parallel_for(mesh.vertices.size(), 256, context_, [&](std::size_t i) {
      const Vec3f p = mesh.vertices[i];
      mesh.vertices[i] = onto_surface(p + 0.5f * (sum[i] / count[i] - p));
    });
  }

  Result<> set_normals(TriangleMesh& mesh) const {
    mesh.normals.resize(mesh.vertices.size());
    return parallel_for(mesh.vertices.size(), 256, context_, [&](std::size_t i) {
      mesh.normals[i] = gradient(mesh.vertices[i]).normalized();
    });
  }

  const SignedDistance& distance_;
  ImplicitGrid grid_;
  const RunContext& context_;
  std::array<int, 3> blocks_{};
  std::array<int, 3> corners_{};  // cells along each axis; one more corner
};

}  // namespace

Result<TriangleMesh> mesh_of(const SignedDistance& distance, const ImplicitGrid& grid,
                             const RunContext& context) {
  return Mesher(distance, grid, context).mesh();
}

}  // namespace turnscan::objects
