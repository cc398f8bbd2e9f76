// What no view saw: decided by what lies around it.

#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/volume.hpp>

namespace turnscan {

namespace {

using Index = Volume::Index;
constexpr int kSide = Volume::kSide;
constexpr std::size_t kCells = detail::kBrickCells;

constexpr std::size_t within(int i, int j, int k) {
  return std::size_t(i & 7) + std::size_t(j & 7) * 8 + std::size_t(k & 7) * 64;
}

/// What a known distance says to the unknown beside it: its side more than its length. Inside,
/// distances are known only as far as measurements reach, while what is clear has all of the
/// truncation; by lengths, what is invented would sink into the object.
float side_of(float distance, float outside) {
  return std::clamp(3.0f * distance, -outside, outside);
}

/// Samples of a volume by their position, bricks without samples included.
class Samples {
 public:
  explicit Samples(const Volume& volume) : v_(volume) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = volume.bricks[a] * kSide;
  }
  const Index& size() const { return size_; }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size_[0] && j < size_[1] && k < size_[2];
  }
  std::size_t brick(int i, int j, int k) const { return v_.brick_index({i >> 3, j >> 3, k >> 3}); }
  /// Position among all samples, or -1 where there are none.
  std::ptrdiff_t at(int i, int j, int k) const {
    const std::int32_t slot = v_.slot[brick(i, j, k)];
    return slot < 0 ? -1 : std::ptrdiff_t(std::size_t(slot) * kCells + within(i, j, k));
  }
  float value(int i, int j, int k) const {
    const std::ptrdiff_t s = at(i, j, k);
    return s >= 0 ? v_.value[std::size_t(s)] : v_.uniform[brick(i, j, k)] * float(v_.truncation_m);
  }

 private:
  const Volume& v_;
  Index size_{};
};

/// Values and weights of a brick and one layer of samples around it.
struct Halo {
  static constexpr int kWide = kSide + 2;
  std::array<float, kWide * kWide * kWide> value, weight;
  static std::size_t at(int i, int j, int k) {
    return std::size_t(i + 1) + kWide * (std::size_t(j + 1) + kWide * std::size_t(k + 1));
  }

  void gather(const Volume& v, const Samples& samples, const Index& b) {
    std::size_t out = 0;
    const auto& size = samples.size();
    for (int k = b[2] * kSide - 1; k <= b[2] * kSide + kSide; ++k) {
      for (int j = b[1] * kSide - 1; j <= b[1] * kSide + kSide; ++j) {
        for (int i = b[0] * kSide - 1; i <= b[0] * kSide + kSide; ++i, ++out) {
          // Beyond the volume its last samples go on.
          const int x = std::clamp(i, 0, size[0] - 1), y = std::clamp(j, 0, size[1] - 1),
                    z = std::clamp(k, 0, size[2] - 1);
          const std::ptrdiff_t s = samples.at(x, y, z);
          value[out] = s >= 0 ? v.value[std::size_t(s)] : samples.value(x, y, z);
          weight[out] = s >= 0 ? v.weight[std::size_t(s)] : 0.0f;
        }
      }
    }
  }
};

std::vector<std::size_t> touched_bricks(const Volume& volume) {
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    if (volume.slot[b] >= 0) out.push_back(b);
  }
  return out;
}

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

/// Which samples that are not inside can be reached, from one to the next, from beyond the volume:
/// a bit each, brick by brick.
class Flood {
 public:
  explicit Flood(const Volume& volume)
      : v_(volume), open_(volume.brick_count()), reached_(volume.brick_count()) {
    parallel_for(v_.brick_count(), 64, [&](std::size_t b) {
      const std::int32_t slot = v_.slot[b];
      for (std::size_t k = 0; k < kSide; ++k) {
        std::uint64_t bits = v_.uniform[b] < 0.0f ? 0 : ~std::uint64_t(0);
        if (slot >= 0) {
          bits = 0;
          const float* value = &v_.value[std::size_t(slot) * kCells + 64 * k];
          for (std::size_t c = 0; c < 64; ++c) bits |= std::uint64_t(value[c] < 0.0f ? 0 : 1) << c;
        }
        open_[b][k] = bits;
      }
    });
  }

