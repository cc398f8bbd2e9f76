#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

namespace {

/// Standard deviation of a single pair's rotation error, relative to the rotation between its
/// views.
constexpr double kPairRotationSlack = 0.005;
/// Standard deviation of MotionState::rotation_bias.
constexpr double kRotationBiasSigma = 0.003;
/// Standard deviation of fixed unknowns, radians or metres.
constexpr double kHeldSigma = 1e-7;
/// Unknowns of all frames: two tilts, two shifts, two rotation biases.
constexpr int kSharedUnknowns = 6;

using SharedMatrix = Eigen::Matrix<double, kSharedUnknowns, kSharedUnknowns>;

class PairwiseSolver {
 public:
  PairwiseSolver(const MotionData& data, const MotionState& start,
                 const std::vector<FramePair>& pairs, const AnglePrior& prior,
                 const SolveOptions& options)
      : data_(data),
        pairs_(pairs),
        prior_(prior),
        options_(options),
        n_(data.frames.size()),
        start_(start.angle) {
    out_.state = start;
    all_frames_.resize(n_);
    std::iota(all_frames_.begin(), all_frames_.end(), std::size_t{0});
    std::set<std::uint32_t> used;
    for (const FramePair& pair : pairs) used.insert(pair.from);
    // The noise of a frame is the same in all its pairs, so additional pairs add no information
    // about it.
    uses_ = std::max(1.0, double(pairs.size()) / double(used.size() + 1));
  }

  Result<MotionSolution> run(const RunContext& context) {
    PairWeighting weighting{options_.reach_m, 0.5 * options_.reach_m, options_.stride};
    for (int i = 0; i < options_.iterations; ++i) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_TRY(accumulate(weighting));
      TURNSCAN_TRY(solve());
      const double moved = apply();
      const double limit = std::max({kHuber * out_.scale_m, 0.2 * data_.noise_m, options_.floor_m});
      weighting.huber_m = std::max(limit, 0.5 * weighting.huber_m);
      weighting.reach_m = std::max(0.6 * weighting.reach_m, 8.0 * limit);
      if (i > 2 && moved < 2e-6) break;
    }
    out_.minus_2_log_evidence = cost_ / variance_ + prior_cost_ +
                                factors_.vectorD().array().log().sum() -
                                double(n_ + kSharedUnknowns) * std::log(variance_);
    if (options_.covariance) find_covariance();
    return std::move(out_);
  }

