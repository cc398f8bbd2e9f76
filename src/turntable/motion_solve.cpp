#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <set>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/turntable/motion_law.hpp>

namespace turnscan::detail {

namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kHuber = 1.5;
constexpr double kOwn = 0.005;   // of a single pair's, as a share of the turn between its views
constexpr double kLead = 0.003;  // standard deviation of MotionState::lead
constexpr double kFloor = 0.6;   // of squared cosines
constexpr int kShared = 6;       // unknowns of all frames: two tilts, two shifts, two leads
constexpr double kHeld = 1e-7;   // standard deviation of what is held, radians or metres

/// Normal equations of one pair. Unknowns: two tilts of the axis, two shifts of the centre, angle
/// of `to` less angle of `from`.
struct PairSum {
  Matrix5 normal = Matrix5::Zero();
  Vector5 right = Vector5::Zero();
  double squares = 0.0, cost = 0.0, sum = 0.0;
  std::size_t count = 0;
  std::vector<float> sizes;  ///< some of the residuals
};

struct Weighing {
  double reach_m, huber_m;
  std::size_t stride;
};

using Shared = Eigen::Matrix<double, kShared, kShared>;

/// What the turn between two views changes by with each lead.
std::array<double, 2> lead_terms(const MotionState& state, const FramePair& pair) {
  const double apart = std::remainder(state.angle[pair.to] - state.angle[pair.from], kTurn);
  return {apart, apart * std::abs(apart)};
}

PairSum sum_pair(const MotionData& data, const MotionState& state, const FramePair& pair,
                 const Weighing& weighing) {
  PairSum out;
  const MotionFrame& from = data.frames[pair.from];
  const MotionView& view = data.frames[pair.to].view;
  const auto lead = lead_terms(state, pair);
  const double turn = state.angle[pair.to] - state.angle[pair.from] + state.lead[0] * lead[0] +
                      state.lead[1] * lead[1];
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn, state.axis).toRotationMatrix();
  const auto [u, v] = across(state.axis);
  const Eigen::Matrix3d shift = Eigen::Matrix3d::Identity() - R;
  const Vec3d shift_u = shift * u, shift_v = shift * v;
  for (std::size_t s = pair.to % weighing.stride; s < from.samples.size(); s += weighing.stride) {
    const MotionSample& sample = from.samples[s];
    const Vec3d n = sample.n.cast<double>(), d = sample.p.cast<double>() - state.center;
    const Vec3d turned = R * d, m = R * n, q = state.center + turned;
    // Turned away from the sensor it cannot be seen.
    if (data.projective && -m.dot(q) < 0.25 * q.norm()) continue;
    Vec3d found;
    if (!data.look_up(view, q, weighing.reach_m, found)) continue;
    // What noise along both rays makes of it; a little for what else is wrong at low angles.
    const double gain = data.projective
                            ? 1.0 / std::sqrt(std::pow(n.dot(sample.p.cast<double>()), 2) /
                                                  double(sample.p.squaredNorm()) +
                                              std::pow(m.dot(q), 2) / q.squaredNorm() + kFloor)
                            : 1.0;
    const double r = gain * m.dot(q - found), size = std::abs(r);
    const double limit = weighing.huber_m;
    if (size > 4.0 * limit) {
      out.cost += 7.0 * limit * limit;
      continue;
    }
    out.cost += size > limit ? limit * (2.0 * size - limit) : size * size;
    const Vec3d sweep = state.axis.cross(turned);
    const Vec3d tilt = turned.cross(m) - d.cross(n);
    Vector5 row;
    row << tilt.dot(u), tilt.dot(v), m.dot(shift_u), m.dot(shift_v), m.dot(sweep);
    row *= gain;
    const double weight = size > limit ? limit / size : 1.0;
    out.normal.noalias() += weight * row * row.transpose();
    out.right.noalias() -= weight * r * row;
    out.squares += weight * r * r;
    out.sum += weight * r;
    if (out.count % 8 == 0) out.sizes.push_back(float(size));
    ++out.count;
  }
  return out;
}

class Solver {
 public:
  Solver(const MotionData& data, const MotionState& start, const std::vector<FramePair>& pairs,
         const AngleLaw& law, const SolveOptions& options)
      : data_(data),
        pairs_(pairs),
        law_(law),
        options_(options),
        n_(data.frames.size()),
        start_(start.angle) {
    out_.state = start;
    all_.resize(n_);
    std::iota(all_.begin(), all_.end(), std::size_t{0});
    std::set<std::uint32_t> used;
    for (const FramePair& pair : pairs) used.insert(pair.from);
    // The noise of a frame is the same in all its pairs: more of them say no more about it.
    uses_ = std::max(1.0, double(pairs.size()) / double(used.size() + 1));
  }

