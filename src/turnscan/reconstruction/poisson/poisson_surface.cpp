#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <turnscan/reconstruction/poisson/poisson_surface.hpp>

namespace turnscan::poisson {
namespace {

constexpr std::size_t kMaxGridBytes = std::size_t(4) << 30;
constexpr int kMaxCells = kSide + 2;

/// Coefficients of the finest level around the corners of a brick of the marched grid.
struct CoefficientPatch {
  std::array<float, std::size_t(kMaxCells* kMaxCells* kMaxCells)> value;
  int wide = 0;
};

/// The spline at the corners of a brick of the marched grid, one axis after another.
class CornerInterpolator {
 public:
  /// halved: two corners per cell of the finest level, else one.
  CornerInterpolator(const OctreeLevels& levels, bool halved, double iso)
      : levels_(levels), halved_(halved), offset_(float(kOutside - iso)) {}

  CoefficientPatch patch(const Index& b) const {
    CoefficientPatch out;
    out.wide = halved_ ? kSide / 2 + 2 : kSide + 2;
    const int step = halved_ ? kSide / 2 : kSide;
    const std::size_t finest = levels_.size() - 1;
    levels_[finest].bricks.window(
        levels_[finest].indicator, {b[0] * step - 1, b[1] * step - 1, b[2] * step - 1}, out.wide,
        [&](int i, int j, int k) { return indicator(levels_, finest, i, j, k); }, out.value.data());
    for (int n = 0; n < out.wide * out.wide * out.wide; ++n) out.value[std::size_t(n)] += offset_;
    return out;
  }

  /// Whether both signs are possible: a spline's values are between its coefficients.
  static bool may_cross(const CoefficientPatch& p) {
    const auto [low, high] =
        std::minmax_element(p.value.begin(), p.value.begin() + p.wide * p.wide * p.wide);
    return *low < 0.0f && *high >= 0.0f;
  }

  void values(const CoefficientPatch& p, float* out) const {
    const int w = p.wide;
    std::array<float, std::size_t(kMaxCells * kMaxCells * kSide)> rows;
    std::array<float, std::size_t(kMaxCells * kSide * kSide)> layers;
    for (int r = 0; r < w * w; ++r)
      for (int i = 0; i < kSide; ++i)
        rows[std::size_t(r * kSide + i)] = at(&p.value[std::size_t(r * w)], 1, i);
    for (int k = 0; k < w; ++k)
      for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i)
          layers[std::size_t((k * kSide + j) * kSide + i)] =
              at(&rows[std::size_t(k * w * kSide + i)], kSide, j);
    for (int k = 0; k < kSide; ++k)
      for (int n = 0; n < kSide * kSide; ++n)
        out[k * kSide * kSide + n] = at(&layers[std::size_t(n)], kSide * kSide, k);
  }

 private:
  /// Corner `c` of the brick, from the cells starting with the one before its first.
  float at(const float* cells, int stride, int c) const {
    const float* own = cells + stride * (1 + (halved_ ? c / 2 : c));
    if (halved_ && c % 2 == 1) return 0.75f * own[0] + 0.125f * (own[-stride] + own[stride]);
    return 0.5f * (own[-stride] + own[0]);
  }