  void run() {
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      const Index at = v_.brick_at(b);
      for (std::size_t a = 0; a < 3; ++a) {
        if (at[a] == 0) enter(b, face(int(a), 0));
        if (at[a] + 1 == v_.bricks[a]) enter(b, face(int(a), kSide - 1));
      }
    }
    while (!work_.empty()) {
      const std::size_t b = work_.back();
      work_.pop_back();
      spread(b);
      leave(b);
    }
  }

  bool reached(std::size_t brick, std::size_t cell) const {
    return (reached_[brick][cell >> 6] >> (cell & 63) & 1) != 0;
  }

 private:
  using Bits = std::array<std::uint64_t, kSide>;  // a layer in each word, i fastest
  static constexpr std::uint64_t kColumn = 0x0101010101010101u, kRow = 0xffu;

  /// All samples of the outermost layer on one side.
  static Bits face(int axis, int layer) {
    Bits out{};
    for (int k = 0; k < kSide; ++k) {
      if (axis == 0) out[std::size_t(k)] = kColumn << layer;
      if (axis == 1) out[std::size_t(k)] = kRow << (8 * layer);
      if (axis == 2) out[std::size_t(k)] = k == layer ? ~std::uint64_t(0) : 0;
    }
    return out;
  }

  void enter(std::size_t b, const Bits& from) {
    bool any = false;
    for (std::size_t k = 0; k < kSide; ++k) {
      const std::uint64_t more = from[k] & open_[b][k] & ~reached_[b][k];
      reached_[b][k] |= more;
      any |= more != 0;
    }
    if (any) work_.push_back(b);
  }

  /// Within a brick.
  void spread(std::size_t b) {
    Bits& r = reached_[b];
    const Bits& open = open_[b];
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 0; k < kSide; ++k) {
        std::uint64_t next = r[k] | r[k] << 8 | r[k] >> 8;
        next |= (r[k] & ~(kColumn << 7)) << 1 | (r[k] & ~kColumn) >> 1;
        if (k > 0) next |= r[k - 1];
        if (k + 1 < kSide) next |= r[k + 1];
        next &= open[k];
        changed |= next != r[k];
        r[k] = next;
      }
    }
  }

  /// Into the bricks around.
  void leave(std::size_t b) {
    const Index at = v_.brick_at(b);
    const Bits& r = reached_[b];
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Index next = at;
        next[std::size_t(axis)] += side;
        if (!v_.contains(next)) continue;
        const Bits own = face(axis, side < 0 ? 0 : kSide - 1);
        Bits out{};
        for (std::size_t k = 0; k < kSide; ++k) {
          const std::uint64_t bits = r[k] & own[k];
          if (axis == 0) out[k] = side < 0 ? bits << 7 : bits >> 7;
          if (axis == 1) out[k] = side < 0 ? bits << 56 : bits >> 56;
        }
        if (axis == 2) out[side < 0 ? kSide - 1 : 0] = r[side < 0 ? 0 : kSide - 1];
        enter(v_.brick_index(next), out);
      }
    }
  }

  const Volume& v_;
  std::vector<Bits> open_, reached_;
  std::vector<std::size_t> work_;
};

class Closing {
 public:
  Closing(Volume& volume, const VolumeScale& scale) : v_(volume), scale_(scale), samples_(volume) {}

  void run() {
    if (scale_.floor_m) drop_below_floor();
    const Coarse coarse(v_, scale_.floor_m.has_value());
    adopt(coarse);
    for (int round = 0; round < 8; ++round) {
      relax(round == 0 ? 24 : 8);
      if (!extend(coarse)) break;
    }
    if (scale_.floor_m) stand();
    fill_enclosed();
  }

 private:
  /// First layer of samples that is looked up.
  int floor_row() const {
    return std::max(0, int(std::ceil((*scale_.floor_m - v_.origin_m.y()) / v_.cell_m)));
  }