  Result<MotionSolution> run(const RunContext& context) {
    Weighing weighing{options_.reach_m, 0.5 * options_.reach_m, options_.stride};
    for (int i = 0; i < options_.iterations; ++i) {
      TURNSCAN_TRY(context.check());
      TURNSCAN_TRY(accumulate(weighing));
      TURNSCAN_TRY(solve());
      const double moved = apply();
      const double limit = std::max({kHuber * out_.scale_m, 0.2 * data_.noise_m, options_.floor_m});
      weighing.huber_m = std::max(limit, 0.5 * weighing.huber_m);
      weighing.reach_m = std::max(0.6 * weighing.reach_m, 8.0 * limit);
      if (i > 2 && moved < 2e-6) break;
    }
    out_.misfit = cost_ / unit_ + law_cost_ + factors_.vectorD().array().log().sum() -
                  double(n_ + kShared) * std::log(unit_);
    if (options_.covariance) find_covariance();
    return std::move(out_);
  }

 private:
  Result<> accumulate(const Weighing& weighing) {
    std::vector<PairSum> sums(pairs_.size());
    parallel_for(pairs_.size(), 4, [&](std::size_t k) {
      sums[k] = sum_pair(data_, out_.state, pairs_[k], weighing);
    });
    triplets_.clear();
    right_ = Eigen::VectorXd::Zero(Eigen::Index(n_ + kShared));
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
    out_.scale_m = options_.scale_m.value_or(std::max(1.4826 * median(sizes), 1e-7));
    out_.rms_m = std::sqrt(squares / double(out_.residuals));
    unit_ = options_.unit_m2.value_or(uses_ * excess_ * out_.scale_m * out_.scale_m);
    out_.unit_m2 = unit_;
    for (std::size_t k = 0; k < pairs_.size(); ++k) add(pairs_[k], sums[k]);
    return {};
  }

  /// Errors that neighbouring pixels share (smoothing, a sensor's warped depth, fur) do not average
  /// out: what a pair says of an unknown is then farther off than independent noise would make it,
  /// and every residual says so much less. The unknown that shows it most counts.
  void find_excess(const std::vector<PairSum>& sums, std::vector<float>& sizes) {
    const double scale = options_.scale_m.value_or(1.4826 * median(sizes));
    constexpr double kMedianOfSquare = 0.455;  // of a standard normal
    excess_ = 1.0;
    for (int k = 0; k < 5; ++k) {
      std::vector<float> ratios;
      for (const PairSum& sum : sums) {
        if (sum.count < 50 || !(sum.normal(k, k) > 0.0)) continue;
        const double all = sum.normal(k, k) * scale * scale;
        ratios.push_back(float(sum.right[k] * sum.right[k] / all));
      }
      excess_ = std::max(excess_, median(ratios) / kMedianOfSquare);
    }
  }

  /// Leaves to each pair some turn of its own: what a view shows of the turn from another side
  /// depends on what is seen there.
  void loosen(const FramePair& pair, PairSum& sum) const {
    const double sigma = kOwn * lead_terms(out_.state, pair)[0];
    if (sigma == 0.0 || options_.hold_angles) return;
    const double all = sum.normal(4, 4) + unit_ / (sigma * sigma);
    const Vector5 column = sum.normal.col(4);
    sum.right -= column * (sum.right[4] / all);
    sum.normal -= column * column.transpose() / all;
  }

  void add(const FramePair& pair, PairSum& sum) {
    loosen(pair, sum);
    if (options_.hold_angles) {
      shared_.topLeftCorner<4, 4>() += sum.normal.topLeftCorner<4, 4>();
      right_.segment<4>(Eigen::Index(n_)) += sum.right.head<4>();
      return;
    }
    // The leads are turns, too.
    const auto lead = lead_terms(out_.state, pair);
    Eigen::Matrix<double, kShared, 5> spread = Eigen::Matrix<double, kShared, 5>::Zero();
    spread.topLeftCorner<4, 4>().setIdentity();
    spread(4, 4) = lead[0];
    spread(5, 4) = lead[1];
    shared_ += spread * sum.normal * spread.transpose();
    right_.tail<kShared>() += spread * sum.right;
    const auto from = int(pair.from), to = int(pair.to), first = int(n_);
    const double h = sum.normal(4, 4);
    triplets_.emplace_back(to, to, h);
    triplets_.emplace_back(from, from, h);
    triplets_.emplace_back(std::max(from, to), std::min(from, to), -h);
    const Eigen::Matrix<double, kShared, 1> both = spread * sum.normal.col(4);
    for (int k = 0; k < kShared; ++k) {
      triplets_.emplace_back(first + k, to, both[k]);
      triplets_.emplace_back(first + k, from, -both[k]);
    }
    right_[to] += sum.right[4];
    right_[from] -= sum.right[4];
  }

