#include <cmath>
#include <limits>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/axis_fit.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>
#include <turnscan/turntable/motion/view_shift.hpp>

namespace turnscan::motion {

namespace {

MotionState state_of(const MotionData& data, const TurntableInfo& table,
                     const std::vector<double>& angle_rad) {
  MotionState state;
  state.axis = table.axis.normalized();
  // The point of the axis beside the object: tilts about it move the object least.
  state.center = table.center_m + state.axis.dot(data.middle - table.center_m) * state.axis;
  state.angle = angle_rad;
  return state;
}

AnglePrior held_angles(std::size_t count) {
  AnglePrior prior;
  prior.held.assign(count, 1);
  return prior;
}

SolveOptions fine_options(const MotionData& data) {
  SolveOptions fine;
  fine.iterations = 5;
  fine.reach_m = 0.01;
  fine.stride = coarse_stride(data, 2);
  return fine;
}

}  // namespace

Result<AxisFit> fit_axis(const MotionData& data, const TurntableInfo& start,
                         const std::vector<double>& angle_rad, const RunContext& context) {
  const MotionState state = state_of(data, start, angle_rad);
  const AnglePrior prior = held_angles(angle_rad.size());
  const auto pairs = select_pairs(data, angle_rad, false);
  SolveOptions coarse;
  coarse.reach_m = 0.03;
  coarse.floor_m = 0.004;
  coarse.stride = coarse_stride(data, 6);
  TURNSCAN_ASSIGN(const MotionSolution rough,
                  solve_pairwise(data, state, pairs, prior, coarse, context));
  SolveOptions fine = fine_options(data);
  fine.covariance = true;
  fine.view_shift_m = view_shift_sigma_m(data, rough.state);
  TURNSCAN_ASSIGN(const MotionSolution found,
                  solve_pairwise(data, rough.state, pairs, prior, fine, context));
  const AxisEstimate axis =
      without_view_shift({found.state.axis, found.state.center, found.covariance},
                         axis_prior(data, fine.view_shift_m));
  const Eigen::Matrix4d& c = axis.covariance;
  AxisFit out;
  out.axis = axis.axis;
  out.center_m = axis.center;
  out.axis_sigma_rad = std::sqrt(c(0, 0) + c(1, 1));
  out.center_sigma_m = std::sqrt(c(2, 2) + c(3, 3));
  out.rms_m = found.rms_m;
  out.residuals = found.residuals;
  out.variance_m2 = found.variance_m2;
  return out;
}

Result<double> gain_over_start(const AxisFit& fit, const MotionData& data,
                               const TurntableInfo& start, const std::vector<double>& angle_rad,
                               const RunContext& context) {
  SolveOptions held = fine_options(data);
  held.hold_axis = true;
  const auto at_start =
      solve_pairwise(data, state_of(data, start, angle_rad), select_pairs(data, angle_rad, false),
                     held_angles(angle_rad.size()), held, context);
  if (!at_start && at_start.error().code == ErrorCode::kCancelled)
    return tl::unexpected<Error>(at_start.error());
  if (!at_start || 2 * at_start->residuals < fit.residuals)
    return std::numeric_limits<double>::infinity();
  const double less = at_start->rms_m * at_start->rms_m - fit.rms_m * fit.rms_m;
  return less * double(fit.residuals) / fit.variance_m2;
}

}  // namespace turnscan::motion
