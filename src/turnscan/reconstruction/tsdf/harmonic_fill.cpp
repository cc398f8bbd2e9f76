#include <cmath>
#include <turnscan/reconstruction/tsdf/harmonic_fill.hpp>
#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf {

namespace {

constexpr int kFinestRounds = 40, kCoarseRounds = 30;
constexpr int kCoarsestSide = 4;  // cells
constexpr int kMinKnown = 8;      // of a cell's 64 samples, for it to be fixed

/// Whether a sample of a brick and its neighbours in that brick are known.
bool surrounded(const float* weight, int i, int j, int k) {
  const auto known = [&](int x, int y, int z) {
    return (x | y | z) < 0 || x > 7 || y > 7 || z > 7 || weight[sample_in_brick(x, y, z)] > 0.0f;
  };
  return known(i - 1, j, k) && known(i + 1, j, k) && known(i, j - 1, k) && known(i, j + 1, k) &&
         known(i, j, k - 1) && known(i, j, k + 1);
}

/// Boundary value of a brick's cell (p, q, r) for the unknown around it: the mean of the known
/// samples beside unknown ones, or of all. Returns whether enough of them are known.
bool boundary_of_cell(const Volume& volume, std::size_t brick, int p, int q, int r, float& value) {
  const float* values = &volume.value[volume.first_sample(brick)];
  const float* weights = &volume.weight[volume.first_sample(brick)];
  const auto outside = float(volume.truncation_m);
  int known = 0, border = 0;
  float sum = 0.0f, border_sum = 0.0f;
  for (int k = 4 * r; k < 4 * r + 4; ++k) {
    for (int j = 4 * q; j < 4 * q + 4; ++j) {
      for (int i = 4 * p; i < 4 * p + 4; ++i) {
        const std::size_t s = sample_in_brick(i, j, k);
        if (weights[s] == 0.0f) continue;
        const float own = boundary_value(values[s], outside);
        ++known;
        sum += own;
        if (surrounded(weights, i, j, k)) continue;
        ++border;
        border_sum += own;
      }
    }
  }
  value = border > 0 ? border_sum / float(border) : sum / float(std::max(known, 1));
  return known >= kMinKnown;
}

}  // namespace

Result<HarmonicFill> HarmonicFill::solve(const Volume& volume, const VolumeScale& scale,
                                         const RunContext& context) {
  HarmonicFill fill(finest_level(volume), float(volume.truncation_m), scale.floor_m.has_value());
  auto& levels = fill.levels_;
  mark_below(volume, scale.platters, levels[0]);
  const auto longest = [](const FillLevel& level) {
    const GridCoords& size = level.cells.size();
    return std::max({size[0], size[1], size[2]});
  };
  while (longest(levels.back()) > kCoarsestSide) levels.push_back(halved(levels.back()));
  for (std::size_t l = levels.size(); l-- > 0;) {
    if (l + 1 < levels.size()) prolong(levels[l + 1], levels[l]);
    for (int round = 0; round < (l == 0 ? kFinestRounds : kCoarseRounds); ++round) {
      TURNSCAN_TRY(context.check());
      fill.relax(levels[l]);
    }
  }
  return fill;
}

float HarmonicFill::cell(int i, int j, int k) const {
  const FillLevel& finest = levels_[0];
  const GridCoords& size = finest.cells.size();
  return finest.value[finest.at(std::clamp(i, 0, size[0] - 1), std::clamp(j, 0, size[1] - 1),
                                std::clamp(k, 0, size[2] - 1))];
}

float HarmonicFill::at_sample(int i, int j, int k) const {
  const float x = (float(i) - 1.5f) / 4.0f, y = (float(j) - 1.5f) / 4.0f,
              z = (float(k) - 1.5f) / 4.0f;
  const int a = int(std::floor(x)), b = int(std::floor(y)), c = int(std::floor(z));
  const float u = x - float(a), v = y - float(b), w = z - float(c);
  float sum = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const int p = corner & 1, q = corner >> 1 & 1, r = corner >> 2;
    sum += (p ? u : 1.0f - u) * (q ? v : 1.0f - v) * (r ? w : 1.0f - w) * cell(a + p, b + q, c + r);
  }
  return sum;
}

