// Calibration from motion against the truth of simulated recordings.
// Usage: calibration_motion [OBJECT] [FRAMES] [TURNS] [RIPPLE] [START_S] [SEED] [PLATTER]
//   [STATED] [ANGLES.csv]: speed that is stated, as a share of the true one (0: none); each frame's
//   time, true angle, error and stated deviation

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rig.hpp"

namespace {

using namespace turnscan;

double argument(int argc, char** argv, int index, double fallback) {
  return argc > index ? std::stod(argv[index]) : fallback;
}

void write_angles(const char* path, const testing::Rig& rig, const Calibration& found) {
  std::ofstream out(path);
  out << "time_s,angle_deg,error_deg,sigma_deg\n";
  for (std::size_t i = 0; i < found.angles_rad.size(); ++i) {
    const double truth = rig.true_angle(i);
    out << fmt::format("{:.4f},{:.4f},{:.5f},{:.5f}\n", rig.frames()[i].time_s,
                       truth * kDegreesPerRadian, (found.angles_rad[i] - truth) * kDegreesPerRadian,
                       found.angle_sigma_rad[i] * kDegreesPerRadian);
  }
}

/// A constant error of all angles but the first turns the finished object, and changes nothing
/// else.
double mean_beside(const std::vector<double>& errors, double constant) {
  double sum = 0.0;
  for (const double e : errors) sum += std::abs(e - constant);
  return sum / double(errors.size());
}

/// Speed grows evenly over start_s; then a ripple, once and five times a turn.
testing::AngleLaw law(double speed, double ripple, double start_s, double wait_s) {
  return [=](double time) {
    const double t = time - wait_s;
    if (t <= 0.0) return 0.0;
    const double a = t < start_s ? 0.5 * speed * t * t / start_s : speed * (t - 0.5 * start_s);
    return a + ripple * (std::sin(a) + 0.2 * std::sin(5.0 * a));
  };
}

}  // namespace

int main(int argc, char** argv) {
  const std::string object = argc > 1 ? argv[1] : "doll";
  const int frames = int(argument(argc, argv, 2, 230));
  const double turns = argument(argc, argv, 3, 1.1), ripple = argument(argc, argv, 4, 0.0);
  const double start_s = argument(argc, argv, 5, 0.0);
  testing::RigOptions o = testing::random_rig(std::uint64_t(argument(argc, argv, 6, 1)));
  o.platter = argument(argc, argv, 7, 1.0) > 0.0;
  o.room = o.platter;
  if (!o.platter) o.clutter = 0;
  o.frames = frames;
  o.fps = 30.0 * frames / 920.0;
  o.objects = {*builtin_object(object)};
  o.aim_height_m = 0.09;
  const double sign = (int(o.seed) % 2) != 0 ? 1.0 : -1.0;
  const double speed = sign * turns * 2.0 * std::numbers::pi / (frames / o.fps);
  o.angle = law(speed, ripple, start_s, start_s > 0.0 ? 0.5 : 0.0);
  const testing::Rig rig(o);
  testing::MemorySequence memory;  // so that making the images is not timed
  memory.header_value = rig.header();
  for (std::size_t i = 0; i < rig.frames().size(); ++i) memory.add(*rig.read(i));
  FromMotionOptions options;
  if (argument(argc, argv, 8, 0.0) > 0.0)
    options.speed_rad_s = speed * argument(argc, argv, 8, 1.0);
  const auto start = std::chrono::steady_clock::now();
  const auto found = calibrate_from_motion(memory, options, {}, {});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{} frames, {:.2f} s; elevation {:.1f} deg, {:.2f} m\n", frames, seconds,
             o.elevation_rad * kDegreesPerRadian, o.distance_m);
  if (!found) {
    fmt::print("refused: {}\n", found.error().text());
    return 1;
  }
  const TurntableInfo truth = rig.truth();
  const Vec3d off = found->table.center_m - truth.center_m;
  std::vector<double> errors;
  for (std::size_t i = 0; i < found->angles_rad.size(); ++i)
    errors.push_back((found->angles_rad[i] - rig.true_angle(i)) * kDegreesPerRadian);
  const double angles = mean_beside(errors, 0.0);
  double worst = 0.0;
  for (const double e : errors) worst = std::max(worst, std::abs(e));
  fmt::print(
      "axis {:.4f} deg (+- {:.4f}), centre {:.3f} mm across (+- {:.3f}), {:+.3f} along\n",
      std::atan2(truth.axis.cross(found->table.axis).norm(), truth.axis.dot(found->table.axis)) *
          kDegreesPerRadian,
      found->axis_sigma_rad * kDegreesPerRadian,
      (off - off.dot(truth.axis) * truth.axis).norm() * 1e3, found->center_sigma_m * 1e3,
      off.dot(truth.axis) * 1e3);
  fmt::print("speed {:+.5f} % (+- {:.5f}); start {:.3f} s\n",
             100.0 * (*found->table.speed_rad_s / speed - 1.0),
             100.0 * found->speed_sigma_rad_s / std::abs(speed), found->start_s.value_or(-1.0));
  fmt::print(
      "angles: mean error {:.4f} deg, worst {:.4f}; {:.4f} but for the median error, {:+.4f}\n",
      angles, worst, mean_beside(errors, median(errors)), median(errors));
  if (argc > 9) write_angles(argv[9], rig, *found);
  double squares = 0.0;
  for (std::size_t i = 1; i < found->angles_rad.size(); ++i)
    squares += std::pow((found->angles_rad[i] - rig.true_angle(i)) / found->angle_sigma_rad[i], 2);
  fmt::print("angles' errors are {:.2f} times what is stated (root mean square)\n",
             std::sqrt(squares / double(found->angles_rad.size() - 1)));
  fmt::print("residuals {:.3f} mm; {}\nundetermined: {}\n", found->residual_rms_m * 1e3,
             found->axis_found, fmt::join(found->undetermined, ", "));
}
