#pragma once
// The harmonic function that continues what is known, on cells of 4 samples: signs and first values
// for what no view saw. Internal.

#include <cmath>
#include <turnscan/reconstruction/volume_samples.hpp>

namespace turnscan::detail {

/// A coarse grid: cells of 4 samples (two a brick), and coarser ones above it.
struct Level {
  Index size{};
  std::vector<float> value;
  std::vector<std::uint8_t> fixed;

  explicit Level(const Index& n) : size(n) {
    const std::size_t count = std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]);
    value.assign(count, 0.0f);
    fixed.assign(count, 0);
  }
  std::size_t at(int i, int j, int k) const {
    return std::size_t(i) +
           std::size_t(size[0]) * (std::size_t(j) + std::size_t(size[1]) * std::size_t(k));
  }
  float clamped(int i, int j, int k) const {
    return value[at(std::clamp(i, 0, size[0] - 1), std::clamp(j, 0, size[1] - 1),
                    std::clamp(k, 0, size[2] - 1))];
  }
};

class Coarse {
 public:
  Coarse(const Volume& volume, bool on_platter)
      : outside_(float(volume.truncation_m)), on_platter_(on_platter) {
    levels_.push_back(finest(volume));
    while (std::max({levels_.back().size[0], levels_.back().size[1], levels_.back().size[2]}) > 4)
      levels_.push_back(halved(levels_.back()));
    for (std::size_t l = levels_.size(); l-- > 0;) {
      if (l + 1 < levels_.size()) prolong(levels_[l + 1], levels_[l]);
      for (int round = 0; round < (l == 0 ? 40 : 30); ++round) relax(levels_[l]);
    }
  }

  float cell(int i, int j, int k) const { return levels_[0].clamped(i, j, k); }
  /// Trilinear between cell centres, at a sample.
  float at_sample(int i, int j, int k) const {
    const float x = (float(i) - 1.5f) / 4.0f, y = (float(j) - 1.5f) / 4.0f,
                z = (float(k) - 1.5f) / 4.0f;
    const int a = int(std::floor(x)), b = int(std::floor(y)), c = int(std::floor(z));
    const float u = x - float(a), v = y - float(b), w = z - float(c);
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
      const int p = corner & 1, q = corner >> 1 & 1, r = corner >> 2;
      sum +=
          (p ? u : 1.0f - u) * (q ? v : 1.0f - v) * (r ? w : 1.0f - w) * cell(a + p, b + q, c + r);
    }
    return sum;
  }

 private:
  static Level finest(const Volume& volume) {
    Level level({2 * volume.bricks[0], 2 * volume.bricks[1], 2 * volume.bricks[2]});
    const auto outside = float(volume.truncation_m);
    for (std::size_t b = 0; b < volume.brick_count(); ++b) {
      const Index at = volume.brick_at(b);
      for (int c = 0; c < 8; ++c) {
        const int p = c & 1, q = c >> 1 & 1, r = c >> 2;
        const std::size_t cell = level.at(2 * at[0] + p, 2 * at[1] + q, 2 * at[2] + r);
        if (volume.slot[b] < 0) {
          level.fixed[cell] = volume.uniform[b] != 0.0f ? 1 : 0;
          level.value[cell] = volume.uniform[b] * outside;
          continue;
        }
        level.fixed[cell] = known_value(volume, b, p, q, r, level.value[cell]) ? 1 : 0;
      }
    }
    return level;
  }

  /// What a cell's samples say to the unknown around them, at least 8 of them known: the mean of
  /// those beside unknown ones, or of all.
  static bool known_value(const Volume& volume, std::size_t brick, int p, int q, int r,
                          float& value) {
    const std::size_t base = std::size_t(volume.slot[brick]) * kCells;
    const float outside = float(volume.truncation_m);
    const auto known_at = [&](int i, int j, int k) {
      return (i | j | k) < 0 || i > 7 || j > 7 || k > 7 ||
             volume.weight[base + within(i, j, k)] > 0.0f;
    };
    int known = 0, border = 0;
    float sum = 0.0f, border_sum = 0.0f;
    for (int k = 4 * r; k < 4 * r + 4; ++k) {
      for (int j = 4 * q; j < 4 * q + 4; ++j) {
        for (int i = 4 * p; i < 4 * p + 4; ++i) {
          const std::size_t s = base + within(i, j, k);
          if (volume.weight[s] == 0.0f) continue;
          const float side = side_of(volume.value[s], outside);
          ++known;
          sum += side;
          if (known_at(i - 1, j, k) && known_at(i + 1, j, k) && known_at(i, j - 1, k) &&
              known_at(i, j + 1, k) && known_at(i, j, k - 1) && known_at(i, j, k + 1))
            continue;
          ++border;
          border_sum += side;
        }
      }
    }
    value = border > 0 ? border_sum / float(border) : sum / float(std::max(known, 1));
    return known >= 8;
  }

  static Level halved(const Level& fine) {
    Level out({(fine.size[0] + 1) / 2, (fine.size[1] + 1) / 2, (fine.size[2] + 1) / 2});
    std::vector<float> sum(out.value.size(), 0.0f);
    std::vector<int> count(out.value.size(), 0);
    for (int k = 0; k < fine.size[2]; ++k) {
      for (int j = 0; j < fine.size[1]; ++j) {
        for (int i = 0; i < fine.size[0]; ++i) {
          if (!fine.fixed[fine.at(i, j, k)]) continue;
          const std::size_t up = out.at(i / 2, j / 2, k / 2);
          sum[up] += fine.value[fine.at(i, j, k)];
          ++count[up];
        }
      }
    }
    for (std::size_t c = 0; c < sum.size(); ++c) {
      out.fixed[c] = count[c] > 0 ? 1 : 0;
      if (count[c] > 0) out.value[c] = sum[c] / float(count[c]);
    }
    return out;
  }

  static void prolong(const Level& coarse, Level& fine) {
    for (int k = 0; k < fine.size[2]; ++k) {
      for (int j = 0; j < fine.size[1]; ++j) {
        for (int i = 0; i < fine.size[0]; ++i) {
          const std::size_t c = fine.at(i, j, k);
          if (!fine.fixed[c]) fine.value[c] = coarse.value[coarse.at(i / 2, j / 2, k / 2)];
        }
      }
    }
  }

  /// One round of Gauss and Seidel. Beyond the grid everything is outside, except under a platter.
  void relax(Level& g) const {
    for (int k = 0; k < g.size[2]; ++k) {
      for (int j = 0; j < g.size[1]; ++j) {
        for (int i = 0; i < g.size[0]; ++i) {
          const std::size_t c = g.at(i, j, k);
          if (g.fixed[c]) continue;
          const float below = on_platter_ ? g.value[c] : outside_;
          float sum = i > 0 ? g.value[g.at(i - 1, j, k)] : outside_;
          sum += i + 1 < g.size[0] ? g.value[g.at(i + 1, j, k)] : outside_;
          sum += j > 0 ? g.value[g.at(i, j - 1, k)] : below;
          sum += j + 1 < g.size[1] ? g.value[g.at(i, j + 1, k)] : outside_;
          sum += k > 0 ? g.value[g.at(i, j, k - 1)] : outside_;
          sum += k + 1 < g.size[2] ? g.value[g.at(i, j, k + 1)] : outside_;
          g.value[c] = sum / 6.0f;
        }
      }
    }
  }

  float outside_;
  bool on_platter_;
  std::vector<Level> levels_;
};

}  // namespace turnscan::detail
