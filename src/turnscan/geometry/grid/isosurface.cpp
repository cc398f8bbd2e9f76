#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <turnscan/core/cube_table.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>

namespace turnscan {
namespace {

constexpr std::size_t kBlock =
    kBrickSide + 1;  // samples along a brick and its upper neighbours' first ones
constexpr std::size_t kMaxTriangles = std::size_t(1) << 30;
/// A vertex keeps at least this fraction of its grid edge's length from the edge's ends, so that
/// triangles do not shrink to nothing. Below 0.5; the topology does not depend on it.
constexpr double kSnap = 0.02;
constexpr float kBeyond = std::numeric_limits<float>::infinity();  // stands for "outside the grid"

using Triangle = std::array<std::uint32_t, 3>;

/// Edges run from a sample towards +x, +y, +z, their sums, and the sum of all: 7 directions, coded
/// as bits x = 1, y = 2, z = 4. Cubes use only the first three.
constexpr std::size_t kDirections = 7;
constexpr int kAllDirections[kDirections] = {1, 2, 3, 4, 5, 6, 7}, kAlongAxes[3] = {1, 2, 4};
constexpr std::size_t kMaskWords = BrickGrid::kBrickSamples * kDirections / 64;

/// The six tetrahedra 0, a, a|b, 7 of a cube as corner codes, with the sign of their orientation.
struct Tetrahedron {
  std::array<int, 4> corner;
  bool odd;
};
constexpr Tetrahedron kTetrahedra[6] = {{{0, 1, 3, 7}, false}, {{0, 2, 6, 7}, false},
                                        {{0, 4, 5, 7}, false}, {{0, 1, 5, 7}, true},
                                        {{0, 2, 3, 7}, true},  {{0, 4, 6, 7}, true}};

/// Even permutations of a tetrahedron's corners that put those of the sign mask first (for masks of
/// one corner and of two; masks of three use their complement).
constexpr std::array<int, 4> kOrder[16] = {{},           {0, 1, 2, 3}, {1, 0, 3, 2}, {0, 1, 2, 3},
                                           {2, 0, 1, 3}, {0, 2, 3, 1}, {1, 2, 0, 3}, {3, 0, 2, 1},
                                           {3, 0, 2, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}, {2, 0, 1, 3},
                                           {2, 3, 0, 1}, {1, 0, 3, 2}, {0, 1, 2, 3}, {}};

struct SampleBlock {
  std::array<float, kBlock * kBlock * kBlock> values;
  static std::size_t at(int i, int j, int k) {
    return std::size_t(i) + kBlock * (std::size_t(j) + kBlock * std::size_t(k));
  }
  static std::size_t corner(int code) { return at(code & 1, code >> 1 & 1, code >> 2); }
};

/// One brick that the surface crosses. Bricks count from -1: the layer below the grid.
struct MarchedBrick {
  GridCoords brick{};
  std::array<std::uint64_t, kMaskWords> crossed{};  // bit sample * 7 + direction - 1
  std::array<std::uint16_t, kMaskWords> rank{};     // set bits before each word
  std::vector<Vec3f> vertices;                      // in the order of the bits
  std::vector<Triangle> triangles;
  std::size_t first_vertex = 0, first_triangle = 0;

  std::uint32_t vertex(std::size_t sample, int direction) const {
    const std::size_t bit = sample * kDirections + std::size_t(direction) - 1;
    const std::uint64_t below = crossed[bit / 64] & ((std::uint64_t(1) << (bit % 64)) - 1);
    return std::uint32_t(first_vertex + rank[bit / 64] + std::size_t(std::popcount(below)));
  }
};

class SurfaceMarcher {
 public:
  SurfaceMarcher(const BrickGrid& grid, MarchingCells cells, const RunContext& context)
      : grid_(grid), cells_(cells), context_(context) {}

  Result<TriangleMesh> run() {
    find_pieces();
    TURNSCAN_TRY(context_.check());
    parallel_for(pieces_.size(), 16, [&](std::size_t p) {
      if (!context_.cancelled()) cross_edges(pieces_[p]);
    });
    if (!finite_) {
      return fail(ErrorCode::kFormat, "isosurface: a value is not finite; check the grid");
    }
    std::size_t vertices = 0, triangles = 0;
    for (MarchedBrick& piece : pieces_) {
      piece.first_vertex = vertices;
      vertices += piece.vertices.size();
    }
    TURNSCAN_TRY(context_.check());
    parallel_for(pieces_.size(), 16, [&](std::size_t p) {
      if (!context_.cancelled()) emit_triangles(pieces_[p]);
    });
    for (MarchedBrick& piece : pieces_) {
      piece.first_triangle = triangles;
      triangles += piece.triangles.size();
    }
    if (triangles > kMaxTriangles) {
      return fail(ErrorCode::kResourceLimit, "isosurface: {} triangles; choose larger cells",
                  triangles);
    }
    TURNSCAN_TRY(context_.check());
    return joined(vertices, triangles);
  }

