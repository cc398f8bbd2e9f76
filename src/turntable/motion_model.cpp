#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <limits>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/turntable/motion_law.hpp>
#include <turnscan/turntable/motion_model.hpp>
#include <turnscan/turntable/motion_places.hpp>

namespace turnscan::detail {

namespace {

using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;
using MatrixF = Eigen::MatrixXf;
using Index = Eigen::Index;

constexpr double kHuber = 1.5;
constexpr double kFirstReach_m = 0.008, kLeastReach_m = 0.003;
constexpr double kLowCosine = 0.45, kFullCosine = 0.8;  // of incidence: weight 0 to 1 between
constexpr double kMostHeight_m = 0.003;                 // in one step
constexpr double kStationary = 2e-5;                    // radians
constexpr std::size_t kLeastSeen = 1000;
constexpr std::size_t kBlocks = 64;  // of frames, whose errors are compared
/// How evenly tables turn: AngleLaw::wander, from a good motor to one that is pushed by hand.
constexpr std::array kWanders{2e-4, 5e-4, 1e-3, 2e-3, 4e-3, 7e-3, 1.2e-2, 2e-2, 4e-2};

/// A frame's distance from a place.
struct Seen {
  std::uint32_t place;
  float r, incidence, weight;
};

class Bundle {
 public:
  Bundle(const MotionData& data, const MotionSolution& start, const AngleLaw& law,
         const ModelOptions& options)
      : data_(data), law_(law), options_(options), out_(start), state_(start.state) {
    for (std::size_t f = 0; f < data.frames.size(); ++f)
      if (!data.frames[f].raw.empty()) frames_.push_back(f);
    thin_out(frames_, options.most_frames);
    knots_ = frames_;
    thin_out(knots_, options.most_knots);
    for (const std::size_t f : knots_) angle_.push_back(state_.angle[f]);
    first_ = angle_;
    n_ = Index(knots_.size());
  }

  Result<MotionSolution> run(const RunContext& context) {
    if (knots_.size() < 3) return std::move(out_);
    places_ = surface_places(data_, state_, options_.most_places);
    height_.assign(places_.size(), 0.0);
    double reach = kFirstReach_m;
    for (int i = 0; i < options_.iterations; ++i) {
      TURNSCAN_TRY(context.check());
      observe(reach);
      if (!weigh()) return std::move(out_);
      accumulate();
      TURNSCAN_TRY(solve());
      if (apply() < kStationary) break;
      reach = std::max(kLeastReach_m, 8.0 * scale_m_);
    }
    return finished();
  }

 private:
  static void thin_out(std::vector<std::size_t>& list, std::size_t most) {
    const std::size_t n = list.size();
    if (n <= most) return;
    for (std::size_t k = 0; k < most; ++k) list[k] = list[k * (n - 1) / (most - 1)];
    list.resize(most);
  }

  /// The knot before a frame, and how far the frame is on the way to the next.
  std::pair<Index, double> between(std::size_t frame) const {
    const auto next = std::upper_bound(knots_.begin(), knots_.end(), frame);
    const Index a = std::clamp<Index>(Index(next - knots_.begin()) - 1, 0, n_ - 2);
    const auto low = double(knots_[std::size_t(a)]), high = double(knots_[std::size_t(a) + 1]);
    return {a, std::clamp((double(frame) - low) / (high - low), 0.0, 1.0)};
  }

  Eigen::Matrix3d turn_of(std::size_t frame) const {
    return Eigen::AngleAxisd(state_.angle[frame], state_.axis).toRotationMatrix();
  }

  void observe(double reach) {
    seen_.assign(frames_.size(), {});
    parallel_for(frames_.size(), 4, [&](std::size_t k) {
      const MotionView& view = data_.frames[frames_[k]].raw;
      const Eigen::Matrix3d R = turn_of(frames_[k]);
      for (std::size_t s = 0; s < places_.size(); ++s) {
        const Vec3d q = state_.center + R * (places_[s].p - state_.center);
        const Vec3d m = R * places_[s].n;
        const double cosine = -m.dot(q) / q.norm();
        Vec3d found;
        if (cosine < kLowCosine || !data_.look_up(view, q, reach, found)) continue;
        const double full = (cosine - kLowCosine) / (kFullCosine - kLowCosine);
        seen_[k].push_back(
            {std::uint32_t(s), float(m.dot(found - q)), float(std::clamp(full, 0.02, 1.0)), 0.0f});
      }
    });
  }

