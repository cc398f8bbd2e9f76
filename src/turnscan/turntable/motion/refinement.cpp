#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/bundle_adjustment.hpp>
#include <turnscan/turntable/motion/initial_guess.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/refinement.hpp>
#include <turnscan/turntable/motion/speed_profile.hpp>
#include <turnscan/turntable/motion/view_shift.hpp>

namespace turnscan::motion {

namespace {

/// Fewer views, far apart, have too little in common for a surface model.
constexpr std::size_t kMinBundleFrames = 24;
/// turn_contrast() below which the object looks the same from all sides.
constexpr double kMinTurnContrast = 0.02;
/// Logarithm of the ratio of two speeds that may be the same if the table slipped.
constexpr double kSameSpeed = 0.1;
/// Assumed accuracy of a platter, and the number of standard deviations from which it is rejected.
constexpr double kLargestLean = 0.5 * kRadiansPerDegree, kLargestShift_m = 0.003;
constexpr double kDisagreement = 6.0;
constexpr std::size_t kMinPhaseFrames = 24, kMinEvidenceFrames = 12;

/// Effect of outlines on the axis, relative to a pixel (standard deviation of each tilt, over the
/// object's size, and of each shift). Measured with mixed pixels on bench/random_rigs.
constexpr double kOutlineTilt = 0.02, kOutlineShift = 0.035;

class Refinement {
 public:
  Refinement(const MotionData& data, InitialMotion start, const RunContext& context)
      : data_(data), context_(context), state_(std::move(start.state)) {
    out_.source = start.source;
    known_speed_rad_s_ = start.known_speed_rad_s;
    out_.prior = std::move(start.prior);
  }

  Result<RefinedMotion> run() {
    SolveOptions options;
    options.reach_m = 0.02;
    options.floor_m = 0.002;
    options.iterations = 8;
    options.stride = coarse_stride(data_, 4);
    TURNSCAN_TRY(solve(options, false));
    TURNSCAN_TRY(judge_turn(options));
    options.view_shift_m = view_shift_m_ = view_shift_sigma_m(data_, state_);
    TURNSCAN_TRY(judge_platter(options));
    TURNSCAN_TRY(fit_motor(options));
    options.stride = 1;
    options.iterations = 5;
    options.reach_m = 0.01;
    options.floor_m = 0.0;
    TURNSCAN_TRY(solve(options, false));
    // Finally with all frames; the pairs follow the angles.
    options.iterations = 3;
    options.covariance = true;
    TURNSCAN_TRY(solve(options, true));
    // If the angles are the prior's, pairs of views do not drift.
    if (data_.projective && out_.turn_observable && data_.keys.size() >= kMinBundleFrames) {
      TURNSCAN_TRY(adjust());
    }
    set_axis(without_view_shift(axis_of(out_.solution), axis_prior(data_, view_shift_m_)));
    return std::move(out_);
  }

 private:
  /// Outlines determine rotation and axis best, but their mixed pixels shift the axis. Estimates
  /// the axis once more without them.
  Result<> adjust() {
    BundleOptions options;
    options.view_shift_m = view_shift_m_;
    TURNSCAN_ASSIGN(out_.solution,
                    adjust_bundle(data_, out_.solution, out_.prior, options, context_));
    if (data_.correlated_noise) return {};  // there are no outlines
    options.axis_only = true;
    TURNSCAN_ASSIGN(const MotionSolution within,
                    adjust_bundle(data_, out_.solution, out_.prior, options, context_));
    const double tilt = kOutlineTilt * data_.spacing_m / data_.extent_m;
    const double shift = kOutlineShift * data_.spacing_m;
    const Eigen::Vector4d sigma(tilt, tilt, shift, shift);
    set_axis(
        combine_nested(axis_of(out_.solution), axis_of(within), sigma.cwiseAbs2().asDiagonal()));
    return {};
  }

  static AxisEstimate axis_of(const MotionSolution& solution) {
    return {solution.state.axis, solution.state.center, solution.covariance};
  }

  void set_axis(const AxisEstimate& axis) {
    out_.solution.state.axis = axis.axis;
    out_.solution.state.center = axis.center;
    out_.solution.covariance = axis.covariance;
  }

  Result<> solve(SolveOptions options, bool all_frames) {
    options.hold_angles = !out_.turn_observable;
    const auto pairs = select_pairs(data_, state_.angle, all_frames);
    TURNSCAN_ASSIGN(out_.solution,
                    solve_pairwise(data_, state_, pairs, out_.prior, options, context_));
    state_ = out_.solution.state;
    context_.advance();
    return {};
  }

