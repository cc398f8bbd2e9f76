#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/placement/pose_graph.hpp>

namespace turnscan::placement {

namespace {

/// Standard deviation of a frame's pose about the assumed one, relative to that of a residual: so
/// weak that only unobserved directions stay fixed.
constexpr double kFreedom = 30.0;

class FreeSolver {
 public:
  FreeSolver(const Keyframes& frames, const std::vector<Pose>& start)
      : frames_(frames), offset_(frames.size(), Twist::Zero()) {
    out_.poses = start;
  }

  Result<PoseGraph> run(const RunContext& context) {
    PairWeighting weighting{0.03, 0.015, 4};
    auto pairs = successive_pairs(frames_, out_.poses);
    for (int i = 0; i < 6; ++i) TURNSCAN_TRY(step(pairs, weighting, context));
    weighting.reach_m = 0.015;
    for (int i = 0; i < 8; ++i) {
      // Which frames show the same view depends on their poses.
      pairs = all_pairs(frames_, out_.poses);
      if (i >= 4) weighting.stride = 2;
      TURNSCAN_TRY(step(pairs, weighting, context));
    }
    out_.constraints = constrain_all(frames_, out_.poses, pairs, weighting);
    out_.scale_m = scale_of(out_.constraints);
    return std::move(out_);
  }

 private:
  Result<> step(const std::vector<FramePair>& pairs, PairWeighting& weighting,
                const RunContext& context) {
    TURNSCAN_TRY(context.check());
    const auto constraints = constrain_all(frames_, out_.poses, pairs, weighting);
    std::size_t count = 0;
    for (const PairConstraint& c : constraints) count += c.count;
    if (count < 100)
      return fail(ErrorCode::kTooFewPoints,
                  "placement: the frames do not overlap, only {} points "
                  "of them meet",
                  count);
    const double scale = std::max(scale_of(constraints), 1e-6);
    const auto n = Eigen::Index(6 * frames_.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (const PairConstraint& c : constraints) add(c, matrix, right);
    // A residual's variance over that of the prior: about that of a frame's residuals together.
    const double weak = 1.0 / (kFreedom * kFreedom);
    for (std::size_t i = 0; i < frames_.size(); ++i)
      right.segment<6>(Eigen::Index(6 * i)) -= weak * offset_[i];
    matrix.diagonal().array() += weak;
    const Eigen::VectorXd moved = estimation::solve_ldlt(matrix, right);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const Twist twist = moved.segment<6>(Eigen::Index(6 * i));
      offset_[i] += twist;
      out_.poses[i] = estimation::exp_about(frames_.middle, twist, frames_.lever_m) * out_.poses[i];
    }
    const double limit = std::max(motion::kHuber * scale, 0.2 * frames_.data.noise_m);
    weighting.huber_m = std::max(limit, 0.6 * weighting.huber_m);
    weighting.reach_m = std::max(0.75 * weighting.reach_m, 8.0 * limit);
    return {};
  }

  static void add(const PairConstraint& c, Eigen::MatrixXd& matrix, Eigen::VectorXd& right) {
    const auto from = Eigen::Index(6 * c.pair.from), to = Eigen::Index(6 * c.pair.to);
    matrix.block<6, 6>(from, from) += c.normal;
    matrix.block<6, 6>(to, to) += c.normal;
    matrix.block<6, 6>(from, to) -= c.normal;
    matrix.block<6, 6>(to, from) -= c.normal;
    right.segment<6>(from) += c.right;
    right.segment<6>(to) -= c.right;
  }

  const Keyframes& frames_;
  std::vector<Twist> offset_;
  PoseGraph out_;
};

}  // namespace

std::vector<PairConstraint> constrain_all(const Keyframes& frames, const std::vector<Pose>& poses,
                                          const std::vector<FramePair>& pairs,
                                          const PairWeighting& weighting) {
  std::vector<PairConstraint> out(pairs.size());
  parallel_for(pairs.size(), 4,
               [&](std::size_t k) { out[k] = constrain(frames, poses, pairs[k], weighting); });
  return out;
}

double scale_of(const std::vector<PairConstraint>& constraints) {
  std::vector<float> sizes;
  for (const PairConstraint& c : constraints)
    sizes.insert(sizes.end(), c.sizes.begin(), c.sizes.end());
  return sizes.empty() ? 0.0 : estimation::mad_sigma(sizes);
}

Result<PoseGraph> solve_freely(const Keyframes& frames, const std::vector<Pose>& start,
                               const RunContext& context) {
  return FreeSolver(frames, start).run(context);
}

}  // namespace turnscan::placement