  const OctreeLevels& levels_;
  bool halved_;
  float offset_;
};

/// The marched grid with uniform bricks: the indicator at their centres.
Result<BrickGrid> uniform_grid(const OctreeLevels& levels, const Cube& cube, int depth,
                               double iso) {
  const SparseBricks& bricks = levels.back().bricks;
  const bool halved = depth > bricks.depth();
  const int cells = 1 << depth;
  TURNSCAN_ASSIGN(BrickGrid grid, BrickGrid::create(cube.corner, cube.side_m / cells,
                                                    {cells + 1, cells + 1, cells + 1},
                                                    float(kOutside), kMaxGridBytes));
  parallel_for(grid.brick_count(), 64, [&](std::size_t b) {
    const auto at = grid.brick_at(b);
    const auto cell = [&](std::size_t a) {
      return std::min((at[a] * kSide + kSide / 2) >> (halved ? 1 : 0), bricks.cells() - 1);
    };
    grid.uniform(b) = float(kOutside - iso) +
                      indicator_near(levels, levels.size() - 1, cell(0), cell(1), cell(2));
  });
  return grid;
}

/// The marched bricks that the finest level's bricks cover.
std::vector<std::size_t> finest_bricks(const BrickGrid& grid, const SparseBricks& bricks,
                                       bool halved) {
  const int children = halved ? 2 : 1;
  std::vector<std::size_t> out;
  for (std::size_t s = 0; s < bricks.size(); ++s) {
    for (int c = 0; c < children * children * children; ++c) {
      const Index& b = bricks[s];
      out.push_back(grid.brick_index(b[0] * children + c % 2, b[1] * children + c / 2 % 2,
                                     b[2] * children + c / 4));
    }
  }
  return out;
}

/// Marked bricks' neighbours in positive directions, sorted.
std::vector<std::size_t> upper_neighbours(const BrickGrid& grid,
                                          const std::vector<std::size_t>& bricks,
                                          const std::vector<std::uint8_t>& marked) {
  std::vector<std::size_t> out;
  for (const std::size_t b : bricks) {
    if (!marked[b]) continue;
    const auto at = grid.brick_at(b);
    for (int c = 1; c < 8; ++c)
      out.push_back(grid.brick_index(at[0] + (c & 1), at[1] + (c >> 1 & 1), at[2] + (c >> 2)));
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// There are no crossings away from the finest level's bricks, and few in them. A crossing at the
/// upper end of a brick ends in the next one.
Result<std::vector<std::size_t>> crossed_bricks(const BrickGrid& grid,
                                                const std::vector<std::size_t>& finest,
                                                const CornerInterpolator& corners,
                                                const RunContext& context) {
  std::vector<std::uint8_t> crossed(grid.brick_count(), 0);
  const auto mark_crossed = [&](const std::vector<std::size_t>& bricks) {
    parallel_for(bricks.size(), 16, [&](std::size_t n) {
      if (context.cancelled() || crossed[bricks[n]]) return;
      crossed[bricks[n]] =
          CornerInterpolator::may_cross(corners.patch(grid.brick_at(bricks[n]))) ? 1 : 0;
    });
  };
  mark_crossed(finest);
  mark_crossed(upper_neighbours(grid, finest, crossed));
  TURNSCAN_TRY(context.check());
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < crossed.size(); ++b)
    if (crossed[b]) out.push_back(b);
  return out;
}

/// The indicator minus iso at the corners of cells of level `depth`, in the bricks with crossings.
Result<BrickGrid> grid_of(const OctreeLevels& levels, const Cube& cube, int depth, double iso,
                          const RunContext& context) {
  const SparseBricks& bricks = levels.back().bricks;
  const bool halved = depth > bricks.depth();
  TURNSCAN_ASSIGN(BrickGrid grid, uniform_grid(levels, cube, depth, iso));
  const CornerInterpolator corners(levels, halved, iso);
  TURNSCAN_ASSIGN(const auto crossed,
                  crossed_bricks(grid, finest_bricks(grid, bricks, halved), corners, context));
  TURNSCAN_TRY(grid.allocate(crossed));
  parallel_for(crossed.size(), 16, [&](std::size_t t) {
    corners.values(corners.patch(grid.brick_at(crossed[t])), grid.samples(crossed[t]));
  });
  return grid;
}

/// Newton's method along the gradient.
class IsoProjector {
 public:
  IsoProjector(const OctreeLevels& levels, const Cube& cube, double iso)
      : levels_(levels),
        cube_(cube),
        iso_(iso - kOutside),
        cell_m_(cube.side_m / levels.back().bricks.cells()) {}

  Vec3f operator()(const Vec3f& from, double most_m) const {
    const Vec3d start = (from.cast<double>() - cube_.corner) / cell_m_;
    Vec3d p = start;
    for (int step = 0; step < 2; ++step) {
      double value = -iso_;
      const Vec3d gradient = evaluate(p, value);
      const double square = gradient.squaredNorm();
      if (square < kFlat * kFlat) return from;
      p -= value / square * gradient;
    }
    if ((p - start).norm() * cell_m_ > most_m) return from;
    return (cube_.corner + cell_m_ * p).cast<float>();
  }

 private:
  /// If the indicator rises by less than this over a cell it does not determine the position.
  static constexpr double kFlat = 0.02;

  Vec3d evaluate(const Vec3d& p, double& value) const {
    double w[3][3], d[3][3];
    int c[3];
    for (int a = 0; a < 3; ++a) {
      c[a] = int(std::floor(p[a]));
      const double t = p[a] - c[a];
      w[a][0] = 0.5 * (1 - t) * (1 - t), w[a][1] = 0.5 + t - t * t, w[a][2] = 0.5 * t * t;
      d[a][0] = t - 1, d[a][1] = 1 - 2 * t, d[a][2] = t;
    }
    Vec3d gradient = Vec3d::Zero();
    for (int n = 0; n < 27; ++n) {
      const int i = n % 3, j = n / 3 % 3, k = n / 9;
      const double u =
          double(indicator(levels_, levels_.size() - 1, c[0] + i - 1, c[1] + j - 1, c[2] + k - 1));
      value += u * w[0][i] * w[1][j] * w[2][k];
      gradient += u * Vec3d(d[0][i] * w[1][j] * w[2][k], w[0][i] * d[1][j] * w[2][k],
                            w[0][i] * w[1][j] * d[2][k]);
    }
    return gradient;
  }

  const OctreeLevels& levels_;
  const Cube& cube_;
  double iso_, cell_m_;
};

}  // namespace

Result<TriangleMesh> indicator_surface(const OctreeLevels& levels, const Cube& cube, int depth,
                                       double iso, const RunContext& context) {
  TURNSCAN_ASSIGN(const BrickGrid grid, grid_of(levels, cube, depth, iso, context));
  TURNSCAN_ASSIGN(TriangleMesh mesh, isosurface(grid, MarchingCells::kCubes, context));
  const IsoProjector pull(levels, cube, iso);
  parallel_for(mesh.vertices.size(), 256, [&](std::size_t v) {
    mesh.vertices[v] = pull(mesh.vertices[v], 0.25 * grid.cell_m());
  });
  return mesh;
}

}  // namespace turnscan::poisson