 private:
  std::span<const int> directions() const {
    if (cells_ == MarchingCells::kCubes) return kAlongAxes;
    return kAllDirections;
  }

  std::size_t table_index(const GridCoords& b) const {
    return piece_grid_.at({b[0] + 1, b[1] + 1, b[2] + 1});
  }

  /// Whether there may be a sign change in or between a brick and its upper neighbours.
  bool may_cross(const GridCoords& b) const {
    bool positive = false, negative = false;
    for (int code = 0; code < 8; ++code) {
      const GridCoords c = {b[0] + (code & 1), b[1] + (code >> 1 & 1), b[2] + (code >> 2)};
      if (!grid_.has_brick(c)) {
        positive = true;
        continue;
      }
      const std::size_t brick = grid_.brick_index(c[0], c[1], c[2]);
      if (grid_.samples(brick) != nullptr) return true;
      (grid_.uniform(brick) < 0.0f ? negative : positive) = true;
    }
    // A negative brick at the upper end may extend beyond size(), where everything is positive.
    const auto& n = grid_.bricks();
    if (negative && (b[0] == n[0] - 1 || b[1] == n[1] - 1 || b[2] == n[2] - 1)) return true;
    return positive && negative;
  }

  void find_pieces() {
    const auto& n = grid_.bricks();
    if (grid_.brick_count() == 0) return;
    piece_grid_ = GridIndex({n[0] + 1, n[1] + 1, n[2] + 1});
    table_.assign(piece_grid_.count(), -1);
    for (int k = -1; k < n[2] && !context_.cancelled(); ++k) {
      for (int j = -1; j < n[1]; ++j) {
        for (int i = -1; i < n[0]; ++i) {
          if (!may_cross({i, j, k})) continue;
          table_[table_index({i, j, k})] = std::int32_t(pieces_.size());
          pieces_.emplace_back().brick = {i, j, k};
        }
      }
    }
  }

  bool gather(const GridCoords& brick, SampleBlock& block) const {
    bool finite = true;
    const auto& size = grid_.size();
    float* out = block.values.data();
    for (int k = brick[2] * kBrickSide; k <= brick[2] * kBrickSide + kBrickSide; ++k) {
      for (int j = brick[1] * kBrickSide; j <= brick[1] * kBrickSide + kBrickSide; ++j) {
        for (int i = brick[0] * kBrickSide; i <= brick[0] * kBrickSide + kBrickSide; ++i, ++out) {
          const bool inside =
              i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
          *out = inside ? grid_.value(i, j, k) : kBeyond;
          finite &= !inside || std::isfinite(*out);
        }
      }
    }
    return finite;
  }

  void cross_edges(MarchedBrick& piece) {
    SampleBlock block;
    if (!gather(piece.brick, block)) finite_ = false;
    std::size_t sample = 0;
    for (int k = 0; k < kBrickSide; ++k) {
      for (int j = 0; j < kBrickSide; ++j) {
        for (int i = 0; i < kBrickSide; ++i, ++sample) {
          const std::size_t base = SampleBlock::at(i, j, k);
          const float from = block.values[base];
          for (const int direction : directions()) {
            const float to = block.values[base + SampleBlock::corner(direction)];
            if ((from < 0.0f) == (to < 0.0f)) continue;
            const std::size_t bit = sample * kDirections + std::size_t(direction) - 1;
            piece.crossed[bit / 64] |= std::uint64_t(1) << (bit % 64);
            piece.vertices.push_back(vertex_on_edge(piece.brick, {i, j, k}, direction, from, to));
          }
        }
      }
    }
    std::size_t before = 0;
    for (std::size_t word = 0; word < kMaskWords; ++word) {
      piece.rank[word] = std::uint16_t(before);
      before += std::size_t(std::popcount(piece.crossed[word]));
    }
  }

  Vec3f vertex_on_edge(const GridCoords& brick, const GridCoords& local, int direction, float from,
                       float to) const {
    double t = 0.5;
    if (from != kBeyond && to != kBeyond) {
      t = std::clamp(double(from) / (double(from) - double(to)), kSnap, 1.0 - kSnap);
    }
    const Vec3d step(direction & 1, direction >> 1 & 1, direction >> 2);
    const Vec3d base =
        grid_.position(brick[0] * kBrickSide + local[0], brick[1] * kBrickSide + local[1],
                       brick[2] * kBrickSide + local[2]);
    return (base + grid_.cell_m() * t * step).cast<float>();
  }