  /// Heights of the places, robustly, and the weights with that. False when too little is seen.
  bool weigh() {
    std::fill(height_.begin(), height_.end(), 0.0);
    for (int round = 0; round < 3; ++round) {
      std::vector<float> sizes;
      for (const auto& seen : seen_)
        for (std::size_t i = 0; i < seen.size(); i += 4) sizes.push_back(std::abs(left(seen[i])));
      if (sizes.size() < kLeastSeen / 4) return false;
      scale_m_ = std::max(1.4826 * median(sizes), 1e-7);
      std::vector<double> sum(places_.size(), 0.0), total(places_.size(), 0.0);
      for (auto& seen : seen_) {
        for (Seen& o : seen) {
          const double size = std::abs(left(o)), limit = kHuber * scale_m_;
          const double huber = size > 4.0 * limit ? 0.0 : size > limit ? limit / size : 1.0;
          o.weight = float(huber * o.incidence);
          sum[o.place] += double(o.weight) * double(o.r), total[o.place] += o.weight;
        }
      }
      for (std::size_t s = 0; s < places_.size(); ++s)
        height_[s] = total[s] > 0.0 ? sum[s] / total[s] : 0.0;
    }
    return true;
  }

  /// What is left of a distance when the place has its height.
  float left(const Seen& o) const { return o.r - float(height_[o.place]); }

  /// One frame's equations: two tilts, two shifts, its angle.
  struct FrameSum {
    Matrix5 normal = Matrix5::Zero();
    Vector5 right = Vector5::Zero(), left = Vector5::Zero();
  };

  void accumulate() {
    const Index size = n_ + 4, places = Index(places_.size());
    matrix_ = Eigen::MatrixXd::Zero(size, size);
    right_ = Eigen::VectorXd::Zero(size);
    rows_ = MatrixF::Zero(places, size);
    total_ = sums_ = Eigen::VectorXd::Zero(places);
    out_.residuals = 0;
    double squares = 0.0;
    std::vector<FrameSum> blocks(kBlocks);
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      FrameSum sum;
      squares += add_frame(k, sum);
      FrameSum& block = blocks[k * kBlocks / frames_.size()];
      block.normal += sum.normal, block.left += sum.left;
    }
    out_.rms_m = std::sqrt(squares / double(std::max<std::size_t>(1, out_.residuals)));
    out_.scale_m = scale_m_;
    unit_ = out_.unit_m2 = scale_m_ * scale_m_ * excess_of(blocks);
    eliminate_heights();
  }

  /// Returns the sum of its weighted squares.
  double add_frame(std::size_t k, FrameSum& sum) {
    const auto [u, v] = across(state_.axis);
    const auto [knot, share] = between(frames_[k]);
    const Eigen::Matrix3d R = turn_of(frames_[k]), shift = Eigen::Matrix3d::Identity() - R;
    const Vec3d shift_u = shift * u, shift_v = shift * v;
    double squares = 0.0;
    for (const Seen& o : seen_[k]) {
      if (o.weight == 0.0f) continue;
      const SurfacePlace& place = places_[o.place];
      const Vec3d d = place.p - state_.center, turned = R * d, m = R * place.n;
      const Vec3d tilt = turned.cross(m) - d.cross(place.n);
      Vector5 row;
      row << tilt.dot(u), tilt.dot(v), m.dot(shift_u), m.dot(shift_v),
          m.dot(state_.axis.cross(turned));
      const double w = o.weight, off = left(o);
      sum.normal.noalias() += w * row * row.transpose();
      sum.right += w * double(o.r) * row;
      sum.left += w * off * row;
      squares += w * off * off;
      const auto s = Index(o.place);
      rows_(s, knot) += float(w * (1.0 - share) * row[4]);
      rows_(s, knot + 1) += float(w * share * row[4]);
      for (Index j = 0; j < 4; ++j) rows_(s, n_ + j) += float(w * row[j]);
      total_[s] += w;
      sums_[s] += w * double(o.r);
      ++out_.residuals;
    }
    add_block(sum, knot, share);
    return squares;
  }

