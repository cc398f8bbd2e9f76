// The thesis's experiment (3.6): free registration beside calibration from motion, on one simulated
// recording. Usage: calibration_vs_icp [OBJECT] [FRAMES] [AXIS_ERROR_DEG] [CENTRE_ERROR_MM]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numbers>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/turntable/table_frame.hpp>
#include "bench/free_registration/free_motion.hpp"

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rig.hpp"

namespace {

using namespace turnscan;
using Clock = std::chrono::steady_clock;

/// How far apart the same point of the object lies in any frame and in the first, against the
/// truth: median, 95th percentile, of points 5 cm about the axis.
void report(const char* name, const std::vector<Pose>& poses, const std::vector<Pose>& truth,
            Clock::time_point start) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (const double y : {0.0, 0.1, 0.2}) {
      for (int k = 0; k < 4; ++k) {
        const double a = 0.5 * std::numbers::pi * k;
        const Vec3d p(0.05 * std::cos(a), y, 0.05 * std::sin(a));
        const Vec3d at = poses[i] * (truth[i].inverse() * p);
        const Vec3d first = poses[0] * (truth[0].inverse() * p);
        errors.push_back((at - first).norm() * 1e3);
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  fmt::print("{:18} median {:7.3f} mm, 95 % {:7.3f} mm, largest {:7.3f} mm, {:6.1f} s\n", name,
             errors[errors.size() / 2], errors[errors.size() * 95 / 100], errors.back(),
             std::chrono::duration<double>(Clock::now() - start).count());
}

}  // namespace

int main(int argc, char** argv) {
  const auto argument = [&](int i, double fallback) {
    return argc > i ? std::stod(argv[i]) : fallback;
  };
  testing::RigOptions o = testing::random_rig(1);
  o.frames = int(argument(2, 120));
  o.fps = o.frames / 30.0;
  o.objects = {*builtin_object(argc > 1 ? argv[1] : "doll")};
  o.aim_height_m = 0.09;
  const double speed = 1.1 * 2.0 * std::numbers::pi / 30.0;
  o.angle = [speed](double t) { return speed * t; };
  const testing::Rig rig(o);
  testing::MemorySequence memory;
  memory.header_value = rig.header();
  for (std::size_t i = 0; i < rig.frames().size(); ++i) memory.add(*rig.read(i));
  TurntableInfo table = rig.truth();
  table.speed_rad_s = speed;
  memory.header_value.turntable = table;
  const auto truth = *frame_poses(memory.header(), memory.frames(), std::nullopt);
  // The calibration that all start from is off by so much.
  table.axis = Eigen::AngleAxisd(argument(3, 0.5) / 57.2957795, Vec3d::UnitX()) * table.axis;
  table.center_m.x() += argument(4, 1.0) * 1e-3;
  memory.header_value.turntable = table;
  const auto rough = *frame_poses(memory.header(), memory.frames(), std::nullopt);
  auto start = Clock::now();
  report("as calibrated", rough.T_table_sensor, truth.T_table_sensor, start);
  const auto free = [&](const char* name, FreeMethod method, FreeScheme scheme) {
    start = Clock::now();
    const auto poses = register_frames_freely(memory, rough.T_table_sensor, method, scheme, {});
    if (poses) report(name, *poses, truth.T_table_sensor, start);
  };
  free("ICP consecutive", FreeMethod::kIcp, FreeScheme::kConsecutive);
  free("ICP global", FreeMethod::kIcp, FreeScheme::kGlobal);
  free("GICP consecutive", FreeMethod::kGicp, FreeScheme::kConsecutive);
  free("GICP global", FreeMethod::kGicp, FreeScheme::kGlobal);
  start = Clock::now();
  FromMotionOptions options;
  options.speed_rad_s = speed;
  const auto found = calibrate_from_motion(memory, options, {}, {});
  if (!found) {
    fmt::print("motion: {}\n", found.error().text());
    return 1;
  }
  const auto seen = *with_calibration(memory, *found);
  const auto poses = *frame_poses(seen->header(), seen->frames(), std::nullopt);
  report("motion", poses.T_table_sensor, truth.T_table_sensor, start);
}