  /// Compares the platter with the axis estimated from the frames without it.
  Result<> judge_platter(SolveOptions options) {
    if (!data_.platter) return {};
    options.use_platter = false;
    options.covariance = true;
    const auto free = solve_pairwise(data_, state_, select_pairs(data_, state_.angle, false),
                                     out_.prior, options, context_);
    if (!free && free.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(free.error());
    if (free)
      out_.platter_fits =
          agrees(*data_.platter,
                 without_view_shift(axis_of(*free), axis_prior(data_, view_shift_m_, false)));
    return {};
  }

  static bool agrees(const DetectedPlatter& platter, const AxisEstimate& free) {
    const Vec3d &axis = free.axis, &center = free.center;
    const double lean = std::atan2(axis.cross(platter.axis).norm(), axis.dot(platter.axis));
    const Vec3d off = platter.center_m - center;
    const double shift = (off - off.dot(platter.axis) * platter.axis).norm();
    const auto& c = free.covariance;
    const double lean_sigma =
        std::sqrt(c(0, 0) + c(1, 1) + 2.0 * std::pow(platter_axis_sigma_rad(platter), 2));
    const double height = off.dot(platter.axis);
    const double shift_sigma =
        std::sqrt(c(2, 2) + c(3, 3) + 2.0 * std::pow(platter_center_sigma_m(platter), 2) +
                  std::pow(height * platter.axis_sigma_rad, 2));
    return lean < std::max(kLargestLean, kDisagreement * lean_sigma) &&
           shift < std::max(kLargestShift_m, kDisagreement * shift_sigma);
  }

  /// Decides whether the rotation is observable. The angles of a round object would be fitted to
  /// noise, and are those of the prior instead.
  Result<> judge_turn(const SolveOptions& options) {
    out_.turn_observable = out_.source == AngleSource::kNothing ||
                           turn_contrast(data_, state_) > kMinTurnContrast || view_comes_back();
    if (out_.turn_observable) return {};
    TURNSCAN_TRY(reset_to_prior());
    return solve(options, false);
  }

  /// Whether the view recurs after a turn at about the speed that was found.
  bool view_comes_back() const {
    const double speed = out_.prior.speed_rad_s;
    if (out_.source != AngleSource::kTimes || speed == 0.0) return false;
    const auto recurs = recurrence_speed(data_, recurrence_costs(data_), state_, speed);
    return recurs && std::abs(std::log(*recurs / speed)) < kSameSpeed;
  }

  /// Resets to the times or the recorded angles.
  Result<> reset_to_prior() {
    AnglePrior& prior = out_.prior;
    if (out_.source == AngleSource::kAngles) {
      for (std::size_t i = 0; i < state_.angle.size(); ++i)
        state_.angle[i] =
            prior.nominal_sign * (*data_.frames[i].nominal_rad - *data_.frames[0].nominal_rad);
      return {};
    }
    if (!known_speed_rad_s_)
      return fail(ErrorCode::kMissingData,
                  "motion: the object looks the same from all sides, so that its speed cannot be "
                  "seen; give --speed");
    prior.speed_rad_s = *known_speed_rad_s_;
    prior.stated_rad_s = known_speed_rad_s_;
    const double t0 = data_.frames.front().time_s;
    for (std::size_t i = 0; i < state_.angle.size(); ++i)
      state_.angle[i] = *known_speed_rad_s_ * (data_.frames[i].time_s - t0);
    return {};
  }

  /// Estimates the motor's phases and evenness, if the frames have times and show the rotation.
  Result<> fit_motor(SolveOptions& options) {
    if (out_.source != AngleSource::kTimes || !out_.turn_observable) return {};
    if (data_.keys.size() >= kMinPhaseFrames && find_transients(data_, state_, out_.prior)) {
      options.iterations = 4;
      options.reach_m = std::max(0.004, 12.0 * out_.solution.scale_m);
      TURNSCAN_TRY(solve(options, false));
      find_standstills(state_, out_.prior);
    }
    if (data_.keys.size() < kMinEvidenceFrames) return {};
    TURNSCAN_TRY(find_slips(data_, out_.solution, options, out_.prior, state_, context_));
    return choose_speed_walk(data_, out_.solution, options, out_.prior, state_, context_);
  }

  const MotionData& data_;
  const RunContext& context_;
  MotionState state_;
  double view_shift_m_ = 0.0;
  std::optional<double> known_speed_rad_s_;
  RefinedMotion out_;
};

}  // namespace

Result<RefinedMotion> refine_motion(const MotionData& data, InitialMotion start,
                                    const RunContext& context) {
  return Refinement(data, std::move(start), context).run();
}

}  // namespace turnscan::motion
