#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/view_turns.hpp>

namespace turnscan::texture {

namespace {

constexpr std::size_t kTurnBlocks = 40000, kTurnChunks = 16;
constexpr int kTurnSteps = 12;         // to either side
constexpr double kTurnReach = 3.0;     // motion of the middle block in texels at the last step
constexpr float kMaxTexels = 3.0f;     // maximum offset at which a block is compared
constexpr float kMinContrast = 4.0f;   // levels, rms: weaker patterns do not determine their
                                       // position
constexpr float kPatternNoise = 3.0f;  // levels, of a smoothed texel
constexpr int kTurnRounds = 200;
constexpr double kStayShare = 1e-3;  // relative to the evidence, for no rotation

using Pattern = std::array<float, kBlockTexels>;

/// Luminance of a slot of a block, smoothed by (1 2 1)/4 in each direction; nullopt if it does not
/// show all of the block well.
std::optional<Pattern> pattern_of(const TexelSamples& samples, std::size_t block,
                                  std::size_t slot) {
  const Sample* s = samples.of(block, slot);
  Pattern grey{}, along{}, out{};
  for (std::size_t i = 0; i < kBlockTexels; ++i) {
    if (s[i].valid != Sample::kWell) return std::nullopt;
    grey[i] = 0.3f * float(s[i].r) + 0.59f * float(s[i].g) + 0.11f * float(s[i].b);
  }
  const auto smooth = [](const Pattern& from, Pattern& to, int step, int across) {
    for (int j = 0; j < kBlock_px; ++j)
      for (int i = 0; i < kBlock_px; ++i) {
        const auto at = [&](int k) {
          return from[std::size_t(j * across + std::clamp(k, 0, kBlock_px - 1) * step)];
        };
        to[std::size_t(j * across + i * step)] = 0.25f * (at(i - 1) + 2.0f * at(i) + at(i + 1));
      }
  };
  smooth(grey, along, 1, kBlock_px);
  smooth(along, out, kBlock_px, 1);
  return out;
}

float contrast(const Pattern& pattern) {
  float sum = 0.0f, squares = 0.0f;
  for (const float v : pattern) sum += v, squares += v * v;
  const float mean = sum / float(kBlockTexels);
  return std::sqrt(std::max(0.0f, squares / float(kBlockTexels) - mean * mean));
}

/// Variance of the difference between a pattern and another one sampled at an offset of (dx, dy)
/// texels, over their overlap.
float difference(const Pattern& a, const Pattern& b, float dx, float dy) {
  float sum = 0.0f, squares = 0.0f, n = 0.0f;
  for (int y = 0; y < kBlock_px; ++y) {
    const float v = float(y) + dy;
    if (!(v >= 0.0f && v <= float(kBlock_px - 1))) continue;
    const int row = std::min(int(v), kBlock_px - 2);
    for (int x = 0; x < kBlock_px; ++x) {
      const float u = float(x) + dx;
      if (!(u >= 0.0f && u <= float(kBlock_px - 1))) continue;
      const int column = std::min(int(u), kBlock_px - 2);
      const float fx = u - float(column), fy = v - float(row);
      const float* at = &b[std::size_t(row * kBlock_px + column)];
      const float top = at[0] + fx * (at[1] - at[0]);
      const float low = at[kBlock_px] + fx * (at[kBlock_px + 1] - at[kBlock_px]);
      const float d = top + fy * (low - top) - a[std::size_t(y * kBlock_px + x)];
      sum += d, squares += d * d, n += 1.0f;
    }
  }
  const float mean = sum / n;
  return std::max(0.0f, squares / n - mean * mean);
}

/// Motion of the surface of a block, texels per radian, when the object turns about the view's
/// axis.
Eigen::Vector2f texels_per_radian(const TexelBlocks& blocks, std::size_t block,
                                  const ColorView& view) {
  const TexelBlocks::Surface s = blocks.surface(block, blocks.middle_texel(block));
  const Vec3f axis = view.T_object_table.linear().col(1).cast<float>();
  const Vec3f moved = axis.cross(s.position - view.T_object_table.translation().cast<float>());
  Eigen::Matrix2f gram;
  gram << s.right.squaredNorm(), s.right.dot(s.down), s.right.dot(s.down), s.down.squaredNorm();
  return gram.inverse() * Eigen::Vector2f(s.right.dot(moved), s.down.dot(moved));
}

/// Fully covered blocks, evenly spread.
std::vector<std::size_t> whole_blocks(const TexelBlocks& blocks, const ChosenViews& chosen) {
  std::vector<std::size_t> out;
  const std::size_t step = std::max<std::size_t>(1, blocks.count() / kTurnBlocks);
  for (std::size_t b = 0; b < blocks.count(); b += step) {
    bool whole = chosen.view[b][0] != kNoView && chosen.view[b][1] != kNoView;
    for (int i = 0; i < kBlockTexels && whole; ++i) whole = blocks.triangle(b, i) != kNoTriangle;
    if (whole) out.push_back(b);
  }
  return out;
}

/// Calls visit(slot, pattern of the best view, pattern of the slot) for the slots of a block that
/// have a pattern in addition to the best view's.
template <class Visit>
void for_each_pair(const ChosenViews& chosen, const TexelSamples& samples, std::size_t block,
                   const Visit& visit) {
  const auto best = pattern_of(samples, block, 0);
  if (!best || contrast(*best) < kMinContrast) return;
  for (std::size_t k = 1; k < kSlots && chosen.view[block][k] != kNoView; ++k)
    if (const auto other = pattern_of(samples, block, k)) visit(k, *best, *other);
}

/// Cost of rotating one view relative to another, over the steps of the rotation.
using Curve = std::array<double, 2 * kTurnSteps + 1>;

class TurnSolver {
 public:
  TurnSolver(std::size_t views, double step_rad)
      : step_rad_(step_rad), curves_(views * views, Curve{}), turns_(views, 0.0) {}