  void add_law() {
    const AddLawRow add = [&](std::span<const LawTerm> terms, double error, double worth) {
      const double weight = unit_ * worth;
      for (const auto& [i, a] : terms) {
        right_[i] -= weight * a * error;
        for (const auto& [k, b] : terms) {
          if (i >= k) triplets_.emplace_back(i, k, weight * a * b);
        }
      }
    };
    const auto& angle = out_.state.angle;
    law_cost_ = detail::add_law(data_, all_, angle, law_, add);
    for (std::size_t i = 1; i < law_.held.size(); ++i) {
      if (law_.held[i] != 0)
        add(std::array{LawTerm{int(i), 1.0}}, angle[i] - start_[i], 1.0 / (kHeld * kHeld));
    }
  }

  Result<> solve() {
    add_law();
    const int first = int(n_);
    Shared shared = shared_;
    const double unit = unit_;
    add_axis_prior(data_, out_.state.axis, out_.state.center, unit, shared.topLeftCorner<4, 4>(),
                   right_.segment<4>(first));
    for (int k = 0; k < 4 && options_.hold_axis; ++k) shared(k, k) += unit / (kHeld * kHeld);
    for (int k = 0; k < 2; ++k) {
      shared(4 + k, 4 + k) += unit / (kLead * kLead);
      right_[first + 4 + k] -= unit / (kLead * kLead) * out_.state.lead[std::size_t(k)];
    }
    for (int i = 0; i < kShared; ++i) {
      for (int k = 0; k <= i; ++k) triplets_.emplace_back(first + i, first + k, shared(i, k));
    }
    matrix_.resize(first + kShared, first + kShared);
    matrix_.setFromTriplets(triplets_.begin(), triplets_.end());
    factors_.compute(matrix_);
    if (factors_.info() != Eigen::Success)
      return fail(ErrorCode::kLibrary, "motion: the system of equations cannot be solved");
    step_ = factors_.solve(right_);
    if (!step_.allFinite())
      return fail(ErrorCode::kLibrary, "motion: the system of equations has no finite solution");
    return {};
  }

  /// Returns how far the farthest point moved, about.
  double apply() {
    const auto first = Eigen::Index(n_);
    const auto [size, shift] =
        move_axis(step_.segment<4>(first), out_.state.axis, out_.state.center);
    for (const int k : {0, 1}) out_.state.lead[std::size_t(k)] += step_[first + 4 + k];
    double most = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double step = std::clamp(step_[Eigen::Index(i)], -0.3, 0.3);
      out_.state.angle[i] += step;
      most = std::max(most, std::abs(step));
    }
    return std::max({0.1 * most, 0.1 * size, shift});
  }

  void find_covariance() {
    const double variance = unit_;
    const auto size = Eigen::Index(n_) + kShared;
    const auto first = Eigen::Index(n_);
    for (Eigen::Index k = 0; k < 4; ++k) {
      const Eigen::VectorXd column = factors_.solve(Eigen::VectorXd::Unit(size, first + k));
      out_.covariance.col(k) = variance * column.segment<4>(first);
    }
    out_.angle_sigma.assign(n_, 0.0);
    parallel_for(n_, 16, [&](std::size_t i) {
      const Eigen::VectorXd column = factors_.solve(Eigen::VectorXd::Unit(size, Eigen::Index(i)));
      out_.angle_sigma[i] = std::sqrt(std::max(0.0, variance * column[Eigen::Index(i)]));
    });
  }

  const MotionData& data_;
  const std::vector<FramePair>& pairs_;
  const AngleLaw& law_;
  const SolveOptions& options_;
  std::size_t n_;
  const std::vector<double>& start_;
  std::vector<std::size_t> all_;  ///< frames
  double uses_ = 1.0;             ///< how often the same noise is counted
  double excess_ = 1.0;           ///< of the spread of pairs' mean residuals over that of noise
  double unit_ = 1.0;             ///< what a residual of one standard deviation weighs
  double cost_ = 0.0, law_cost_ = 0.0;
  MotionSolution out_;
  std::vector<Eigen::Triplet<double>> triplets_;
  Shared shared_ = Shared::Zero();
  Eigen::VectorXd right_, step_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> factors_;
};

}  // namespace

