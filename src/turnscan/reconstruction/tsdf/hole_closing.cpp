// Decides unobserved samples from their surroundings.

#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/harmonic_fill.hpp>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>
#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf {

namespace {

constexpr int kMaxExtensions = 8;
constexpr float kBelowPlatter = -1.0f;             // temporary weight of an unknown sample there
constexpr int kFirstRounds = 24, kMoreRounds = 8;  // of Jacobi

/// Calls body(i, j, k) for each sample of a brick.
template <class Body>
void for_each_in_brick(const Body& body) {
  for (int k = 0; k < kBrickSide; ++k) {
    for (int j = 0; j < kBrickSide; ++j) {
      for (int i = 0; i < kBrickSide; ++i) body(i, j, k);
    }
  }
}

class HoleClosing {
 public:
  HoleClosing(Volume& volume, const VolumeScale& scale, const Foot& foot, const RunContext& context)
      : v_(volume), scale_(scale), foot_(foot), context_(context), samples_(volume) {}

  Result<> run() {
    if (scale_.floor_m) {
      forget_below_floor();
      decide_below_platter(hollow_floors(v_, floor_row()));
    }
    TURNSCAN_ASSIGN(const HarmonicFill fill, HarmonicFill::solve(v_, scale_, context_));
    adopt(fill);
    for (int round = 0; round < kMaxExtensions; ++round) {
      TURNSCAN_TRY(relax(bricks_at_surface(), round == 0 ? kFirstRounds : kMoreRounds));
      if (!extend(fill)) break;
    }
    if (scale_.floor_m) extend_walls_to_platter();
    if (!scale_.platters.empty()) end_on_platters();
    return context_.check();
  }

 private:
  int floor_row() const { return floor_layer(v_, *scale_.floor_m); }

  /// Whether a floor was measured in some of a brick's columns.
  bool has_measured_floor(std::size_t b) const {
    const GridCoords at = v_.bricks.coords(b);
    for (int c = 0; c < 64 && !foot_.floors.none(); ++c)
      if (foot_.floors.column(at[0] * kBrickSide + (c & 7), at[2] * kBrickSide + (c >> 3)))
        return true;
    return false;
  }

  /// Measurements there may be of the platter, except in columns with a measured floor.
  void forget_below_floor() {
    const int floor = floor_row();
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      const GridCoords at = v_.bricks.coords(b);
      const int first = at[1] * kBrickSide;
      if (first >= floor) continue;
      if (v_.slot[b] < 0) {
        if (first + kBrickSide <= floor && !has_measured_floor(b)) v_.uniform[b] = 0.0f;
        continue;
      }
      for (int j = 0; j < kBrickSide && first + j < floor; ++j) {
        for (int c = 0; c < 64; ++c) {
          if (!foot_.floors.column(at[0] * kBrickSide + (c & 7), at[2] * kBrickSide + (c >> 3)))
            v_.weight[v_.first_sample(b) + sample_in_brick(c & 7, j, c >> 3)] = 0.0f;
        }
      }
    }
  }

  /// A round bottom at most touches the platter. A vessel whose floor no ray reached has one: the
  /// harmonic function would leave it without.
  void decide_below_platter(const std::vector<std::uint8_t>& floors) {
    const auto& size = samples_.size();
    for (int k = 0; k < size[2]; ++k) {
      for (int i = 0; i < size[0]; ++i) {
        const bool inside = floors[std::size_t(i) + std::size_t(size[0]) * std::size_t(k)] != 0 ||
                            foot_.floors.column(i, k);
        if (!inside && !foot_.round.column(i, k)) continue;
        const std::size_t b = samples_.brick(i, 0, k);
        if (v_.slot[b] < 0 && v_.uniform[b] != 0.0f) continue;
        if (v_.slot[b] < 0) v_.allocate(b, float(v_.truncation_m));
        for (int j = 0; j < kBrickSide && v_.position(i, j, k).y() < 0.0; ++j) {
          const auto s = std::size_t(samples_.at(i, j, k));
          v_.value[s] = float(inside ? -v_.truncation_m : v_.truncation_m);
          v_.weight[s] = 1.0f;
        }
      }
    }
  }

