#include <cmath>
#include <limits>
#include <turnscan/turntable/motion/axis_fit.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

namespace {

double gain_over(const Result<MotionSolution>& start, const MotionSolution& found) {
  if (!start || 2 * start->residuals < found.residuals)
    return std::numeric_limits<double>::infinity();
  const double less = start->rms_m * start->rms_m - found.rms_m * found.rms_m;
  return less * double(found.residuals) / found.variance_m2;
}

}  // namespace

Result<AxisFit> fit_axis(const MotionData& data, const TurntableInfo& start,
                         const std::vector<double>& angle_rad, const RunContext& context) {
  MotionState state;
  state.axis = start.axis.normalized();
  // The point of the axis beside the object: tilting about it moves the object least.
  state.center = start.center_m + state.axis.dot(data.middle - start.center_m) * state.axis;
  state.angle = angle_rad;
  AnglePrior prior;
  prior.held.assign(angle_rad.size(), 1);
  const auto pairs = select_pairs(data, angle_rad, false);
  SolveOptions coarse;
  coarse.reach_m = 0.03;
  coarse.floor_m = 0.004;
  coarse.stride = coarse_stride(data, 6);
  TURNSCAN_ASSIGN(const MotionSolution rough,
                  solve_pairwise(data, state, pairs, prior, coarse, context));
  SolveOptions fine;
  fine.iterations = 5;
  fine.reach_m = 0.01;
  fine.stride = coarse_stride(data, 2);
  fine.covariance = true;
  TURNSCAN_ASSIGN(const MotionSolution found,
                  solve_pairwise(data, rough.state, pairs, prior, fine, context));
  SolveOptions held = fine;
  held.hold_axis = true;
  held.covariance = false;
  const auto as_started = solve_pairwise(data, state, pairs, prior, held, context);
  if (!as_started && as_started.error().code == ErrorCode::kCancelled)
    return tl::unexpected<Error>(as_started.error());
  const Eigen::Matrix4d& c = found.covariance;
  return AxisFit{found.state.axis, found.state.center, std::sqrt(c(0, 0) + c(1, 1)),
                 std::sqrt(c(2, 2) + c(3, 3)), gain_over(as_started, found)};
}

}  // namespace turnscan::motion