HarmonicFill::FillLevel HarmonicFill::finest_level(const Volume& volume) {
  const GridCoords& bricks = volume.bricks.size();
  FillLevel level({2 * bricks[0], 2 * bricks[1], 2 * bricks[2]});
  const auto outside = float(volume.truncation_m);
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    const GridCoords at = volume.bricks.coords(b);
    for (int c = 0; c < 8; ++c) {
      const int p = c & 1, q = c >> 1 & 1, r = c >> 2;
      const std::size_t cell = level.at(2 * at[0] + p, 2 * at[1] + q, 2 * at[2] + r);
      if (volume.slot[b] < 0) {
        if (volume.uniform[b] != 0.0f) level.state[cell] = CellState::kFixed;
        level.value[cell] = volume.uniform[b] * outside;
        continue;
      }
      if (boundary_of_cell(volume, b, p, q, r, level.value[cell]))
        level.state[cell] = CellState::kFixed;
    }
  }
  return level;
}

void HarmonicFill::mark_below(const Volume& volume, std::span<const Platter> platters,
                              FillLevel& level) {
  if (platters.empty()) return;
  const GridCoords& size = level.cells.size();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        CellState& state = level.state[level.at(i, j, k)];
        const Vec3d middle =
            volume.origin_m + volume.cell_m * (4.0 * Vec3d(i, j, k).array() + 1.5).matrix();
        if (state == CellState::kUnknown && below_platters(platters, middle) > 0.0)
          state = CellState::kBelowPlatter;
      }
    }
  }
}

/// Cells of twice the side: fixed at the mean of their fixed cells; below a platter if none of them
/// is fixed or unknown.
HarmonicFill::FillLevel HarmonicFill::halved(const FillLevel& fine) {
  const GridCoords& size = fine.cells.size();
  FillLevel out({(size[0] + 1) / 2, (size[1] + 1) / 2, (size[2] + 1) / 2});
  std::vector<float> sum(out.value.size(), 0.0f);
  std::vector<int> count(out.value.size(), 0);
  std::fill(out.state.begin(), out.state.end(), CellState::kBelowPlatter);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const CellState state = fine.state[fine.at(i, j, k)];
        const std::size_t up = out.at(i / 2, j / 2, k / 2);
        if (state == CellState::kUnknown) out.state[up] = CellState::kUnknown;
        if (state != CellState::kFixed) continue;
        sum[up] += fine.value[fine.at(i, j, k)];
        ++count[up];
      }
    }
  }
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (count[c] == 0) continue;
    out.state[c] = CellState::kFixed;
    out.value[c] = sum[c] / float(count[c]);
  }
  return out;
}

void HarmonicFill::prolong(const FillLevel& coarse, FillLevel& fine) {
  const GridCoords& size = fine.cells.size();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const std::size_t c = fine.at(i, j, k);
        if (fine.state[c] != CellState::kFixed)
          fine.value[c] = coarse.value[coarse.at(i / 2, j / 2, k / 2)];
      }
    }
  }
}

/// One round of Gauss-Seidel.
void HarmonicFill::relax(FillLevel& g) const {
  const GridCoords size = g.cells.size();
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const std::size_t c = g.at(i, j, k);
        if (g.state[c] == CellState::kFixed) continue;
        const float below = on_platter_ ? g.value[c] : outside_;
        const bool mirrors = g.state[c] == CellState::kUnknown;
        const auto beside = [&](int x, int y, int z) {
          const std::size_t other = g.at(x, y, z);
          return mirrors && g.state[other] == CellState::kBelowPlatter ? g.value[c]
                                                                       : g.value[other];
        };
        float sum = i > 0 ? beside(i - 1, j, k) : outside_;
        sum += i + 1 < size[0] ? beside(i + 1, j, k) : outside_;
        sum += j > 0 ? beside(i, j - 1, k) : below;
        sum += j + 1 < size[1] ? beside(i, j + 1, k) : outside_;
        sum += k > 0 ? beside(i, j, k - 1) : outside_;
        sum += k + 1 < size[2] ? beside(i, j, k + 1) : outside_;
        g.value[c] = sum / 6.0f;
      }
    }
  }
}

}  // namespace turnscan::tsdf