  void drop_below_floor() {
    const int floor = floor_row();
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      const Index at = v_.brick_at(b);
      if (at[1] * kSide >= floor) continue;
      if (v_.slot[b] < 0) {
        if (at[1] * kSide + kSide <= floor) v_.uniform[b] = 0.0f;
        continue;
      }
      for (int j = 0; j < kSide && at[1] * kSide + j < floor; ++j) {
        for (int c = 0; c < 64; ++c)
          v_.weight[std::size_t(v_.slot[b]) * kCells + within(c & 7, j, c >> 3)] = 0.0f;
      }
    }
  }

  void touch_from(const Coarse& coarse, std::size_t b) {
    const Index at = v_.brick_at(b);
    const float known = v_.uniform[b];
    v_.touch(b, known * scale_start());
    const std::size_t base = std::size_t(v_.slot[b]) * kCells;
    for (int k = 0; k < kSide; ++k) {
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const std::size_t s = base + within(i, j, k);
          if (known > 0.0f)
            v_.weight[s] = 1.0f;  // seen empty, and stays so
          else
            v_.value[s] = coarse.at_sample(at[0] * kSide + i, at[1] * kSide + j, at[2] * kSide + k);
        }
      }
    }
    if (known <= 0.0f) free_[b] = 1;
  }
  float scale_start() const { return float(v_.truncation_m); }

  /// Signs for bricks without samples, samples for those through which the surface may go, and
  /// first values for what is unknown.
  void adopt(const Coarse& coarse) {
    free_.assign(v_.brick_count(), 0);
    std::vector<std::size_t> crossing;
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      const Index at = v_.brick_at(b);
      if (v_.slot[b] >= 0) {
        start_unknown(coarse, b, at);
        continue;
      }
      if (v_.uniform[b] > 0.0f) continue;
      bool negative = false, positive = false;
      for (int k = -1; k < 3; ++k) {
        for (int j = -1; j < 3; ++j) {
          for (int i = -1; i < 3; ++i)
            (coarse.cell(2 * at[0] + i, 2 * at[1] + j, 2 * at[2] + k) < 0.0f ? negative
                                                                             : positive) = true;
        }
      }
      if (negative && positive)
        crossing.push_back(b);
      else
        v_.uniform[b] = negative ? -1.0f : 1.0f;
      if (!(negative && positive)) guessed_.push_back(b);
    }
    for (const std::size_t b : crossing) touch_from(coarse, b);
  }

  void start_unknown(const Coarse& coarse, std::size_t b, const Index& at) {
    for (int k = 0; k < kSide; ++k) {
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) {
          const std::size_t s = std::size_t(v_.slot[b]) * kCells + within(i, j, k);
          if (v_.weight[s] > 0.0f) continue;
          v_.value[s] = coarse.at_sample(at[0] * kSide + i, at[1] * kSide + j, at[2] * kSide + k);
          free_[b] = 1;
        }
      }
    }
  }

  /// Rounds of Jacobi over what is unknown.
  void relax(int rounds) {
    std::vector<std::size_t> work;
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      if (v_.slot[b] >= 0 && free_[b]) work.push_back(b);
    }
    std::vector<float> next(work.size() * kCells);
    const float outside = float(v_.truncation_m);
    for (int round = 0; round < rounds; ++round) {
      parallel_for(work.size(), 8, [&](std::size_t w) {
        Halo halo;
        halo.gather(v_, samples_, v_.brick_at(work[w]));
        std::array<float, std::tuple_size_v<decltype(halo.value)>> side = halo.value;
        for (std::size_t c = 0; c < side.size(); ++c) {
          if (halo.weight[c] > 0.0f) side[c] = side_of(side[c], outside);
        }
        float* out = &next[w * kCells];
        for (int k = 0; k < kSide; ++k) {
          for (int j = 0; j < kSide; ++j) {
            for (int i = 0; i < kSide; ++i) {
              const std::size_t c = Halo::at(i, j, k);
              const float sum = side[c - 1] + side[c + 1] + side[c - Halo::kWide] +
                                side[c + Halo::kWide] + side[c - Halo::kWide * Halo::kWide] +
                                side[c + Halo::kWide * Halo::kWide];
              out[within(i, j, k)] = halo.weight[c] > 0.0f ? halo.value[c] : sum / 6.0f;
            }
          }
        }
      });
      parallel_for(work.size(), 64, [&](std::size_t w) {
        std::copy_n(&next[w * kCells], kCells, &v_.value[std::size_t(v_.slot[work[w]]) * kCells]);
      });
    }
  }

  /// Gives samples to guessed bricks beside which the surface leaves a brick. Whether there were
  /// any.
  bool extend(const Coarse& coarse) {
    std::vector<std::size_t> more;
    for (const std::size_t b : guessed_) {
      if (v_.slot[b] < 0 && borders_other_sign(b)) more.push_back(b);
    }
    for (const std::size_t b : more) touch_from(coarse, b);
    return !more.empty();
  }

  bool borders_other_sign(std::size_t b) const {
    const Index at = v_.brick_at(b);
    const bool negative = v_.uniform[b] < 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Index next = at;
        next[std::size_t(axis)] += side;
        if (!v_.contains(next)) continue;
        const std::size_t other = v_.brick_index(next);
        if (v_.slot[other] < 0) {
          if ((v_.uniform[other] < 0.0f) != negative) return true;
          continue;
        }
        const float* values = &v_.value[std::size_t(v_.slot[other]) * kCells];
        for (int c = 0; c < 64; ++c) {
          Index s{c & 7, c >> 3, 0};
          // The layer of the neighbour that faces b.
          const int layer = side > 0 ? 0 : 7;
          if (axis == 0) s = {layer, c & 7, c >> 3};
          if (axis == 1) s = {c & 7, layer, c >> 3};
          if (axis == 2) s = {c & 7, c >> 3, layer};
          if ((values[within(s[0], s[1], s[2])] < 0.0f) != negative) return true;
        }
      }
    }
    return false;
  }

  /// Walls go on straight down from the floor, and end at y = 0.
  void stand() {
    const int floor = floor_row();
    const auto& size = samples_.size();
    if (floor >= size[1]) return;
    const int layers = floor / kSide + 1;
    std::vector<std::size_t> more;
    for (int bz = 0; bz < v_.bricks[2]; ++bz) {
      for (int bx = 0; bx < v_.bricks[0]; ++bx) {
        const std::size_t source = v_.brick_index({bx, floor / kSide, bz});
        const bool outside = v_.slot[source] < 0 && v_.uniform[source] > 0.0f;
        for (int by = 0; by < layers && by < v_.bricks[1]; ++by) {
          const std::size_t b = v_.brick_index({bx, by, bz});
          if (v_.slot[b] < 0 && !outside)
            more.push_back(b);
          else if (v_.slot[b] < 0)
            v_.uniform[b] = 1.0f;
        }
      }
    }
    for (const std::size_t b : more) v_.touch(b, v_.uniform[b] * float(v_.truncation_m));
    for (int k = 0; k < size[2]; ++k) {
      for (int i = 0; i < size[0]; ++i) {
        const float wall = samples_.value(i, floor, k);
        for (int j = 0; j < layers * kSide && j < size[1]; ++j) {
          const std::ptrdiff_t s = samples_.at(i, j, k);
          if (s < 0) continue;
          const float under = -float(v_.position(i, j, k).y());
          float& own = v_.value[std::size_t(s)];
          own = std::max(j < floor ? wall : own, under);
        }
      }
    }
  }

  /// Clear space that cannot be reached from beyond the volume becomes inside.
  void fill_enclosed() {
    Flood flood(v_);
    flood.run();
    parallel_for(v_.brick_count(), 64, [&](std::size_t b) {
      const std::int32_t slot = v_.slot[b];
      if (slot < 0) {
        if (!flood.reached(b, 0)) v_.uniform[b] = -1.0f;
        return;
      }
      float* value = &v_.value[std::size_t(slot) * kCells];
      for (std::size_t c = 0; c < kCells; ++c) {
        if (value[c] >= 0.0f && !flood.reached(b, c))
          value[c] = -std::max(value[c], 0.1f * float(v_.cell_m));
      }
    });
  }

  Volume& v_;
  const VolumeScale& scale_;
  Samples samples_;
  std::vector<std::uint8_t> free_;    // per brick: it has unknown samples
  std::vector<std::size_t> guessed_;  // bricks without samples that no view saw
};

}  // namespace

