#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/turntable/checks/motor_events.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>

namespace turnscan::checks {

namespace {

using motion::MotionData;
using motion::MotionState;

constexpr double kStretchTurn = 12.0 * kRadiansPerDegree;  ///< between the frames compared
constexpr double kReach = 70.0 * kRadiansPerDegree;        ///< search range, coarse to fine
constexpr double kCoarse = 1.5 * kRadiansPerDegree, kFine = 0.5 * kRadiansPerDegree;
/// Minimum size of an event; and half of the expected rotation.
constexpr double kMinEvent = 5.0 * kRadiansPerDegree;
constexpr std::size_t kPairsPerStretch = 6, kSamples = 250;

struct Stretch {
  std::size_t first = 0, last = 0;  ///< frames
  double turn = 0.0;                ///< observed rotation
  double least = 1.0;               ///< its cost
  double steepness = 0.0;           ///< increase of the cost 5 degrees to either side
};

class MotorEventFinder {
 public:
  MotorEventFinder(const MotionData& data, const MotionState& state,
                   const std::vector<double>& expected, double speed_rad_s)
      : data_(data),
        state_(state),
        expected_(expected),
        speed_(speed_rad_s),
        gate_(data.inlier_gate_m()) {}

  Result<MotorObservation> run(double from_s, double to_s, const RunContext& context) {
    place_stretches(from_s, to_s);
    TURNSCAN_TRY(
        parallel_for(stretches_.size(), 1, context, [&](std::size_t k) { search(stretches_[k]); }));
    MotorObservation out;
    std::vector<double> speeds;
    for (const Stretch& s : stretches_)
      if (shows_turn(s)) speeds.push_back(s.turn / (time(s.last) - time(s.first)));
    out.observed_share =
        stretches_.empty() ? 0.0 : double(speeds.size()) / double(stretches_.size());
    if (expected_.empty()) speed_ = median(speeds, speed_);
    out.speed_rad_s = speed_;
    for (std::size_t k = 0; k < stretches_.size(); ++k) {
      const std::size_t end = end_of_event(k);
      if (end == k) continue;
      out.events.push_back(event_of(k, end));
      k = end;
    }
    return out;
  }

 private:
  double time(std::size_t frame) const { return data_.frames[frame].time_s; }

  double expected(std::size_t first, std::size_t last) const {
    return expected_.empty() ? speed_ * (time(last) - time(first))
                             : expected_[last] - expected_[first];
  }

  /// Each moment is in two stretches.
  void place_stretches(double from_s, double to_s) {
    const std::size_t n = data_.frames.size();
    for (std::size_t a = 0; a + 1 < n;) {
      if (time(a) < from_s) {
        ++a;
        continue;
      }
      std::size_t b = a + 1;
      while (b < n && std::abs(expected(a, b)) < kStretchTurn) {
        // Recorded angles may be constant for long.
        if (time(b) - time(a) > 3.0 * kStretchTurn / std::max(std::abs(speed_), 1e-6)) break;
        ++b;
      }
      if (b >= n || time(b) > to_s) return;
      stretches_.push_back({.first = a, .last = b});
      a += std::max<std::size_t>(1, (b - a) / 2);
    }
  }

  /// Mean misfit of pairs of frames that start in the stretch's first quarter.
  double cost(const Stretch& s, double more) const {
    const std::size_t quarter = std::max<std::size_t>(1, (s.last - s.first) / 4);
    double sum = 0.0, count = 0.0;
    for (std::size_t m = 0; m < quarter; m += 1 + quarter / kPairsPerStretch) {
      const std::size_t b = s.last + m;
      if (b >= data_.frames.size()) break;
      sum += one_cost(s.first + m, b, expected(s.first + m, b) + more);
      count += 1.0;
    }
    return sum / count;
  }

  double one_cost(std::size_t a, std::size_t b, double turn) const {
    const auto from = std::uint32_t(a), to = std::uint32_t(b);
    double sum = 0.0, count = 0.0;
    if (!data_.frames[b].surface.empty()) {
      sum += motion::pair_cost(data_, state_, {from, to}, turn, gate_, kSamples);
      count += 1.0;
    }
    if (!data_.frames[a].surface.empty()) {
      sum += motion::pair_cost(data_, state_, {to, from}, -turn, gate_, kSamples);
      count += 1.0;
    }
    return count > 0.0 ? sum / count : 1.0;
  }