  /// The vertex on the edge between two corners of the cube at `local` of a brick.
  std::uint32_t vertex_between(const GridCoords& brick, const GridCoords& local, int corner_a,
                               int corner_b) const {
    const int low = corner_a & corner_b;  // corners of an edge: one's bits contain the other's
    GridCoords b = brick;
    std::size_t sample = 0;
    for (int axis = 0; axis < 3; ++axis) {
      int x = local[std::size_t(axis)] + (low >> axis & 1);
      if (x == kBrickSide) {
        x = 0;
        ++b[std::size_t(axis)];
      }
      sample |= std::size_t(x) << (3 * axis);
    }
    return pieces_[std::size_t(table_[table_index(b)])].vertex(sample, corner_a ^ corner_b);
  }

  void emit_triangles(MarchedBrick& piece) const {
    SampleBlock block;
    gather(piece.brick, block);
    for (int k = 0; k < kBrickSide; ++k) {
      for (int j = 0; j < kBrickSide; ++j) {
        for (int i = 0; i < kBrickSide; ++i) {
          const std::size_t base = SampleBlock::at(i, j, k);
          unsigned negative = 0;
          for (int code = 0; code < 8; ++code) {
            negative |= unsigned(block.values[base + SampleBlock::corner(code)] < 0.0f) << code;
          }
          if (negative == 0 || negative == 255) continue;
          if (cells_ == MarchingCells::kCubes) {
            emit_cube(piece, {i, j, k}, negative);
          } else {
            for (const Tetrahedron& t : kTetrahedra) emit(piece, {i, j, k}, t, negative);
          }
        }
      }
    }
  }

  void emit_cube(MarchedBrick& piece, const GridCoords& local, unsigned negative) const {
    for (const CubeTriangle& t : cube_triangles(negative)) {
      Triangle triangle;
      for (std::size_t v = 0; v < 3; ++v) {
        const CubeEdge edge = cube_edge(t[v]);
        triangle[v] = vertex_between(piece.brick, local, edge.corner, edge.corner | 1 << edge.axis);
      }
      piece.triangles.push_back(triangle);
    }
  }

  void emit(MarchedBrick& piece, const GridCoords& local, const Tetrahedron& t,
            unsigned negative) const {
    unsigned mask = 0;
    for (std::size_t c = 0; c < 4; ++c) mask |= (negative >> t.corner[c] & 1) << c;
    if (mask == 0 || mask == 15) return;
    const auto& order = kOrder[mask];
    const auto edge = [&](std::size_t a, std::size_t b) {
      return vertex_between(piece.brick, local, t.corner[std::size_t(order[a])],
                            t.corner[std::size_t(order[b])]);
    };
    const int count = std::popcount(mask);
    if (count == 2) {
      // In this order the quadrilateral faces the positive corners.
      const std::uint32_t quad[4] = {edge(0, 2), edge(0, 3), edge(1, 3), edge(1, 2)};
      add(piece, {quad[0], quad[1], quad[2]}, t.odd);
      add(piece, {quad[0], quad[2], quad[3]}, t.odd);
    } else {
      add(piece, {edge(0, 1), edge(0, 2), edge(0, 3)}, t.odd != (count == 3));
    }
  }

  static void add(MarchedBrick& piece, Triangle triangle, bool turn) {
    if (turn) std::swap(triangle[1], triangle[2]);
    piece.triangles.push_back(triangle);
  }

  TriangleMesh joined(std::size_t vertices, std::size_t triangles) const {
    TriangleMesh mesh;
    mesh.vertices.resize(vertices);
    mesh.triangles.resize(triangles);
    parallel_for(pieces_.size(), 64, [&](std::size_t p) {
      const MarchedBrick& piece = pieces_[p];
      std::copy(piece.vertices.begin(), piece.vertices.end(),
                mesh.vertices.begin() + std::ptrdiff_t(piece.first_vertex));
      std::copy(piece.triangles.begin(), piece.triangles.end(),
                mesh.triangles.begin() + std::ptrdiff_t(piece.first_triangle));
    });
    return mesh;
  }

  const BrickGrid& grid_;
  MarchingCells cells_;
  const RunContext& context_;
  GridIndex piece_grid_;             // bricks from -1 on
  std::vector<std::int32_t> table_;  // for these: index of the piece, or -1
  std::vector<MarchedBrick> pieces_;
  std::atomic<bool> finite_{true};
};

}  // namespace

Result<TriangleMesh> isosurface(const BrickGrid& grid, MarchingCells cells,
                                const RunContext& context) {
  return SurfaceMarcher(grid, cells, context).run();
}

}  // namespace turnscan
