#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/turntable/motion/angle_prior.hpp>

namespace turnscan::motion {

namespace {

constexpr double kStandingSigma = 2e-5;  // radians from frame to frame while the table stands
constexpr double kTransientWalk = 0.5;  // of the speed in a second, while the table starts or stops

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
    // Keeps a frame that shows nothing from being without any equation.
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
    for (int i = 1; i + 1 < n_; ++i) add_change(i);
    if (!prior_.stated_rad_s) return;
    const double span = time(n_ - 1) - time(0);
    const double sigma = std::max(1e-3 * std::abs(*prior_.stated_rad_s) * span, 1e-4);
    add_(std::array{PriorTerm{n_ - 1, 1.0}}, angle(n_ - 1) - *prior_.stated_rad_s * span,
         1.0 / (sigma * sigma));
  }

  /// The change of speed at frame i.
  void add_change(int i) {
    const double h = time(i) - time(i - 1), g = time(i + 1) - time(i);
    if (!(h > 0.0 && g > 0.0)) return;
    const double error = (angle(i + 1) - angle(i)) / g - (angle(i) - angle(i - 1)) / h;
    const double speed = std::abs(prior_.speed_rad_s);
    const double sigma = (is(prior_.transient, i) ? kTransientWalk : prior_.speed_walk) * speed *
                         std::sqrt(0.5 * (g + h));
    // A start or a stop is a large change at one moment.
    const double robust = 1.0 / (1.0 + std::pow(error / (4.0 * sigma), 2));
    cost_ += 16.0 * std::log1p(std::pow(error / (4.0 * sigma), 2)) + 2.0 * std::log(sigma);
    add_(std::array{PriorTerm{i + 1, 1.0 / g}, PriorTerm{i, -1.0 / g - 1.0 / h},
                    PriorTerm{i - 1, 1.0 / h}},
         error, robust / (sigma * sigma));
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