  /// The lower half of the matrix is filled.
  void add_block(const FrameSum& sum, Index knot, double share) {
    const std::array<double, 2> part{1.0 - share, share};
    for (Index a = 0; a < 2; ++a) {
      const double pa = part[std::size_t(a)];
      for (Index b = 0; b <= a; ++b)
        matrix_(knot + a, knot + b) += pa * part[std::size_t(b)] * sum.normal(4, 4);
      matrix_.block<4, 1>(n_, knot + a) += pa * sum.normal.topRightCorner<4, 1>();
      right_[knot + a] += pa * sum.right[4];
    }
    matrix_.bottomRightCorner<4, 4>() += sum.normal.topLeftCorner<4, 4>();
    right_.tail<4>() += sum.right.head<4>();
  }

  /// Errors that neighbouring pixels and frames share do not average out: what a stretch of frames
  /// says of an unknown that all share is then farther off than independent noise would make it.
  double excess_of(const std::vector<FrameSum>& blocks) const {
    constexpr double kMedianOfSquare = 0.455;  // of a standard normal
    double worst = 1.0;
    for (Index j = 0; j < 4; ++j) {
      std::vector<double> ratios;
      for (const FrameSum& block : blocks) {
        const double expected = block.normal(j, j) * scale_m_ * scale_m_;
        if (expected > 0.0) ratios.push_back(block.left[j] * block.left[j] / expected);
      }
      if (ratios.size() >= 8) worst = std::max(worst, median(ratios) / kMedianOfSquare);
    }
    return worst;
  }

  void eliminate_heights() {
    Eigen::VectorXf inverse = Eigen::VectorXf::Zero(total_.size());
    for (Index s = 0; s < total_.size(); ++s)
      if (total_[s] > 0.0) inverse[s] = float(1.0 / total_[s]);
    right_ -= (rows_.transpose() * sums_.cast<float>().cwiseProduct(inverse)).cast<double>();
    const MatrixF scaled = inverse.cwiseSqrt().asDiagonal() * rows_;
    constexpr Index kWidth = 48;
    const Index size = n_ + 4, count = (size + kWidth - 1) / kWidth;
    parallel_for(std::size_t(count * count), 1, [&](std::size_t t) {
      const Index a = Index(t) / count, b = Index(t) % count;
      if (b > a) return;
      const Index na = std::min(kWidth, size - a * kWidth),
                  nb = std::min(kWidth, size - b * kWidth);
      matrix_.block(a * kWidth, b * kWidth, na, nb) -=
          (scaled.middleCols(a * kWidth, na).transpose() * scaled.middleCols(b * kWidth, nb))
              .cast<double>();
    });
  }

  struct System {
    Eigen::MatrixXd matrix;  ///< lower half
    Eigen::VectorXd right;
  };

  /// What was seen, and what a law and the platter say.
  System with_law(const AngleLaw& law) const {
    System out{matrix_, right_};
    const AddLawRow add = [&](std::span<const LawTerm> terms, double error, double worth) {
      for (const auto& [i, a] : terms) {
        out.right[i] -= unit_ * worth * a * error;
        for (const auto& [k, b] : terms)
          if (i >= k) out.matrix(i, k) += unit_ * worth * a * b;
      }
    };
    add_law(data_, knots_, angle_, law, add);
    add_axis_prior(data_, state_.axis, state_.center, unit_, out.matrix.bottomRightCorner<4, 4>(),
                   out.right.tail<4>());
    return out;
  }

