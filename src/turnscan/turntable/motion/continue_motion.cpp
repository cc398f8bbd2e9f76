#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/motion/continue_motion.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/pairwise_solver.hpp>

namespace turnscan::motion {

namespace {

constexpr double kOverlap = 0.35;          ///< rad: maximum angle to the partners of later frames
constexpr std::size_t kMaxLater = 240;     ///< of the later frames that are read; others are
                                           ///< interpolated
constexpr std::size_t kMaxPartners = 100;  ///< on either side

class MotionContinuation {
 public:
  MotionContinuation(const FrameSequence& sequence, const Calibration& first,
                     const DetectOptions& detect, const RunContext& context)
      : sequence_(sequence),
        frames_(sequence.frames()),
        known_(first.angles_rad.size()),
        first_(first),
        detect_(detect),
        context_(context) {}

  Result<ContinuedMotion> run() {
    if (known_ < 3 || known_ >= frames_.size())
      return fail(ErrorCode::kInvalidOption,
                  "motion: a calibration with {} angles cannot be continued to {} frames", known_,
                  frames_.size());
    TURNSCAN_TRY(predict());
    ContinuedMotion out;
    out.calibration = first_;
    angle_sigma_.assign(frames_.size(), std::nan(""));
    const auto& missing = first_.undetermined;
    if (std::find(missing.begin(), missing.end(), "angles") == missing.end()) {
      TURNSCAN_ASSIGN(out.noise_m, fit());
    }
    std::copy(first_.angles_rad.begin(), first_.angles_rad.end(), angle_.begin());
    std::copy(first_.angle_sigma_rad.begin(), first_.angle_sigma_rad.end(), angle_sigma_.begin());
    out.calibration.angles_rad = std::move(angle_);
    out.calibration.angle_sigma_rad = std::move(angle_sigma_);
    return out;
  }

 private:
  bool usable(std::size_t i) const {
    return frames_[i].status == FrameStatus::kOk && frames_[i].sensor == 0;
  }

  /// Predicts the angles from the speed of the last stretch and the frames' times, or from their
  /// own angles.
  Result<> predict() {
    angle_ = first_.angles_rad;
    const std::size_t last = known_ - 1;
    std::size_t from = last;
    while (from > 0 && std::abs(angle_[from] - angle_[last]) < kOverlap) --from;
    const double span = frames_[last].time_s - frames_[from].time_s;
    speed_ = (angle_[last] - angle_[from]) / span;
    const auto nominal = [&](std::size_t i) { return frames_[i].angle_rad; };
    const bool by_angles = std::all_of(frames_.begin(), frames_.end(),
                                       [](const FrameInfo& f) { return f.angle_rad.has_value(); });
    if (!by_angles && !std::isfinite(speed_))
      return fail(ErrorCode::kInvalidOption,
                  "motion: frames without times and angles cannot be continued");
    const bool reversed =
        by_angles && (*nominal(last) - *nominal(from)) * (angle_[last] - angle_[from]) < 0.0;
    for (std::size_t i = known_; i < frames_.size(); ++i) {
      const double step = by_angles ? (reversed ? -1.0 : 1.0) * (*nominal(i) - *nominal(last))
                                    : speed_ * (frames_[i].time_s - frames_[last].time_s);
      angle_.push_back(angle_[last] + step);
      if (!std::isfinite(step))
        return fail(ErrorCode::kInvalidOption, "motion: frame {} has no time", frames_[i].index);
    }
    return {};
  }

