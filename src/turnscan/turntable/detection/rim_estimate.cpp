#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/detection/rim_estimate.hpp>

namespace turnscan::detection {

namespace {

constexpr double kFirstReach_px = 6.0, kReach_px = 4.5;
constexpr std::size_t kMaxInSearch = 2000;  // pixels
constexpr std::array kThicknesses_m{0.0, 0.003, 0.007, 0.012, 0.02, 0.03, 0.045, 0.065};
constexpr double kThickestMode_m = 0.03;  // higher walls are sufficiently visible
constexpr std::array kSpreads_px{1.0, 0.7, 0.5, 0.36, 0.27, 0.2, 0.14, 0.1};
constexpr std::size_t kMinRimPixels = 60;

struct RimState {
  RimModel model;
  EdgeResponse edge;
};

RimState moved(RimState state, const RimEquations::Vector& step) {
  state.model.center += step.head<2>();
  state.model.radius_m += step[2];
  state.model.thickness_m = std::max(0.0, state.model.thickness_m + step[3]);
  state.edge.shift_px += step[4];
  state.edge.band_px = std::max(0.02, state.edge.band_px + step[5]);
  state.edge.bare_px += step[6];
  return state;
}

/// Fisher scoring with Levenberg-Marquardt damping.
class RimAscent {
 public:
  RimAscent(const RimData& data, const RimState& start)
      : data_(data), state_(start), system_(linearise(data, start.model, start.edge)) {}

  void climb(int most) {
    for (int i = 0; i < most; ++i) {
      RimEquations::Matrix damped = system_.information;
      damped.diagonal() *= 1.0 + damping_;
      const RimEquations::Vector step = estimation::solve_ldlt(damped, system_.score);
      if (!step.allFinite()) return;
      const RimState next = moved(state_, step);
      const RimEquations there = linearise(data_, next.model, next.edge);
      const double gain = there.log_likelihood - system_.log_likelihood;
      if (gain < 0.0) {
        damping_ = std::max(1e-3, 8.0 * damping_);
        if (damping_ > 1e5) return;
        continue;
      }
      damping_ *= 0.2;
      state_ = next;
      system_ = there;
      if (gain < 1e-4) return;
    }
  }

  const RimState& state() const { return state_; }
  const RimEquations& system() const { return system_; }

