#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <turnscan/turntable/detection/rim_estimate.hpp>

namespace turnscan::detection {

namespace {

constexpr double kBandReach_px = 6.0;
constexpr std::array kThicknesses_m{0.0, 0.003, 0.007, 0.012, 0.02, 0.03, 0.045};
constexpr std::array kSpreads_px{1.0, 0.7, 0.5, 0.36, 0.27, 0.2, 0.14, 0.1};
constexpr std::size_t kLeastRimPixels = 60;

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
  return state;
}

/// Fisher scoring with Levenberg and Marquardt's damping.
class RimAscent {
 public:
  RimAscent(const RimData& data, const RimState& start)
      : data_(data), state_(start), system_(linearise(data, start.model, start.edge)) {}

  void climb(int most) {
    for (int i = 0; i < most; ++i) {
      RimEquations::Matrix damped = system_.information;
      damped.diagonal() *= 1.0 + damping_;
      const RimEquations::Vector step = damped.ldlt().solve(system_.score);
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

/// The thickness decides which place of the near side is the rim: several are tried.
RimState best_thickness(const RimData& data, const RimModel& start) {
  RimState best;
  double best_likelihood = -std::numeric_limits<double>::infinity();
  for (const double thickness : kThicknesses_m) {
    RimState state;
    state.model = start;
    state.model.thickness_m = thickness;
    RimAscent ascent(data, state);
    ascent.climb(12);
    if (ascent.system().log_likelihood <= best_likelihood) continue;
    best_likelihood = ascent.system().log_likelihood;
    best = ascent.state();
  }
  return best;
}

/// From blurred to sharp, as long as that explains more.
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

double empty_share(const std::vector<RimPixel>& pixels) {
  double empty = 0.0, all = 0.0;
  for (const RimPixel& p : pixels) {
    if (p.label == RimLabel::kPlatter) continue;
    all += 1.0;
    empty += p.label == RimLabel::kEmpty ? 1.0 : 0.0;
  }
  return all > 0.0 ? empty / all : 0.0;
}

/// What neighbours have in common, such as what lies behind them, the model does not know, but the
/// scores of the sectors scatter by it: the sandwich estimator over clusters (Liang and Zeger
/// 1986). Not less than the likelihood's own covariance.
Eigen::Matrix4d covariance_of(const RimEquations& equations) {
  const RimEquations::Matrix own = equations.information.inverse();
  RimEquations::Matrix scatter = RimEquations::Matrix::Zero();
  double sectors = 0.0;
  for (const RimEquations::Vector& score : equations.sector_score) {
    if (score.squaredNorm() > 0.0) sectors += 1.0;
    scatter += score * score.transpose();
  }
  constexpr double kUnknowns = 6.0;
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

}  // namespace

std::optional<RimEstimate> estimate_rim(const PlaneView& view, const RimModel& start,
                                        const NoiseCorrelation& noise,
                                        std::optional<double> radius_m) {
  const RimView rays(view.camera, view.plane, view.frame);
  RimData data{rays, {}, noise, 0.0, radius_m};
  RimState state;
  state.model = start;
  for (int round = 0; round < 3; ++round) {
    const double slack = round == 0 ? 0.01 : round == 1 ? 0.004 : 0.0;
    data.pixels = label_rim(view, rays, state.model, noise, kBandReach_px, slack);
    if (data.pixels.size() < kLeastRimPixels) return std::nullopt;
    data.empty_share = empty_share(data.pixels);
    state = round == 0 ? best_thickness(data, state.model) : best_spread(data, state);
    const double moved = (state.model.center - start.center).norm();
    if (moved > 0.3 * start.radius_m || !(state.model.radius_m > 0.5 * start.radius_m))
      return std::nullopt;
  }
  RimAscent ascent(data, state);
  ascent.climb(30);
  const RimEquations& system = ascent.system();
  RimEstimate out;
  out.model = ascent.state().model;
  out.edge = ascent.state().edge;
  out.covariance = covariance_of(system);
  out.edge_pixels = system.edge_pixels;
  out.wall_pixels = system.wall_pixels;
  out.explained = system.explained / double(std::max<std::size_t>(1, system.edge_pixels));
  out.log_likelihood = system.log_likelihood;
  return out.covariance.allFinite() ? std::optional(out) : std::nullopt;
}

}  // namespace turnscan::detection