  Curve& curve(std::size_t from, std::size_t to) { return curves_[from * turns_.size() + to]; }

  void add(const TurnSolver& other) {
    for (std::size_t i = 0; i < curves_.size(); ++i)
      for (std::size_t j = 0; j < curves_[i].size(); ++j) curves_[i][j] += other.curves_[i][j];
  }

  /// Each view in turn takes the angle at which it fits the others best.
  std::vector<double> solve() {
    for (std::size_t v = 0; v < turns_.size(); ++v) stay_.push_back(kStayShare * depth_of(v));
    for (int round = 0; round < kTurnRounds; ++round) {
      double moved = 0.0;
      for (std::size_t v = 0; v < turns_.size(); ++v) {
        const double before = turns_[v];
        turns_[v] = best_turn(v);
        moved = std::max(moved, std::abs(turns_[v] - before));
      }
      if (moved < 1e-3 * step_rad_) break;
    }
    double mean = 0.0;
    for (const double t : turns_) mean += t / double(turns_.size());
    for (double& t : turns_) t -= mean;
    return turns_;
  }

 private:
  /// Parabolic interpolation between the steps, constant beyond the last one.
  double at(const Curve& curve, double turn) const {
    const double x = std::clamp(turn / step_rad_ + kTurnSteps, 0.0, 2.0 * kTurnSteps);
    const int i = std::clamp(int(std::lround(x)), 1, 2 * kTurnSteps - 1);
    const double a = curve[std::size_t(i - 1)], b = curve[std::size_t(i)],
                 c = curve[std::size_t(i + 1)], d = x - i;
    return b + 0.5 * d * (c - a) + 0.5 * d * d * (a - 2.0 * b + c);
  }

  double cost(std::size_t view, double turn) const {
    const std::size_t n = turns_.size();
    const double of_step = turn / step_rad_;
    double sum = stay_[view] * of_step * of_step;
    for (std::size_t other = 0; other < n; ++other) {
      if (other == view) continue;
      sum += at(curves_[other * n + view], turn - turns_[other]);
      sum += at(curves_[view * n + other], turns_[other] - turn);
    }
    return sum;
  }

  double best_turn(std::size_t view) const {
    double best = turns_[view], least = cost(view, best);
    for (int i = -kTurnSteps; i <= kTurnSteps; ++i) {
      const double turn = i * step_rad_, c = cost(view, turn);
      if (c < least) best = turn, least = c;
    }
    for (double step = 0.5 * step_rad_; step > 1e-3 * step_rad_; step *= 0.5)
      for (const double turn : {best - step, best + step})
        if (const double c = cost(view, turn); c < least) best = turn, least = c;
    return best;
  }