  void allocate_from(const HarmonicFill& fill, std::size_t b) {
    const GridCoords at = v_.bricks.coords(b);
    const float known = v_.uniform[b];
    v_.allocate(b, known * float(v_.truncation_m));
    const std::size_t base = v_.first_sample(b);
    for_each_in_brick([&](int i, int j, int k) {
      const std::size_t s = base + sample_in_brick(i, j, k);
      if (known > 0.0f)
        v_.weight[s] = 1.0f;  // observed to be free, permanently
      else
        v_.value[s] =
            fill.at_sample(at[0] * kBrickSide + i, at[1] * kBrickSide + j, at[2] * kBrickSide + k);
    });
    if (known > 0.0f) return;
    has_unknown_[b] = 1;
    mark_below_platters(b);
  }

  /// Unknown samples below the platter of any pass do not influence those around them.
  void mark_below_platters(std::size_t b) {
    if (scale_.platters.empty()) return;
    for_each_unknown(b, [&](std::size_t s, const Vec3d& p) {
      if (below_platters(scale_.platters, p) > 0.0) v_.weight[s] = kBelowPlatter;
    });
  }

  /// Calls body(sample, position) for each unknown sample of a brick with samples.
  template <class Body>
  void for_each_unknown(std::size_t b, const Body& body) {
    const GridCoords at = v_.bricks.coords(b);
    for_each_in_brick([&](int i, int j, int k) {
      const std::size_t s = v_.first_sample(b) + sample_in_brick(i, j, k);
      if (v_.weight[s] <= 0.0f)
        body(s,
             v_.position(at[0] * kBrickSide + i, at[1] * kBrickSide + j, at[2] * kBrickSide + k));
    });
  }