  /// -2 times the logarithm of the evidence for a law, up to a constant: what the data and the law
  /// lose by the best step, and how narrow the law and the data make the angles.
  double misfit_of(const AngleLaw& law) const {
    const System system = with_law(law);
    const Eigen::LDLT<Eigen::MatrixXd> factors(system.matrix);
    const Eigen::VectorXd step = factors.solve(system.right);
    std::vector<double> angle = angle_;
    for (std::size_t k = 0; k < angle.size(); ++k) angle[k] += step[Index(k)];
    const Eigen::VectorXd pulled = matrix_.selfadjointView<Eigen::Lower>() * step;
    const double lost = step.dot(pulled) - 2.0 * right_.dot(step);
    const AddLawRow none = [](std::span<const LawTerm>, double, double) {};
    return lost / unit_ + add_law(data_, knots_, angle, law, none) +
           (factors.vectorD().array() / unit_).log().sum();
  }

  /// The model tells laws apart that pairs of views, with the leads of their own, do not.
  void choose_wander() {
    if (!law_.timed) return;
    double least = std::numeric_limits<double>::infinity();
    AngleLaw law = law_;
    for (const double wander : kWanders) {
      law.wander = wander;
      const double misfit = misfit_of(law);
      if (misfit < least) law_.wander = wander, least = misfit;
    }
  }

  Result<> solve() {
    choose_wander();
    const System system = with_law(law_);
    factors_.compute(system.matrix);
    step_ = factors_.solve(system.right);
    if (factors_.info() != Eigen::Success || !step_.allFinite())
      return fail(ErrorCode::kLibrary, "motion: the system of equations cannot be solved");
    return {};
  }

  /// Returns how far the farthest angle moved, or the axis tilted.
  double apply() {
    const Eigen::VectorXd turned = rows_.cast<double>() * step_;
    for (Index s = 0; s < total_.size(); ++s) {
      if (!(total_[s] > 0.0)) continue;
      SurfacePlace& place = places_[std::size_t(s)];
      const double height = (sums_[s] - turned[s]) / total_[s];
      place.p += std::clamp(height, -kMostHeight_m, kMostHeight_m) * place.n;
    }
    const double tilted = move_axis(step_.tail<4>(), state_.axis, state_.center).first;
    for (Index k = 0; k < n_; ++k) angle_[std::size_t(k)] += std::clamp(step_[k], -0.1, 0.1);
    for (std::size_t f = 0; f < state_.angle.size(); ++f) {
      const auto [a, share] = between(f);
      const auto change = [&](Index k) { return angle_[std::size_t(k)] - first_[std::size_t(k)]; };
      state_.angle[f] = out_.state.angle[f] + change(a) + share * (change(a + 1) - change(a));
    }
    return std::max(tilted, step_.head(n_).cwiseAbs().maxCoeff());
  }

  MotionSolution finished() {
    const Index size = factors_.rows();
    const Eigen::MatrixXd inverse = factors_.solve(Eigen::MatrixXd::Identity(size, size));
    out_.covariance = unit_ * inverse.bottomRightCorner<4, 4>();
    for (std::size_t f = 0; f < out_.angle_sigma.size(); ++f) {
      const auto [a, share] = between(f);
      const double low = inverse(a, a), high = inverse(a + 1, a + 1);
      out_.angle_sigma[f] = std::sqrt(unit_ * std::max(0.0, low + share * (high - low)));
    }
    out_.state = state_;
    return std::move(out_);
  }

  const MotionData& data_;
  AngleLaw law_;
  const ModelOptions& options_;
  MotionSolution out_;
  MotionState state_;
  std::vector<std::size_t> frames_, knots_;  ///< positions in data_.frames
  std::vector<double> angle_, first_;        ///< of the knots: now, and at the start
  Index n_ = 0;
  std::vector<SurfacePlace> places_;
  std::vector<double> height_;
  std::vector<std::vector<Seen>> seen_;  ///< per frame of frames_
  double scale_m_ = 0.0, unit_ = 1.0;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_, step_, total_, sums_;
  MatrixF rows_;  ///< per place: what its height changes by with each unknown, weighted
  Eigen::LDLT<Eigen::MatrixXd> factors_;
};

}  // namespace

Result<MotionSolution> solve_model(const MotionData& data, const MotionSolution& start,
                                   const AngleLaw& law, const ModelOptions& options,
                                   const RunContext& context) {
  return Bundle(data, start, law, options).run(context);
}

}  // namespace turnscan::detail
