#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/poisson/poisson_kernel.hpp>
#include <turnscan/reconstruction/poisson/poisson_levels.hpp>

namespace turnscan::poisson {
namespace {

/// Distance in cells over which a sample contributes to the load: splat and test function reach 1
/// and 2.
constexpr int kReach = 3;
/// Cells of the next finer level that contribute to a brick's.
constexpr int kFiner = 2 * kSide + 2;
/// A surface this close to a brick, in units of the step from inside to outside, may pass through
/// it one level finer.
constexpr float kNear = 0.02f;

/// A coefficient of any field, given access to the field of a level; sign: of the values beyond the
/// faces relative to their mirror images.
template <class Get>
float read(const OctreeLevels& levels, std::size_t level, const Get& get, float sign, int i, int j,
           int k) {
  const SparseBricks& bricks = levels[level].bricks;
  const int last = bricks.cells() - 1;
  float s = 1.0f;
  for (int* x : {&i, &j, &k}) {
    if (*x >= 0 && *x <= last) continue;
    *x = *x < 0 ? -1 - *x : 2 * last + 1 - *x;
    s *= sign;
  }
  const std::ptrdiff_t cell = bricks.cell(i, j, k);
  const Field& field = get(levels[level]);
  if (cell >= 0 && std::size_t(cell) < field.size()) return s * field[std::size_t(cell)];
  if (level == 0 || s == 0.0f) return 0.0f;
  float sum = 0.0f;
  for (int c = 0; c < 8; ++c) {
    // Chaikin's rule: 3/4 of the enclosing cell, 1/4 of the closer neighbour.
    const auto along = [c](int x, int a) {
      return (x >> 1) + ((c >> a & 1) ? (x & 1) * 2 - 1 : 0);
    };
    float weight = 1.0f;
    for (int a = 0; a < 3; ++a) weight *= (c >> a & 1) ? 0.25f : 0.75f;
    sum += weight * read(levels, level - 1, get, sign, along(i, 0), along(j, 1), along(k, 2));
  }
  return s * sum;
}

/// The coefficients of the next coarser level around a brick of this one, refined.
template <class Get>
void refined(const OctreeLevels& levels, std::size_t level, const Get& get, float sign,
             const Index& b, Block& out) {
  std::array<float, 512> coarse;
  levels[level - 1].bricks.window(
      get(levels[level - 1]), {4 * b[0] - 2, 4 * b[1] - 2, 4 * b[2] - 2}, 8,
      [&](int i, int j, int k) { return read(levels, level - 1, get, sign, i, j, k); },
      coarse.data());
  refine(coarse.data(), out.data());
}

void copy_inner(const Block& block, float* to) {
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      std::copy_n(&block[in_block(0, j, k)], kSide, to + in_brick(0, j, k));
}

void add_around(const Index& cell, int reach, SparseBricks& bricks) {
  for (int c = 0; c < 8; ++c) {
    Index b;
    for (std::size_t a = 0; a < 3; ++a) b[a] = (cell[a] + ((c >> a & 1) ? reach : -reach)) >> 3;
    bricks.add(b);
  }
}

void add_sample_bricks(const OrientedSamples& samples, OctreeLevels& levels) {
  levels[0].bricks.add({0, 0, 0});
  for (std::size_t l = levels.size() - 1; l > 0; --l) {
    SparseBricks& bricks = levels[l].bricks;
    samples.for_each_occupied(bricks.depth(),
                              [&](const Index& cell) { add_around(cell, kReach, bricks); });
    if (l + 1 == levels.size()) continue;
    // The bricks from which finer bricks are prolonged, so that their loads can be restricted to
    // them.
    const SparseBricks& finer = levels[l + 1].bricks;
    for (std::size_t s = 0; s < finer.size(); ++s) {
      for (int c = 0; c < 8; ++c) {
        Index b;
        for (std::size_t a = 0; a < 3; ++a) b[a] = (4 * finer[s][a] + ((c >> a & 1) ? 4 : -1)) >> 3;
        bricks.add(b);
      }
    }
  }
  for (OctreeLevel& level : levels) level.solved = level.bricks.size();
}

/// load = divergence of the level's own splats + restriction of the next finer level's load.
void add_load(OctreeLevel& level, const OctreeLevel* finer) {
  level.load.assign(level.solved * kCells, 0.0f);
  parallel_for(level.solved, 4, [&](std::size_t s) {
    Block x, y, z;
    level.bricks.gather(level.own.x, s, x);
    level.bricks.gather(level.own.y, s, y);
    level.bricks.gather(level.own.z, s, z);
    float* own = &level.load[s * kCells];
    divergence(x.data(), y.data(), z.data(), own);
    if (!finer) return;
    const Index& b = level.bricks[s];
    std::array<float, std::size_t(kFiner * kFiner * kFiner)> around;
    const int last = finer->bricks.cells() - 1;
    finer->bricks.window(
        finer->load, {16 * b[0] - 1, 16 * b[1] - 1, 16 * b[2] - 1}, kFiner,
        [&](int i, int j, int k) {
          // One cell beyond a face: the contribution of the mirrored cell to its mirror image.
          float sign = 1.0f;
          for (int* c : {&i, &j, &k}) {
            if (*c >= 0 && *c <= last) continue;
            *c = std::clamp(*c, 0, last);
            sign = -sign;
          }
          const std::ptrdiff_t at = sign < 0.0f ? finer->bricks.cell(i, j, k) : -1;
          return at >= 0 && std::size_t(at) < finer->load.size()
                     ? sign * finer->load[std::size_t(at)]
                     : 0.0f;
        },
        around.data());
    coarsen(around.data(), own);
  });
}

}  // namespace

float indicator(const OctreeLevels& levels, std::size_t level, int i, int j, int k) {
  return read(
      levels, level, [](const OctreeLevel& l) -> const Field& { return l.indicator; }, -1.0f, i, j,
      k);
}

float indicator_near(const OctreeLevels& levels, std::size_t level, int i, int j, int k) {
  for (;; --level, i >>= 1, j >>= 1, k >>= 1) {
    const std::ptrdiff_t cell = levels[level].bricks.cell(i, j, k);
    if (cell >= 0) return levels[level].indicator[std::size_t(cell)];
  }
}

Result<OctreeLevels> make_levels(const OrientedSamples& samples, const RunContext& context) {
  OctreeLevels levels;
  for (int depth = kCoarsest; depth <= samples.deepest(); ++depth) levels.emplace_back(depth);
  add_sample_bricks(samples, levels);
  for (std::size_t l = levels.size(); l-- > 0;) {
    TURNSCAN_TRY(context.check());
    OctreeLevel& level = levels[l];
    level.own.assign(level.solved * kCells);
    samples.splat(level.bricks, level.own.x, level.own.y, level.own.z);
    add_load(level, l + 1 < levels.size() ? &levels[l + 1] : nullptr);
  }
  return levels;
}

Field prolong(OctreeLevels& levels, std::size_t l) {
  OctreeLevel& level = levels[l];
  const std::size_t cells = level.bricks.size() * kCells;
  const bool finest = l + 1 == levels.size();  // its normals are never used
  // Filled separately: a level that has values is read instead of the coarser one.
  Field residual(cells, 0.0f), out(cells, 0.0f);
  VectorField normals;
  if (!finest) normals.assign(cells);
  parallel_for(level.bricks.size(), 4, [&](std::size_t s) {
    const std::size_t first = s * kCells;
    const bool solved = s < level.solved;
    std::array<float, kCells> coarser{}, stiff{};
    if (l > 0) {
      const Index& b = level.bricks[s];
      Block u;
      refined(
          levels, l, [](const OctreeLevel& v) -> const Field& { return v.indicator; }, -1.0f, b, u);
      copy_inner(u, &out[first]);
      if (solved) stiffness(u.data(), stiff.data());
      if (solved || !finest) {
        Block x, y, z;
        refined(
            levels, l, [](const OctreeLevel& v) -> const Field& { return v.normals.x; }, 0.0f, b,
            x);
        refined(
            levels, l, [](const OctreeLevel& v) -> const Field& { return v.normals.y; }, 0.0f, b,
            y);
        refined(
            levels, l, [](const OctreeLevel& v) -> const Field& { return v.normals.z; }, 0.0f, b,
            z);
        if (solved) divergence(x.data(), y.data(), z.data(), coarser.data());
        if (!finest) {
          copy_inner(x, &normals.x[first]);
          copy_inner(y, &normals.y[first]);
          copy_inner(z, &normals.z[first]);
        }
      }
    }
    if (!solved) return;
    for (std::size_t n = first; n < first + kCells; ++n) {
      if (!finest) {
        normals.x[n] += level.own.x[n];
        normals.y[n] += level.own.y[n];
        normals.z[n] += level.own.z[n];
      }
      residual[n] = coarser[n - first] + level.load[n] - stiff[n - first];
    }
  });
  level.normals = std::move(normals);
  level.indicator = std::move(out);
  level.own = VectorField();
  level.load = Field();
  return residual;
}

void add_surface_bricks(OctreeLevels& levels, std::size_t l, double iso) {
  const OctreeLevel& level = levels[l];
  SparseBricks& next = levels[l + 1].bricks;
  const float lowest = float(iso - kOutside) - kNear, highest = float(iso - kOutside) + kNear;
  std::vector<std::uint8_t> crossed(level.bricks.size(), 0);  // one bit per child
  parallel_for(level.bricks.size(), 16, [&](std::size_t s) {
    Block block;
    level.bricks.gather(level.indicator, s, block);
    for (int child = 0; child < 8; ++child) {
      float least = 1e30f, most = -1e30f;
      const Index from{(child & 1) * 4, (child >> 1 & 1) * 4, (child >> 2) * 4};
      // A cell's values are between its coefficient and those of its neighbours. Where a neighbour
      // does not exist 0 was gathered, which may add a brick too many.
      for (int k = -1; k <= 4; ++k)
        for (int j = -1; j <= 4; ++j)
          for (int i = -1; i <= 4; ++i) {
            const float v = block[in_block(from[0] + i, from[1] + j, from[2] + k)];
            least = std::min(least, v), most = std::max(most, v);
          }
      if (least < highest && most > lowest) crossed[s] |= std::uint8_t(1u << child);
    }
  });
  for (std::size_t s = 0; s < crossed.size(); ++s) {
    const Index& b = level.bricks[s];
    for (int c = 0; c < 8; ++c)
      if (crossed[s] >> c & 1)
        next.add({2 * b[0] + (c & 1), 2 * b[1] + (c >> 1 & 1), 2 * b[2] + (c >> 2)});
  }
}

}  // namespace turnscan::poisson