void smooth(Volume& volume, int rounds) {
  const std::vector<std::size_t> bricks = touched_bricks(volume);
  const Samples samples(volume);
  std::vector<float> next(volume.value.size());
  for (int round = 0; round < rounds; ++round) {
    parallel_for(bricks.size(), 8, [&](std::size_t b) {
      Halo halo;
      halo.gather(volume, samples, volume.brick_at(bricks[b]));
      float* out = &next[std::size_t(volume.slot[bricks[b]]) * kCells];
      for (int k = 0; k < kSide; ++k) {
        for (int j = 0; j < kSide; ++j) {
          for (int i = 0; i < kSide; ++i) {
            float sum = 0.0f, total = 0.0f;
            for (int n = 0; n < 27; ++n) {
              const int p = n % 3 - 1, q = n / 3 % 3 - 1, r = n / 9 - 1;
              const std::size_t c = Halo::at(i + p, j + q, k + r);
              const float w =
                  halo.weight[c] / float(1 << (std::abs(p) + std::abs(q) + std::abs(r)));
              sum += w * halo.value[c];
              total += w;
            }
            const std::size_t c = Halo::at(i, j, k);
            out[within(i, j, k)] = halo.weight[c] > 0.0f ? sum / total : halo.value[c];
          }
        }
      }
    });
    volume.value.swap(next);
  }
}

void close_volume(Volume& volume, const VolumeScale& scale, const RunContext& context) {
  context.begin_phase("closing", 0);
  Closing(volume, scale).run();
}

}  // namespace turnscan