  void search(Stretch& s) const {
    double best = 0.0;
    s.least = cost(s, 0.0);
    const auto try_turn = [&](double more) {
      const double here = cost(s, more);
      if (here < s.least) best = more, s.least = here;
    };
    const int coarse = int(kReach / kCoarse), fine = int(kCoarse / kFine);
    for (int i = -coarse; i <= coarse; ++i) try_turn(kCoarse * i);
    const double middle = best;
    for (int i = -fine; i <= fine; ++i) try_turn(middle + kFine * i);
    s.turn = expected(s.first, s.last) + best;
    s.steepness = std::min(cost(s, best - kMinEvent), cost(s, best + kMinEvent)) - s.least;
  }

  /// Whether the fit is clearly worse when rotated farther to either side.
  static bool shows_turn(const Stretch& s) { return s.steepness > std::max(0.03, 0.15 * s.least); }

  double off(const Stretch& s) const { return s.turn - expected(s.first, s.last); }

  bool is_event(const Stretch& s) const {
    const double wide = std::max(kMinEvent, 0.5 * std::abs(expected(s.first, s.last)));
    if (std::abs(off(s)) < wide) return false;
    return cost(s, 0.0) - s.least > std::max(0.04, 0.3 * s.least);
  }

  /// A single stretch between two that belong to an event may be inconclusive.
  std::size_t end_of_event(std::size_t begin) const {
    std::size_t end = begin;
    for (std::size_t k = begin; k < std::min(end + 2, stretches_.size()); ++k) {
      if (k == begin + 1 && end == begin) break;
      const bool same_way = off(stretches_[k]) * off(stretches_[begin]) > 0.0;
      if (same_way && is_event(stretches_[k])) end = k + 1;
    }
    return end;
  }

  /// A stop removes at most the rotation that would have taken place; each moment counts twice.
  MotorEvent event_of(std::size_t begin, std::size_t end) const {
    const std::size_t low = begin > 0 ? begin - 1 : 0, high = std::min(end + 1, stretches_.size());
    double sum = 0.0, jump = 0.0, least = 2.0;
    bool stop = true;
    for (std::size_t k = low; k < high; ++k) {
      const Stretch& s = stretches_[k];
      const bool inside = k >= begin && k < end;
      if (inside) {
        if (s.least < least) jump = off(s), least = s.least;
        const double share = off(s) / (speed_ * (time(s.last) - time(s.first)));
        stop = stop && share < 0.0 && share > -1.35;
      }
      if (inside || shows_turn(s)) sum += 0.5 * off(s);
    }
    MotorEvent event;
    event.size_rad = stop ? sum : jump;
    event.lasts_s = stop ? std::abs(sum / speed_) : 0.0;
    event.time_s = moment(stretches_[low].first, stretches_[high - 1].last, event);
    return event;
  }

  /// The moment, among all at which the event can have begun, with which the frames fit best.
  double moment(std::size_t first, std::size_t last, const MotorEvent& event) const {
    const std::size_t step = 1 + (last - first) / 60;
    double least = 0.0, best = time(first);
    bool any = false;
    for (std::size_t c = first; c < last; c += step) {
      const double begun = 0.5 * (time(c) + time(c + 1));
      const auto more = [&](std::size_t i) {
        if (event.lasts_s <= 0.0) return time(i) > begun ? event.size_rad : 0.0;
        return event.size_rad * std::clamp((time(i) - begun) / event.lasts_s, 0.0, 1.0);
      };
      double sum = 0.0;
      for (const Stretch& s : stretches_) {
        if (s.first < first || s.last > last) continue;
        const std::size_t half = std::max<std::size_t>(1, (s.last - s.first) / 2);
        for (std::size_t m = 0; m <= half; m += 1 + half / 4) {
          const std::size_t a = s.first + m, b = std::min(s.last + m, data_.frames.size() - 1);
          sum += one_cost(a, b, expected(a, b) + more(b) - more(a));
        }
      }
      if (!any || sum < least) least = sum, best = begun, any = true;
    }
    return best;
  }

  const MotionData& data_;
  const MotionState& state_;
  const std::vector<double>& expected_;
  double speed_;
  double gate_;
  std::vector<Stretch> stretches_;
};

}  // namespace

Result<MotorObservation> find_motor_events(const MotionData& data, const MotionState& state,
                                           const std::vector<double>& expected, double speed_rad_s,
                                           double from_s, double to_s, const RunContext& context) {
  return MotorEventFinder(data, state, expected, speed_rad_s).run(from_s, to_s, context);
}

}  // namespace turnscan::checks
