#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/turntable/motion_law.hpp>

namespace turnscan::detail {

namespace {

constexpr double kStill = 2e-5;  // radians from frame to frame while the table stands
constexpr double kStart = 0.5;   // of the speed in a second, while the table starts or stops

class Law {
 public:
  Law(const MotionData& data, const std::vector<std::size_t>& frames,
      const std::vector<double>& angle, const AngleLaw& law, const AddLawRow& add)
      : data_(data), frames_(frames), angle_(angle), law_(law), add_(add), n_(int(frames.size())) {}

  double run() {
    add_(std::array{LawTerm{0, 1.0}}, angle_[0], 1.0 / (1e-7 * 1e-7));
    if (law_.nominal_sigma_rad > 0.0) add_nominal();
    if (law_.timed) add_speed();
    // Keeps a frame that shows nothing from being without any equation.
    for (int i = 0; i < n_; ++i) add_(std::array{LawTerm{i, 1.0}}, 0.0, 1e-2);
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
      const double nominal = law_.nominal_sign * (*frame(i).nominal_rad - zero);
      add_(std::array{LawTerm{i, 1.0}}, angle(i) - nominal,
           1.0 / (law_.nominal_sigma_rad * law_.nominal_sigma_rad));
    }
  }

  void add_speed() {
    for (int i = 0; i + 1 < n_; ++i) {
      if (!is(law_.still, i) || !is(law_.still, i + 1)) continue;
      add_(std::array{LawTerm{i + 1, 1.0}, LawTerm{i, -1.0}}, angle(i + 1) - angle(i),
           1.0 / (kStill * kStill));
    }
    for (int i = 1; i + 1 < n_; ++i) add_change(i);
    if (!law_.stated_rad_s) return;
    const double span = time(n_ - 1) - time(0);
    const double sigma = std::max(1e-3 * std::abs(*law_.stated_rad_s) * span, 1e-4);
    add_(std::array{LawTerm{n_ - 1, 1.0}}, angle(n_ - 1) - *law_.stated_rad_s * span,
         1.0 / (sigma * sigma));
  }

  /// The change of speed at frame i.
  void add_change(int i) {
    const double h = time(i) - time(i - 1), g = time(i + 1) - time(i);
    if (!(h > 0.0 && g > 0.0)) return;
    const double error = (angle(i + 1) - angle(i)) / g - (angle(i) - angle(i - 1)) / h;
    const double speed = std::abs(law_.speed_rad_s);
    const double sigma =
        (is(law_.loose, i) ? kStart : law_.wander) * speed * std::sqrt(0.5 * (g + h));
    // A start or a stop is a large change at one moment.
    const double robust = 1.0 / (1.0 + std::pow(error / (4.0 * sigma), 2));
    cost_ += 16.0 * std::log1p(std::pow(error / (4.0 * sigma), 2)) + 2.0 * std::log(sigma);
    add_(std::array{LawTerm{i + 1, 1.0 / g}, LawTerm{i, -1.0 / g - 1.0 / h},
                    LawTerm{i - 1, 1.0 / h}},
         error, robust / (sigma * sigma));
  }

  const MotionData& data_;
  const std::vector<std::size_t>& frames_;
  const std::vector<double>& angle_;
  const AngleLaw& law_;
  const AddLawRow& add_;
  int n_;
  double cost_ = 0.0;
};

}  // namespace

double add_law(const MotionData& data, const std::vector<std::size_t>& frames,
               const std::vector<double>& angle, const AngleLaw& law, const AddLawRow& add) {
  return Law(data, frames, angle, law, add).run();
}

void add_axis_prior(const MotionData& data, const Vec3d& axis, const Vec3d& center, double unit,
                    Eigen::Ref<Eigen::Matrix4d> normal, Eigen::Ref<Eigen::Vector4d> right) {
  const double tilt = data.platter ? 0.002 : 0.35, shift = data.platter ? 0.003 : 0.2;
  const Eigen::Vector4d weight =
      unit * Eigen::Vector4d(1.0 / (tilt * tilt), 1.0 / (tilt * tilt), 1.0 / (shift * shift),
                             1.0 / (shift * shift));
  normal.diagonal() += weight;
  if (!data.platter) return;
  const auto [u, v] = across(axis);
  const Vec3d lean = axis.cross(data.platter->axis);  // the turn that would get there
  const Vec3d off = data.platter->center_m - center;
  right += weight.cwiseProduct(Eigen::Vector4d(lean.dot(u), lean.dot(v), off.dot(u), off.dot(v)));
}

std::pair<Vec3d, Vec3d> across(const Vec3d& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3d u = n.cross(Vec3d::Unit(least)).normalized();
  return {u, n.cross(u)};
}

std::pair<double, double> move_axis(const Eigen::Vector4d& step, Vec3d& axis, Vec3d& center) {
  const auto [u, v] = across(axis);
  const Vec3d turn = step[0] * u + step[1] * v, shift = step[2] * u + step[3] * v;
  const double size = std::min(turn.norm(), 0.2);
  if (size > 0.0) axis = (Eigen::AngleAxisd(size, turn.normalized()) * axis).normalized();
  center += shift * std::min(1.0, 0.05 / std::max(shift.norm(), 1e-12));
  return {size, shift.norm()};
}

}  // namespace turnscan::detail
