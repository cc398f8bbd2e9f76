#include <algorithm>
#include <array>
#include <limits>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/bundle_adjustment.hpp>
#include <turnscan/turntable/motion/bundle_system.hpp>

namespace turnscan::motion {

namespace {

using Eigen::Index;

constexpr double kFirstReach_m = 0.008, kMinReach_m = 0.003;
constexpr double kMaxHeight_m = 0.003;  // in one step
constexpr double kStationary = 2e-5;    // radians
/// Candidates of AnglePrior::speed_walk, from a good motor to a table pushed by hand.
constexpr std::array kSpeedWalks{2e-4, 5e-4, 1e-3, 2e-3, 4e-3, 7e-3, 1.2e-2, 2e-2, 4e-2};

std::vector<std::size_t> frames_with_surface(const MotionData& data, std::size_t most) {
  std::vector<std::size_t> out;
  for (std::size_t f = 0; f < data.frames.size(); ++f)
    if (!data.frames[f].raw_surface.empty()) out.push_back(f);
  return evenly_spread_to_last(std::move(out), most);
}

class BundleAdjustment {
 public:
  BundleAdjustment(const MotionData& data, const MotionSolution& start, const AnglePrior& prior,
                   const BundleOptions& options)
      : data_(data),
        prior_(prior),
        options_(options),
        out_(start),
        frames_(frames_with_surface(data, options.max_frames)),
        knots_(evenly_spread_to_last(frames_, options.max_knots)),
        system_(data, knots_, options.view_shift_m) {
    now_.motion = start.state;
    for (const std::size_t f : knots_.frames()) now_.knot_angle.push_back(start.state.angle[f]);
    first_ = now_.knot_angle;
  }

  Result<MotionSolution> run(const RunContext& context) {
    if (knots_.size() < 3) return std::move(out_);
    now_.surfels = make_surfels(data_, now_.motion, options_.max_surfels);
    double reach = kFirstReach_m;
    for (int i = 0; i < options_.iterations; ++i) {
      TURNSCAN_TRY(context.check());
      observations_.observe(data_, now_.motion, frames_, now_.surfels, reach, options_.axis_only);
      if (!observations_.weigh()) return std::move(out_);
      system_.accumulate(now_, frames_, observations_);
      out_.residuals = system_.residuals();
      out_.rms_m = system_.rms_m();
      out_.scale_m = observations_.scale_m();
      out_.variance_m2 = system_.variance_m2();
      if (!options_.axis_only) choose_speed_walk();
      TURNSCAN_TRY(system_.solve(now_, prior_, options_.axis_only));
      if (apply() < kStationary) break;
      reach = std::max(kMinReach_m, 8.0 * observations_.scale_m());
    }
    return finished();
  }

 private:
  /// The model distinguishes priors that pairs of views, with rotation biases, do not.
  void choose_speed_walk() {
    if (!prior_.timed) return;
    double least = std::numeric_limits<double>::infinity();
    AnglePrior tried = prior_;
    for (const double speed_walk : kSpeedWalks) {
      tried.speed_walk = speed_walk;
      const double evidence = system_.minus_2_log_evidence(now_, tried);
      if (evidence < least) prior_.speed_walk = speed_walk, least = evidence;
    }
  }

  /// Returns the largest motion of an angle, or tilt of the axis.
  double apply() {
    const auto heights = system_.heights();
    for (std::size_t s = 0; s < heights.size(); ++s) {
      if (!heights[s]) continue;
      Surfel& surfel = now_.surfels[s];
      surfel.p += std::clamp(*heights[s], -kMaxHeight_m, kMaxHeight_m) * surfel.n;
    }
    const Eigen::VectorXd& step = system_.step();
    const Index n = knots_.size();
    MotionState& state = now_.motion;
    const double tilted = move_axis(step.tail<4>(), state.axis, state.center).first;
    for (Index k = 0; k < n; ++k) now_.knot_angle[std::size_t(k)] += std::clamp(step[k], -0.1, 0.1);
    const auto change = [&](Index k) {
      return now_.knot_angle[std::size_t(k)] - first_[std::size_t(k)];
    };
    for (std::size_t f = 0; f < state.angle.size(); ++f) {
      const auto [a, share] = knots_.between(f);
      state.angle[f] = out_.state.angle[f] + change(a) + share * (change(a + 1) - change(a));
    }
    return std::max(tilted, step.head(n).cwiseAbs().maxCoeff());
  }

  MotionSolution finished() {
    const Eigen::MatrixXd inverse = system_.inverse();
    const double variance = system_.variance_m2();
    out_.covariance = variance * inverse.bottomRightCorner<4, 4>();
    for (std::size_t f = 0; f < out_.angle_sigma.size() && !options_.axis_only; ++f) {
      const auto [a, share] = knots_.between(f);
      const double low = inverse(a, a), high = inverse(a + 1, a + 1);
      out_.angle_sigma[f] = std::sqrt(variance * std::max(0.0, low + share * (high - low)));
    }
    out_.state = now_.motion;
    return std::move(out_);
  }

  const MotionData& data_;
  AnglePrior prior_;
  const BundleOptions& options_;
  MotionSolution out_;
  std::vector<std::size_t> frames_;  ///< indices in data_.frames
  AngleKnots knots_;
  BundleSystem system_;
  SurfelObservations observations_;
  BundleState now_;
  std::vector<double> first_;  ///< angles of the knots at the start
};

}  // namespace

Result<MotionSolution> adjust_bundle(const MotionData& data, const MotionSolution& start,
                                     const AnglePrior& prior, const BundleOptions& options,
                                     const RunContext& context) {
  return BundleAdjustment(data, start, prior, options).run(context);
}

}  // namespace turnscan::motion