  /// Maximum rise of its curves.
  double depth_of(std::size_t view) const {
    const std::size_t n = turns_.size();
    double sum = 0.0;
    for (std::size_t other = 0; other < n; ++other)
      for (const Curve* curve : {&curves_[other * n + view], &curves_[view * n + other]}) {
        const auto [least, most] = std::minmax_element(curve->begin(), curve->end());
        sum += *most - *least;
      }
    return sum;
  }

  double step_rad_;
  std::vector<Curve> curves_;  // per pair of views
  std::vector<double> turns_, stay_;
};

}  // namespace

Result<std::vector<double>> solve_turns(const TexelBlocks& blocks, const ChosenViews& chosen,
                                        const TexelSamples& samples,
                                        const std::vector<ColorView>& views,
                                        const RunContext& context) {
  const std::vector<std::size_t> whole = whole_blocks(blocks, chosen);
  std::vector<double> speeds;
  for (std::size_t i = 0; i < whole.size(); i += 16)
    speeds.push_back(
        double(texels_per_radian(blocks, whole[i], views[chosen.view[whole[i]][0]]).norm()));
  if (speeds.empty()) return std::vector<double>(views.size(), 0.0);
  const double step_rad = kTurnReach / kTurnSteps / std::max(1.0, median(speeds));
  auto parts = parallel_chunks<std::optional<TurnSolver>>(
      whole.size(), whole.size() / kTurnChunks + 1, [&](std::size_t begin, std::size_t end) {
        std::optional<TurnSolver> part(std::in_place, views.size(), step_rad);
        for (std::size_t i = begin; i < end && !context.cancelled(); ++i) {
          const std::size_t b = whole[i];
          for_each_pair(
              chosen, samples, b, [&](std::size_t k, const Pattern& best, const Pattern& other) {
                const Eigen::Vector2f speed =
                    float(step_rad) * texels_per_radian(blocks, b, views[chosen.view[b][k]]);
                Curve own;
                for (int j = -kTurnSteps; j <= kTurnSteps; ++j) {
                  Eigen::Vector2f shift = float(j) * speed;
                  if (shift.norm() > kMaxTexels) shift *= kMaxTexels / shift.norm();
                  own[std::size_t(j + kTurnSteps)] =
                      double(difference(best, other, shift.x(), shift.y()));
                }
                const double least = *std::min_element(own.begin(), own.end());
                Curve& sum = part->curve(chosen.view[b][0], chosen.view[b][k]);
                for (std::size_t j = 0; j < own.size(); ++j)
                  sum[j] += own[j] / (double(kPatternNoise * kPatternNoise) + least);
              });
        }
        return part;
      });
  TURNSCAN_TRY(context.check());
  TurnSolver all(views.size(), step_rad);
  for (const auto& part : parts) all.add(*part);
  return all.solve();
}

double pattern_misfit(const TexelBlocks& blocks, const ChosenViews& chosen,
                      const TexelSamples& samples) {
  const std::vector<std::size_t> whole = whole_blocks(blocks, chosen);
  std::vector<double> differences;
  for (const std::size_t b : whole)
    for_each_pair(chosen, samples, b, [&](std::size_t, const Pattern& best, const Pattern& other) {
      differences.push_back(double(difference(best, other, 0.0f, 0.0f)));
    });
  return median(differences, 0.0);
}

double turned_px(const std::vector<double>& turns, const std::vector<ColorView>& views,
                 const TriangleMesh& mesh) {
  double sum = 0.0, n = 0.0;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / 200);
  for (std::size_t k = 0; k < views.size(); ++k) {
    ColorView turned = views[k];
    turned.turn(turns[k]);
    for (std::size_t v = 0; v < mesh.vertices.size(); v += step) {
      const Projection a = views[k].project(mesh.vertices[v]), b = turned.project(mesh.vertices[v]);
      if (!(a.z > 0.0f && b.z > 0.0f)) continue;
      sum += double((a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v));
      n += 1.0;
    }
  }
  return n > 0.0 ? std::sqrt(sum / n) : 0.0;
}

}  // namespace turnscan::texture