 private:
  Result<> accumulate(const PairWeighting& weighting) {
    std::vector<PairEquations> sums(pairs_.size());
    parallel_for(pairs_.size(), 4, [&](std::size_t k) {
      sums[k] = linearise_pair(data_, out_.state, pairs_[k], weighting);
    });
    triplets_.clear();
    right_ = Eigen::VectorXd::Zero(Eigen::Index(n_ + kSharedUnknowns));
    shared_.setZero();
    std::vector<float> sizes;
    double squares = 0.0;
    out_.residuals = 0;
    cost_ = 0.0;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      squares += sums[k].squares;
      cost_ += sums[k].cost;
      out_.residuals += sums[k].count;
      sizes.insert(sizes.end(), sums[k].sizes.begin(), sums[k].sizes.end());
    }
    find_excess(sums, sizes);
    if (out_.residuals < 100)
      return fail(ErrorCode::kTooFewPoints,
                  "motion: the frames do not overlap, only {} points of them meet; take more "
                  "frames a turn, or say where the axis is with a calibration",
                  out_.residuals);
    out_.scale_m = options_.scale_m.value_or(std::max(estimation::mad_sigma(sizes), 1e-7));
    out_.rms_m = std::sqrt(squares / double(out_.residuals));
    variance_ = options_.variance_m2.value_or(uses_ * excess_ * out_.scale_m * out_.scale_m);
    out_.variance_m2 = variance_;
    for (std::size_t k = 0; k < pairs_.size(); ++k) add(pairs_[k], sums[k]);
    return {};
  }

  /// Errors that neighbouring pixels share (smoothing, a sensor's warped depth, fur) do not average
  /// out: a pair's estimate of an unknown then deviates more than independent noise explains, and
  /// every residual has that much less weight. The most affected unknown counts.
  void find_excess(const std::vector<PairEquations>& sums, std::vector<float>& sizes) {
    const double scale = options_.scale_m.value_or(estimation::mad_sigma(sizes));
    excess_ = 1.0;
    for (int k = 0; k < 5; ++k) {
      std::vector<float> ratios;
      for (const PairEquations& sum : sums) {
        if (sum.count < 50 || !(sum.normal(k, k) > 0.0)) continue;
        const double all = sum.normal(k, k) * scale * scale;
        ratios.push_back(float(sum.right[k] * sum.right[k] / all));
      }
      excess_ = std::max(excess_, median(ratios) / estimation::kMedianOfSquare);
    }
  }

  /// Marginalises an additional rotation for each pair: the apparent rotation from another side
  /// depends on what is visible there.
  void marginalise_slack(const FramePair& pair, PairEquations& sum) const {
    const double sigma = kPairRotationSlack * rotation_bias_terms(out_.state, pair)[0];
    if (sigma == 0.0 || options_.hold_angles) return;
    const double all = sum.normal(4, 4) + variance_ / (sigma * sigma);
    const Eigen::Matrix<double, 5, 1> column = sum.normal.col(4);
    sum.right -= column * (sum.right[4] / all);
    sum.normal -= column * column.transpose() / all;
  }

  void add(const FramePair& pair, PairEquations& sum) {
    marginalise_slack(pair, sum);
    if (options_.hold_angles) {
      shared_.topLeftCorner<4, 4>() += sum.normal.topLeftCorner<4, 4>();
      right_.segment<4>(Eigen::Index(n_)) += sum.right.head<4>();
      return;
    }
    // The biases are rotations, too.
    const auto bias = rotation_bias_terms(out_.state, pair);
    Eigen::Matrix<double, kSharedUnknowns, 5> spread =
        Eigen::Matrix<double, kSharedUnknowns, 5>::Zero();
    spread.topLeftCorner<4, 4>().setIdentity();
    spread(4, 4) = bias[0];
    spread(5, 4) = bias[1];
    shared_ += spread * sum.normal * spread.transpose();
    right_.tail<kSharedUnknowns>() += spread * sum.right;
    const auto from = int(pair.from), to = int(pair.to), first = int(n_);
    const double h = sum.normal(4, 4);
    triplets_.emplace_back(to, to, h);
    triplets_.emplace_back(from, from, h);
    triplets_.emplace_back(std::max(from, to), std::min(from, to), -h);
    const Eigen::Matrix<double, kSharedUnknowns, 1> both = spread * sum.normal.col(4);
    for (int k = 0; k < kSharedUnknowns; ++k) {
      triplets_.emplace_back(first + k, to, both[k]);
      triplets_.emplace_back(first + k, from, -both[k]);
    }
    right_[to] += sum.right[4];
    right_[from] -= sum.right[4];
  }

  void add_prior() {
    const AddPriorRow add = [&](std::span<const PriorTerm> terms, double error, double worth) {
      const double weight = variance_ * worth;
      for (const auto& [i, a] : terms) {
        right_[i] -= weight * a * error;
        for (const auto& [k, b] : terms) {
          if (i >= k) triplets_.emplace_back(i, k, weight * a * b);
        }
      }
    };
    const auto& angle = out_.state.angle;
    prior_cost_ = motion::add_angle_prior(data_, all_frames_, angle, prior_, add);
    for (std::size_t i = 1; i < prior_.held.size(); ++i) {
      if (prior_.held[i] != 0)
        add(std::array{PriorTerm{int(i), 1.0}}, angle[i] - start_[i],
            1.0 / (kHeldSigma * kHeldSigma));
    }
  }

  Result<> solve() {
    add_prior();
    const int first = int(n_);
    SharedMatrix shared = shared_;
    add_axis_prior(axis_prior(data_, options_.view_shift_m, options_.use_platter), out_.state.axis,
                   out_.state.center, variance_, shared.topLeftCorner<4, 4>(),
                   right_.segment<4>(first));
    for (int k = 0; k < 4 && options_.hold_axis; ++k)
      shared(k, k) += variance_ / (kHeldSigma * kHeldSigma);
    for (int k = 0; k < 2; ++k) {
      shared(4 + k, 4 + k) += variance_ / (kRotationBiasSigma * kRotationBiasSigma);
      right_[first + 4 + k] -= variance_ / (kRotationBiasSigma * kRotationBiasSigma) *
                               out_.state.rotation_bias[std::size_t(k)];
    }
    for (int i = 0; i < kSharedUnknowns; ++i) {
      for (int k = 0; k <= i; ++k) triplets_.emplace_back(first + i, first + k, shared(i, k));
    }
    matrix_.resize(first + kSharedUnknowns, first + kSharedUnknowns);
    matrix_.setFromTriplets(triplets_.begin(), triplets_.end());
    factors_.compute(matrix_);
    if (factors_.info() != Eigen::Success)
      return fail(ErrorCode::kLibrary, "motion: the system of equations cannot be solved");
    step_ = factors_.solve(right_);
    if (!step_.allFinite())
      return fail(ErrorCode::kLibrary, "motion: the system of equations has no finite solution");
    return {};
  }

  /// Returns approximately the largest motion of a point.
  double apply() {
    const auto first = Eigen::Index(n_);
    const auto [size, shift] =
        move_axis(step_.segment<4>(first), out_.state.axis, out_.state.center);
    for (const int k : {0, 1}) out_.state.rotation_bias[std::size_t(k)] += step_[first + 4 + k];
    double most = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double step = std::clamp(step_[Eigen::Index(i)], -0.3, 0.3);
      out_.state.angle[i] += step;
      most = std::max(most, std::abs(step));
    }
    return std::max({0.1 * most, 0.1 * size, shift});
  }

  void find_covariance() {
    const auto size = Eigen::Index(n_) + kSharedUnknowns;
    const auto first = Eigen::Index(n_);
    for (Eigen::Index k = 0; k < 4; ++k) {
      const Eigen::VectorXd column = factors_.solve(Eigen::VectorXd::Unit(size, first + k));
      out_.covariance.col(k) = variance_ * column.segment<4>(first);
    }
    out_.angle_sigma.assign(n_, 0.0);
    parallel_for(n_, 16, [&](std::size_t i) {
      const Eigen::VectorXd column = factors_.solve(Eigen::VectorXd::Unit(size, Eigen::Index(i)));
      out_.angle_sigma[i] = std::sqrt(std::max(0.0, variance_ * column[Eigen::Index(i)]));
    });
  }

  const MotionData& data_;
  const std::vector<FramePair>& pairs_;
  const AnglePrior& prior_;
  const SolveOptions& options_;
  std::size_t n_;
  const std::vector<double>& start_;
  std::vector<std::size_t> all_frames_;  ///< their indices
  double uses_ = 1.0;                    ///< multiplicity of the same noise
  double excess_ = 1.0;                  ///< spread of the pairs' mean residuals over that of noise
  double variance_ = 1.0;                ///< weight of a residual of one standard deviation
  double cost_ = 0.0, prior_cost_ = 0.0;
  MotionSolution out_;
  std::vector<Eigen::Triplet<double>> triplets_;
  SharedMatrix shared_ = SharedMatrix::Zero();
  Eigen::VectorXd right_, step_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors_;
};

}  // namespace

Result<MotionSolution> solve_pairwise(const MotionData& data, const MotionState& start,
                                      const std::vector<FramePair>& pairs, const AnglePrior& prior,
                                      const SolveOptions& options, const RunContext& context) {
  return PairwiseSolver(data, start, pairs, prior, options).run(context);
}

}  // namespace turnscan::motion