  /// Unobserved parts end flat on the platters.
  void end_on_platters() {
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      if (v_.slot[b] < 0 || !has_unknown_[b]) continue;
      for_each_unknown(b, [&](std::size_t s, const Vec3d& p) {
        v_.value[s] = std::max(v_.value[s], float(below_platters(scale_.platters, p)));
        v_.weight[s] = 0.0f;
      });
    }
  }

  /// Assigns signs to bricks without samples, samples to those through which the surface may pass,
  /// and initial values to unknown samples.
  void adopt(const HarmonicFill& fill) {
    has_unknown_.assign(v_.brick_count(), 0);
    std::vector<std::size_t> crossed;
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      if (v_.slot[b] >= 0) {
        start_unknown(fill, b);
        continue;
      }
      if (v_.uniform[b] > 0.0f) continue;
      const auto [negative, positive] = unseen_signs(fill, v_.bricks.coords(b));
      if (negative && positive) {
        crossed.push_back(b);
      } else {
        v_.uniform[b] = negative ? -1.0f : 1.0f;
        guessed_.push_back(b);
      }
    }
    for (const std::size_t b : crossed) allocate_from(fill, b);
  }

  /// The signs of the cells of a brick and its neighbours.
  struct Signs {
    bool negative = false, positive = false;
  };

  /// Signs of an unobserved brick without samples. Below a platter it is empty, but beside it
  /// samples are needed at which the rest ends.
  Signs unseen_signs(const HarmonicFill& fill, const GridCoords& at) const {
    Signs out = signs_around(fill, at);
    const double half = 0.5 * (kBrickSide - 1);
    const Vec3d middle = v_.position(at[0] * kBrickSide, at[1] * kBrickSide, at[2] * kBrickSide) +
                         Vec3d::Constant(half * v_.cell_m);
    for (const Platter& platter : scale_.platters) {
      const double above = platter.above(middle) / (v_.cell_m * platter.up.lpNorm<1>());
      out.positive |= above < half + 1.0;
      out.negative &= above > -half - kBrickSide;
    }
    return out;
  }

  static Signs signs_around(const HarmonicFill& fill, const GridCoords& at) {
    Signs out;
    for (int k = -1; k < 3; ++k) {
      for (int j = -1; j < 3; ++j) {
        for (int i = -1; i < 3; ++i)
          (fill.cell(2 * at[0] + i, 2 * at[1] + j, 2 * at[2] + k) < 0.0f ? out.negative
                                                                         : out.positive) = true;
      }
    }
    return out;
  }

  void start_unknown(const HarmonicFill& fill, std::size_t b) {
    const GridCoords at = v_.bricks.coords(b);
    for_each_in_brick([&](int i, int j, int k) {
      const std::size_t s = v_.first_sample(b) + sample_in_brick(i, j, k);
      if (v_.weight[s] > 0.0f) return;
      v_.value[s] =
          fill.at_sample(at[0] * kBrickSide + i, at[1] * kBrickSide + j, at[2] * kBrickSide + k);
      has_unknown_[b] = 1;
    });
    if (has_unknown_[b]) mark_below_platters(b);
  }

  std::vector<std::size_t> unknown_bricks() const {
    std::vector<std::size_t> out;
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      if (v_.slot[b] >= 0 && has_unknown_[b]) out.push_back(b);
    }
    return out;
  }

  /// The bricks with unknown samples in which, or next to which, the sign changes at an unknown
  /// sample. Elsewhere, such as deep in the object, only signs matter, and these are known.
  std::vector<std::size_t> bricks_at_surface() const {
    std::vector<std::size_t> unknown = unknown_bricks();
    std::vector<std::uint8_t> changes(unknown.size(), 0), around(v_.brick_count(), 0);
    parallel_for(unknown.size(), 8,
                 [&](std::size_t w) { changes[w] = sign_changes(unknown[w]) ? 1 : 0; });
    for (std::size_t w = 0; w < unknown.size(); ++w)
      if (changes[w]) mark_around(unknown[w], around);
    return marked(std::move(unknown), around);
  }

  static std::vector<std::size_t> marked(std::vector<std::size_t> bricks,
                                         const std::vector<std::uint8_t>& marks) {
    std::erase_if(bricks, [&](std::size_t b) { return marks[b] == 0; });
    return bricks;
  }

  bool sign_changes(std::size_t b) const {
    BrickHalo halo;
    halo.gather(v_, samples_, v_.bricks.coords(b));
    bool out = false;
    for_each_in_brick([&](int i, int j, int k) {
      const std::size_t c = BrickHalo::at(i, j, k);
      if (out || halo.weight[c] > 0.0f) return;
      for (const std::size_t other : beside(c))
        out |= (halo.value[other] < 0.0f) != (halo.value[c] < 0.0f);
    });
    return out;
  }

  /// The neighbours of a sample in a halo.
  static std::array<std::size_t, 6> beside(std::size_t c) {
    constexpr int kRow = BrickHalo::kWide, kLayer = kRow * kRow;
    return {c - 1, c + 1, c - kRow, c + kRow, c - kLayer, c + kLayer};
  }

  /// Rounds of Jacobi over the unknown samples of some bricks.
  Result<> relax(const std::vector<std::size_t>& work, int rounds) {
    std::vector<float> next(work.size() * kBrickSamples);
    for (int round = 0; round < rounds; ++round) {
      TURNSCAN_TRY(context_.check());
      parallel_for(work.size(), 8,
                   [&](std::size_t w) { relax_brick(work[w], &next[w * kBrickSamples]); });
      parallel_for(work.size(), 64, [&](std::size_t w) {
        std::copy_n(&next[w * kBrickSamples], kBrickSamples, &v_.value[v_.first_sample(work[w])]);
      });
    }
    return {};
  }

  void relax_brick(std::size_t b, float* out) const {
    const float outside = float(v_.truncation_m);
    BrickHalo halo;
    halo.gather(v_, samples_, v_.bricks.coords(b));
    auto value = halo.value;
    for (std::size_t c = 0; c < value.size(); ++c) {
      if (halo.weight[c] > 0.0f) value[c] = boundary_value(value[c], outside);
    }
    for_each_in_brick([&](int i, int j, int k) {
      const std::size_t c = BrickHalo::at(i, j, k);
      const bool mirrors = halo.weight[c] == 0.0f;
      float sum = 0.0f;
      for (const std::size_t other : beside(c))
        sum += mirrors && halo.weight[other] < 0.0f ? value[c] : value[other];
      out[sample_in_brick(i, j, k)] = halo.weight[c] > 0.0f ? halo.value[c] : sum / 6.0f;
    });
  }

  /// Gives samples to guessed bricks into which the surface continues from an adjacent brick.
  /// Returns whether there were any.
  bool extend(const HarmonicFill& fill) {
    std::vector<std::size_t> more;
    for (const std::size_t b : guessed_) {
      if (v_.slot[b] < 0 && borders_other_sign(b)) more.push_back(b);
    }
    for (const std::size_t b : more) allocate_from(fill, b);
    return !more.empty();
  }

  bool borders_other_sign(std::size_t b) const {
    const GridCoords at = v_.bricks.coords(b);
    const bool negative = v_.uniform[b] < 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        GridCoords next = at;
        next[std::size_t(axis)] += side;
        if (!v_.bricks.contains(next)) continue;
        const std::size_t other = v_.bricks.at(next);
        if (v_.slot[other] >= 0 ? face_differs(other, axis, side > 0 ? 0 : 7, negative)
                                : (v_.uniform[other] < 0.0f) != negative)
          return true;
      }
    }
    return false;
  }

  /// Whether a layer of a brick's samples, across an axis, contains the other sign.
  bool face_differs(std::size_t b, int axis, int layer, bool negative) const {
    const float* values = &v_.value[v_.first_sample(b)];
    for (int c = 0; c < 64; ++c) {
      GridCoords s{c & 7, c >> 3, layer};
      if (axis == 0) s = {layer, c & 7, c >> 3};
      if (axis == 1) s = {c & 7, layer, c >> 3};
      if ((values[sample_in_brick(s[0], s[1], s[2])] < 0.0f) != negative) return true;
    }
    return false;
  }

  void mark_around(std::size_t b, std::vector<std::uint8_t>& marks) const {
    const GridCoords at = v_.bricks.coords(b);
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const GridCoords next{at[0] + i, at[1] + j, at[2] + k};
          if (v_.bricks.contains(next)) marks[v_.bricks.at(next)] = 1;
        }
      }
    }
  }

  /// Walls continue straight down from the floor, except at round bottoms and above floors that
  /// were measured, and end at y = 0.
  void extend_walls_to_platter() {
    const int floor = floor_row();
    const auto& size = samples_.size();
    if (floor >= size[1]) return;
    const int layers = floor / kBrickSide + 1;
    allocate_columns(floor / kBrickSide, layers);
    for (int k = 0; k < size[2]; ++k) {
      for (int i = 0; i < size[0]; ++i) {
        const float wall = samples_.value(i, floor, k);
        for (int j = 0; j < layers * kBrickSide && j < size[1]; ++j) {
          const std::ptrdiff_t s = samples_.at(i, j, k);
          if (s < 0) continue;
          const float under = -float(v_.position(i, j, k).y());
          float& own = v_.value[std::size_t(s)];
          const bool ends = j < floor && !foot_.round.column(i, k) && !foot_.floors.column(i, k);
          own = std::max(ends ? wall : own, under);
        }
      }
    }
  }

  /// Allocates samples for the lowest layers of bricks, except where the brick of layer `source` is
  /// all outside: there they are outside, too.
  void allocate_columns(int source, int layers) {
    const GridCoords& bricks = v_.bricks.size();
    std::vector<std::size_t> more;
    for (int bz = 0; bz < bricks[2]; ++bz) {
      for (int bx = 0; bx < bricks[0]; ++bx) {
        const std::size_t above = v_.bricks.at({bx, source, bz});
        const bool outside =
            v_.slot[above] < 0 && v_.uniform[above] > 0.0f && !has_measured_floor(above);
        for (int by = 0; by < layers && by < bricks[1]; ++by) {
          const std::size_t b = v_.bricks.at({bx, by, bz});
          if (v_.slot[b] < 0 && !outside)
            more.push_back(b);
          else if (v_.slot[b] < 0)
            v_.uniform[b] = 1.0f;
        }
      }
    }
    for (const std::size_t b : more) v_.allocate(b, v_.uniform[b] * float(v_.truncation_m));
  }

  Volume& v_;
  const VolumeScale& scale_;
  const Foot& foot_;
  const RunContext& context_;
  VolumeSamples samples_;
  std::vector<std::uint8_t> has_unknown_;  // per brick with samples
  std::vector<std::size_t> guessed_;       // unobserved bricks without samples
};

}  // namespace

int floor_layer(const Volume& volume, double floor_m) {
  return std::max(0, int(std::ceil((floor_m - volume.origin_m.y()) / volume.cell_m)));
}

Result<> close_holes(Volume& volume, const VolumeScale& scale, const Foot& foot,
                     const RunContext& context) {
  context.begin_phase("closing", 0);
  return HoleClosing(volume, scale, foot, context).run();
}

}  // namespace turnscan::tsdf