 private:
  const RimData& data_;
  RimState state_;
  RimEquations system_;
  double damping_ = 1e-3;
};

/// Number of pixels on the wrong side of the outline, however far from it.
std::size_t wrong_pixels(const RimData& data, const RimState& state) {
  std::size_t wrong = 0;
  for (const RimPixel& pixel : data.pixels) {
    const auto distance = data.rays.outline(state.model, pixel.column, pixel.row);
    if (!distance || pixel.label == RimLabel::kMixed) continue;
    const bool within = distance->px > state.edge.shift_of(pixel);
    wrong += within == (pixel.label == RimLabel::kPlatter) ? 0 : 1;
  }
  return wrong;
}

/// Climbs from the thicknesses, on all cores.
std::vector<RimState> climbed(const RimData& data, const RimState& start,
                              std::span<const double> thicknesses_m, int most) {
  std::vector<RimState> out(thicknesses_m.size(), start);
  parallel_for(out.size(), 1, [&](std::size_t i) {
    out[i].model.thickness_m = thicknesses_m[i];
    RimAscent ascent(data, out[i]);
    ascent.climb(most);
    out[i] = ascent.state();
  });
  return out;
}

/// The thickness determines which point of the near side is the rim, so several are tried. Their
/// likelihoods are of different pixels, those about each outline, and cannot be compared.
RimState best_thickness(const RimData& data, const RimModel& start) {
  const std::vector<RimState> tried = climbed(data, {start, {}}, kThicknesses_m, 12);
  std::vector<std::size_t> wrong;
  for (const RimState& state : tried) wrong.push_back(wrong_pixels(data, state));
  return tried[std::size_t(std::min_element(wrong.begin(), wrong.end()) - wrong.begin())];
}

/// A maximum of the likelihood.
struct RimMode {
  RimState state;
  double log_likelihood = 0.0;  ///< of all pixels
};

/// Where the far side is not seen, a low wall and a rim nearer to the sensor look much alike.
/// Climbs from each thickness to the nearest maximum; the best first.
std::vector<RimMode> modes(const RimData& data, const RimState& start) {
  std::vector<double> thicknesses_m{start.model.thickness_m};
  std::copy_if(kThicknesses_m.begin(), kThicknesses_m.end(), std::back_inserter(thicknesses_m),
               [](double thickness) { return thickness <= kThickestMode_m; });
  std::vector<RimMode> out;
  for (const RimState& state : climbed(data, start, thicknesses_m, 15))
    out.push_back({state, log_likelihood_of_all(data, state.model, state.edge)});
  std::stable_sort(out.begin(), out.end(), [](const RimMode& l, const RimMode& r) {
    return l.log_likelihood > r.log_likelihood;
  });
  return out;
}

/// Tries spreads from blurred to sharp, as long as the likelihood increases.
RimState best_spread(const RimData& data, const RimState& start) {
  RimState best = start;
  double best_likelihood = -std::numeric_limits<double>::infinity();
  for (const double spread : kSpreads_px) {
    RimState state = best;
    state.edge.spread_px = spread;
    RimAscent ascent(data, state);
    ascent.climb(6);
    if (ascent.system().log_likelihood <= best_likelihood) break;
    best_likelihood = ascent.system().log_likelihood;
    best = ascent.state();
  }
  return best;
}

/// An even subset of the pixels, which is sufficient during the search.
RimData thinned(const RimData& data) {
  return {data.rays, evenly_spread(data.pixels, kMaxInSearch), data.noise, data.empty_share,
          data.radius_m};
}

double empty_share(const std::vector<RimPixel>& pixels) {
  double empty = 0.0, all = 0.0;
  for (const RimPixel& p : pixels) {
    if (p.label == RimLabel::kPlatter) continue;
    all += 1.0;
    empty += p.label == RimLabel::kEmpty ? 1.0 : 0.0;
  }
  return all > 0.0 ? empty / all : 0.0;
}

/// The model ignores what neighbours have in common, such as their background, but the scores of
/// the sectors scatter by it: the sandwich estimator over clusters (Liang and Zeger 1986). At least
/// the likelihood's own covariance.
Eigen::Matrix4d covariance_of(const RimEquations& equations) {
  const RimEquations::Matrix own = estimation::inverse_lu(equations.information);
  RimEquations::Matrix scatter = RimEquations::Matrix::Zero();
  double sectors = 0.0;
  for (const RimEquations::Vector& score : equations.sector_score) {
    if (score.squaredNorm() > 0.0) sectors += 1.0;
    scatter += score * score.transpose();
  }
  constexpr double kUnknowns = 7.0;
  const double lost = sectors > kUnknowns + 1.0 ? sectors / (sectors - kUnknowns) : sectors;
  const RimEquations::Matrix clustered = lost * own * scatter * own;
  Eigen::Matrix4d out = own.topLeftCorner<4, 4>();
  for (int k = 0; k < 4; ++k) {
    const double grow = std::sqrt(std::max(1.0, clustered(k, k) / out(k, k)));
    out.row(k) *= grow;
    out.col(k) *= grow;
  }
  return out;
}

/// Error of the estimate if another maximum were the truth, weighted by likelihood. The pixels are
/// more correlated than the likelihoods assume: half of their difference counts.
Eigen::Matrix4d scatter_of(const std::vector<RimMode>& maxima) {
  const auto unknowns = [](const RimModel& m) {
    return Eigen::Vector4d(m.center.x(), m.center.y(), m.radius_m, m.thickness_m);
  };
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  const RimMode& best = maxima.front();
  double most = 0.0, weights = 1.0;
  for (const RimMode& other : maxima) {
    const double weight = std::exp(0.5 * (other.log_likelihood - best.log_likelihood));
    const Eigen::Vector4d apart = unknowns(other.state.model) - unknowns(best.state.model);
    // Several starts may lead to the same maximum, which counts once.
    if (weight * apart.squaredNorm() <= most) continue;
    most = weight * apart.squaredNorm();
    weights = 1.0 + weight;
    sum = weight * apart * apart.transpose();
  }
  return sum / weights;
}

/// Sets agreement and rim_share.
void count_witnesses(const RimData& data, RimEstimate& out) {
  constexpr std::size_t kBearings = 72;
  constexpr double kBeside_px = 4.0;
  std::array<std::uint8_t, kBearings> inside{}, outside{};
  double agree = 0.0, all = 0.0;
  for (const RimPixel& pixel : data.pixels) {
    const auto distance = data.rays.outline(out.model, pixel.column, pixel.row);
    if (!distance || pixel.label == RimLabel::kMixed) continue;
    const double off = distance->px - out.edge.shift_of(pixel);
    const double away = std::abs(off) - 0.5 * out.edge.band_px;
    if (away > kBeside_px || away < std::min(0.5, out.edge.spread_px)) continue;
    const bool platter = pixel.label == RimLabel::kPlatter, within = off > 0.0;
    all += 1.0;
    agree += platter == within ? 1.0 : 0.0;
    const double turn = distance->bearing_rad / kTurn + 0.5;
    const auto k = std::min(kBearings - 1, static_cast<std::size_t>(turn * double(kBearings)));
    if (within && platter) inside[k] = 1;
    if (!within && !platter) outside[k] = 1;
  }
  out.agreement = all > 0.0 ? agree / all : 0.0;
  for (std::size_t k = 0; k < kBearings; ++k)
    out.rim_share += inside[k] && outside[k] ? 1.0 / double(kBearings) : 0.0;
}

}  // namespace

std::optional<RimEstimate> estimate_rim(const PlaneView& view, const RimModel& start,
                                        const NoiseCorrelation& noise,
                                        std::optional<double> radius_m, const RunContext& context) {
  const RimView rays(view.camera, view.plane, view.frame);
  RimData data{rays, {}, noise, 0.0, radius_m};
  RimState state;
  state.model = start;
  for (int round = 0; round < 3; ++round) {
    const double slack = round == 0 ? 0.01 : round == 1 ? 0.004 : 0.0;
    // At first the pixels must contain the foot of a wall of any height.
    RimModel about = state.model;
    if (round == 0) about.thickness_m = kThicknesses_m.back();
    data.pixels = label_rim(view, rays, about, noise, round == 0 ? kFirstReach_px : kReach_px,
                            slack, context);
    if (data.pixels.size() < kMinRimPixels || context.cancelled()) return std::nullopt;
    data.empty_share = empty_share(data.pixels);
    const RimData few = thinned(data);
    if (round == 0) state = best_thickness(few, state.model);
    if (round == 1) state = modes(few, state).front().state;
    if (round > 0) state = best_spread(few, state);
    const double moved = (state.model.center - start.center).norm();
    if (moved > 0.3 * start.radius_m || !(state.model.radius_m > 0.5 * start.radius_m))
      return std::nullopt;
  }
  if (context.cancelled()) return std::nullopt;
  const std::vector<RimMode> maxima = modes(thinned(data), state);
  RimAscent ascent(data, maxima.front().state);
  ascent.climb(15);
  const RimEquations& system = ascent.system();
  RimEstimate out;
  out.model = ascent.state().model;
  out.edge = ascent.state().edge;
  out.covariance = covariance_of(system) + scatter_of(maxima);
  out.edge_pixels = system.edge_pixels;
  out.wall_pixels = system.wall_pixels;
  out.explained = system.explained / double(std::max<std::size_t>(1, system.edge_pixels));
  out.log_likelihood = system.log_likelihood;
  count_witnesses(data, out);
  return out.covariance.allFinite() ? std::optional(out) : std::nullopt;
}

}  // namespace turnscan::detection