  /// Frames that are read: partners among those with known angles, then some of the later ones.
  std::vector<std::size_t> choose() {
    std::vector<std::size_t> before, earlier, later;
    const auto [low, high] =
        std::minmax_element(angle_.begin() + std::ptrdiff_t(known_ - 1), angle_.end());
    for (std::size_t i = 0; i < known_; ++i) {
      if (!usable(i)) continue;
      if (std::abs(angle_[i] - angle_[known_ - 1]) < kOverlap) {
        before.push_back(i);
        continue;
      }
      for (const double turn : {-kTurn, kTurn})
        if (angle_[i] > *low + turn - kOverlap && angle_[i] < *high + turn + kOverlap)
          earlier.push_back(i);
    }
    for (std::size_t i = known_; i < frames_.size(); ++i)
      if (usable(i)) later.push_back(i);
    std::vector<std::size_t> out = evenly_spread_to_last(earlier, kMaxPartners);
    for (const std::size_t i : evenly_spread_to_last(before, kMaxPartners)) out.push_back(i);
    std::sort(out.begin(), out.end());
    for (const std::size_t i : evenly_spread_to_last(later, kMaxLater)) out.push_back(i);
    return out;
  }

  /// Returns the noise of one depth value.
  Result<double> fit() {
    const std::vector<std::size_t> chosen = choose();
    const SequenceView excerpt(sequence_, chosen);
    MotionDataOptions loading;
    loading.detect = detect_;
    loading.max_keys = chosen.size();
    loading.hint = first_.table;
    TURNSCAN_ASSIGN(const MotionData data, load_motion(excerpt, loading, context_));
    MotionState state;
    state.axis = first_.table.axis.normalized();
    state.center = first_.table.center_m;
    AnglePrior prior;
    prior.timed = true;
    prior.speed_rad_s = speed_;
    const double zero = angle_[chosen.front()];
    for (const MotionFrame& frame : data.frames) {
      const std::size_t i = chosen[frame.position];
      state.angle.push_back(angle_[i] - zero);
      prior.held.push_back(i < known_ ? 1 : 0);
      prior.timed &= std::isfinite(frame.time_s);
    }
    std::vector<FramePair> pairs = select_pairs(data, state.angle, false);
    std::erase_if(pairs,
                  [&](const FramePair& p) { return prior.held[p.from] && prior.held[p.to]; });
    SolveOptions options;
    options.hold_axis = true;
    options.reach_m = 0.02;
    options.floor_m = 0.001;
    options.iterations = 8;
    options.covariance = true;
    TURNSCAN_ASSIGN(const MotionSolution found,
                    solve_pairwise(data, state, pairs, prior, options, context_));
    for (std::size_t k = 0; k < data.frames.size(); ++k) {
      const std::size_t i = chosen[data.frames[k].position];
      if (i < known_) continue;
      angle_[i] = found.state.angle[k] + zero;
      angle_sigma_[i] = found.angle_sigma[k];
    }
    put_between(chosen);
    return data.noise_m;
  }

  /// Frames that were not read deviate from the prediction as their neighbours do.
  void put_between(const std::vector<std::size_t>& chosen) {
    const std::vector<double> fitted = angle_;
    if (!predict()) return;  // succeeded before
    const std::vector<double> predicted = std::exchange(angle_, fitted);
    std::size_t a = known_ - 1, next = 0;
    for (std::size_t i = known_; i < frames_.size(); ++i) {
      while (next < chosen.size() && chosen[next] < i) ++next;
      if (next < chosen.size() && chosen[next] == i) {
        a = i;
        continue;
      }
      const std::size_t b = next < chosen.size() ? chosen[next] : a;
      const double share = b > a ? double(i - a) / double(b - a) : 0.0;
      const double off_a = fitted[a] - predicted[a], off_b = fitted[b] - predicted[b];
      angle_[i] = predicted[i] + off_a + share * (off_b - off_a);
    }
  }

  const FrameSequence& sequence_;
  const std::vector<FrameInfo>& frames_;
  std::size_t known_;
  const Calibration& first_;
  const DetectOptions& detect_;
  const RunContext& context_;
  double speed_ = 0.0;
  std::vector<double> angle_, angle_sigma_;
};

}  // namespace

}  // namespace turnscan::motion

namespace turnscan {

Result<ContinuedMotion> continue_motion(const FrameSequence& sequence, const Calibration& first,
                                        const DetectOptions& detect, const RunContext& context) {
  return motion::MotionContinuation(sequence, first, detect, context).run();
}

}  // namespace turnscan