double pair_cost(const MotionData& data, const MotionState& state, const FramePair& pair,
                 double angle_rad, double gate_m, std::size_t most_samples) {
  const MotionFrame& from = data.frames[pair.from];
  const MotionView& view = data.frames[pair.to].view;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle_rad, state.axis).toRotationMatrix();
  const std::size_t n = std::min(most_samples, from.samples.size());
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const MotionSample& sample = from.samples[k * from.samples.size() / n];
    const Vec3d q = state.center + R * (sample.p.cast<double>() - state.center);
    const Vec3d m = R * sample.n.cast<double>();
    if (data.projective && -m.dot(q) < 0.25 * q.norm()) continue;
    Vec3d found;
    count += 1.0;
    if (!data.look_up(view, q, 4.0 * gate_m, found)) {
      sum += 0.6;
      continue;
    }
    sum += std::min(1.0, std::pow(m.dot(q - found) / gate_m, 2));
  }
  // A turn that shows next to nothing of the samples explains nothing.
  if (count < 0.2 * double(n) || count == 0.0) return 1.0;
  return sum / count;
}

std::vector<FramePair> choose_pairs(const MotionData& data, const std::vector<double>& angle,
                                    bool all_frames) {
  // Near frames say how it turned, far ones where the axis is and that the steps add up.
  constexpr std::array<double, 5> kApart{0.0, 0.2, 0.5, 0.95, 1.4};
  std::set<std::pair<std::uint32_t, std::uint32_t>> chosen;
  std::vector<std::uint8_t> is_key(data.frames.size(), 0);
  for (const std::size_t k : data.keys) is_key[k] = 1;
  const auto nearest = [&](std::size_t frame, double target, double reach) {
    std::size_t best = frame;
    double least = reach;
    for (const std::size_t k : data.keys) {
      const double off = std::abs(angle[k] - target);
      if (k == frame || data.frames[k].pass != data.frames[frame].pass || off >= least) continue;
      best = k, least = off;
    }
    return best;
  };
  const auto add = [&](std::size_t from, std::size_t to) {
    if (from == to) return;
    if (!data.frames[from].samples.empty() && !data.frames[to].view.empty())
      chosen.emplace(std::uint32_t(from), std::uint32_t(to));
    if (is_key[from] && !data.frames[to].samples.empty() && !data.frames[from].view.empty())
      chosen.emplace(std::uint32_t(to), std::uint32_t(from));
  };
  const double few = data.keys.size() <= 24 ? 1.0 : 0.1;
  for (std::size_t i = 0; i < data.frames.size(); ++i) {
    if (!is_key[i] && !all_frames) continue;
    for (std::size_t k = 0; k < kApart.size(); ++k) {
      if (!is_key[i] && k != 0 && k != 2) continue;
      add(i, nearest(i, angle[i] + kApart[k], few));
      if ((!is_key[i] && k > 0) || data.keys.size() <= 24)
        add(i, nearest(i, angle[i] - kApart[k], few));
    }
    for (const double turn : {kTurn, -kTurn, 2 * kTurn}) {
      for (const double apart : {0.0, 0.25, 0.5, 0.95, -0.25, -0.5, -0.95}) {
        if (!is_key[i] && apart != 0.0) continue;
        add(i, nearest(i, angle[i] + turn + apart, few));
      }
    }
  }
  // Neighbours in the order of the frames always hang together.
  for (std::size_t k = 0; k + 1 < data.keys.size(); ++k) {
    if (data.frames[data.keys[k]].pass == data.frames[data.keys[k + 1]].pass)
      add(data.keys[k], data.keys[k + 1]);
  }
  std::vector<FramePair> out;
  for (const auto& [from, to] : chosen) out.push_back({from, to});
  return out;
}

Result<MotionSolution> solve_motion(const MotionData& data, const MotionState& start,
                                    const std::vector<FramePair>& pairs, const AngleLaw& law,
                                    const SolveOptions& options, const RunContext& context) {
  return Solver(data, start, pairs, law, options).run(context);
}

}  // namespace turnscan::detail
