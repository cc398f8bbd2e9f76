// What no view saw: decided by what lies around it.

#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/volume.hpp>
#include <turnscan/reconstruction/volume_coarse.hpp>
#include <turnscan/reconstruction/volume_flood.hpp>

namespace turnscan {

namespace {

using detail::Coarse;
using detail::Flood;
using detail::Halo;
using detail::Index;
using detail::kCells;
using detail::kSide;
using detail::Samples;
using detail::side_of;
using detail::within;

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

void close_volume(Volume& volume, const VolumeScale& scale, const RunContext& context) {
  context.begin_phase("closing", 0);
  Closing(volume, scale).run();
}

}  // namespace turnscan
