#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/turntable/motion/angle_prior.hpp>

namespace turnscan::motion {

namespace {

constexpr double kStandingSigma = 2e-5;  // radians from frame to frame while the table stands
constexpr double kTransientWalk = 0.5;  // relative to the speed, per second, while the table starts
                                        // or stops
constexpr double kSlipSigma = 0.2;      // radians, of the size of a slip

class AnglePriorRows {
 public:
  AnglePriorRows(const MotionData& data, const std::vector<std::size_t>& frames,
                 const std::vector<double>& angle, const AnglePrior& prior, const AddPriorRow& add)
      : data_(data),
        frames_(frames),
        angle_(angle),
        prior_(prior),
        add_(add),
        n_(int(frames.size())) {}

  double run() {
    add_(std::array{PriorTerm{0, 1.0}}, angle_[0], 1.0 / (1e-7 * 1e-7));
    if (prior_.nominal_sigma_rad > 0.0) add_nominal();
    if (prior_.timed) add_speed();
    // Keeps an unobserved frame from being without any equation.
    for (int i = 0; i < n_; ++i) add_(std::array{PriorTerm{i, 1.0}}, 0.0, 1e-2);
    return cost_;
  }

 private:
  const MotionFrame& frame(int i) const { return data_.frames[frames_[std::size_t(i)]]; }
  double time(int i) const { return frame(i).time_s; }
  double angle(int i) const { return angle_[std::size_t(i)]; }
  bool is(const std::vector<std::uint8_t>& flags, int i) const {
    return !flags.empty() && flags[frames_[std::size_t(i)]] != 0;
  }

  void add_nominal() {
    const double zero = *data_.frames[0].nominal_rad;
    for (int i = 1; i < n_; ++i) {
      const double nominal = prior_.nominal_sign * (*frame(i).nominal_rad - zero);
      add_(std::array{PriorTerm{i, 1.0}}, angle(i) - nominal,
           1.0 / (prior_.nominal_sigma_rad * prior_.nominal_sigma_rad));
    }
  }

  void add_speed() {
    for (int i = 0; i + 1 < n_; ++i) {
      if (!is(prior_.still, i) || !is(prior_.still, i + 1)) continue;
      add_(std::array{PriorTerm{i + 1, 1.0}, PriorTerm{i, -1.0}}, angle(i + 1) - angle(i),
           1.0 / (kStandingSigma * kStandingSigma));
    }
    // Gaps between frames, in which the table turned evenly or slipped.
    for (int i = 0, even = -1; i + 1 < n_; ++i) {
      if (slips(i)) {
        add_slip(i);
        continue;
      }
      if (even >= 0) add_change(even, i);
      even = i;
    }
    if (!prior_.stated_rad_s) return;
    const double span = time(n_ - 1) - time(0);
    const double sigma = std::max(1e-3 * std::abs(*prior_.stated_rad_s) * span, 1e-4);
    add_(std::array{PriorTerm{n_ - 1, 1.0}}, angle(n_ - 1) - *prior_.stated_rad_s * span,
         1.0 / (sigma * sigma));
  }

  /// Whether it slips between frame i and the next one of these frames.
  bool slips(int i) const {
    if (prior_.slips.empty()) return false;
    const auto first = prior_.slips.begin() + std::ptrdiff_t(frames_[std::size_t(i)]);
    const auto end = prior_.slips.begin() + std::ptrdiff_t(frames_[std::size_t(i) + 1]);
    return std::any_of(first, end, [](auto flag) { return flag != 0; });
  }

  double gap(int i) const { return time(i + 1) - time(i); }
  double speed(int i) const { return (angle(i + 1) - angle(i)) / gap(i); }

  void add_slip(int i) {
    const double g = gap(i), sigma = kSlipSigma / g;
    if (!(g > 0.0)) return;
    const double error = speed(i) - prior_.speed_rad_s;
    cost_ += std::pow(error / sigma, 2) + 2.0 * std::log(sigma);
    add_(std::array{PriorTerm{i + 1, 1.0 / g}, PriorTerm{i, -1.0 / g}}, error,
         1.0 / (sigma * sigma));
  }

  /// The change of speed from the gap after frame a to that after frame b; if they are not
  /// neighbours, the table slipped between them.
  void add_change(int a, int b) {
    const double h = gap(a), g = gap(b);
    if (!(h > 0.0 && g > 0.0)) return;
    const double error = speed(b) - speed(a);
    const double between = 0.5 * (time(b) + time(b + 1) - time(a) - time(a + 1));
    const double usual = std::abs(prior_.speed_rad_s);
    const double sigma =
        (is(prior_.transient, b) ? kTransientWalk : prior_.speed_walk) * usual * std::sqrt(between);
    // A start or a stop is a large change at one moment.
    const double robust = 1.0 / (1.0 + std::pow(error / (4.0 * sigma), 2));
    const double worth = robust / (sigma * sigma);
    cost_ += 16.0 * std::log1p(std::pow(error / (4.0 * sigma), 2)) + 2.0 * std::log(sigma);
    // For neighbouring gaps the two terms in the middle belong to the same angle.
    add_(std::array{PriorTerm{b + 1, 1.0 / g}, PriorTerm{b, -1.0 / g}, PriorTerm{a + 1, -1.0 / h},
                    PriorTerm{a, 1.0 / h}},
         error, worth);
  }

  const MotionData& data_;
  const std::vector<std::size_t>& frames_;
  const std::vector<double>& angle_;
  const AnglePrior& prior_;
  const AddPriorRow& add_;
  int n_;
  double cost_ = 0.0;
};

}  // namespace

double add_angle_prior(const MotionData& data, const std::vector<std::size_t>& frames,
                       const std::vector<double>& angle, const AnglePrior& prior,
                       const AddPriorRow& add) {
  return AnglePriorRows(data, frames, angle, prior, add).run();
}

}  // namespace turnscan::motion
