// Detection of the platter on random rigs with known truth. Usage: calibration_rigs [RIGS] [FRAMES]

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/detection/detect.hpp>

#include "tests/support/rig.hpp"

namespace {

using namespace turnscan;

struct Outcome {
  double axis_deg = 0.0, center_mm = 0.0, elevation_deg = 0.0;
  bool found = false;
};

Outcome try_rig(std::uint64_t seed, int frames) {
  testing::RigOptions options = testing::random_rig(seed);
  options.frames = frames;
  const testing::Rig rig(options);
  Outcome out;
  out.elevation_deg = options.elevation_rad * kDegreesPerRadian;
  AverageOptions average;
  average.frames = frames;
  const auto scan = average_frames(rig, spread_positions(rig, 0, std::size_t(frames)), average, {});
  const auto start = std::chrono::steady_clock::now();
  const auto platter = scan ? detect_platter(*scan, {}, {}) : tl::unexpected<Error>(scan.error());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("rig {:3} {:5.1f} deg {:4.2f} m r {:5.1f} mm: ", seed, out.elevation_deg,
             options.distance_m, options.radius_m * 1e3);
  if (!platter) {
    fmt::print("refused: {}\n", platter.error().text());
    return out;
  }
  const TurntableInfo truth = rig.truth();
  out.found = true;
  out.axis_deg = std::acos(std::min(1.0, truth.axis.dot(platter->axis))) * kDegreesPerRadian;
  out.center_mm = (truth.center_m - platter->center_m).norm() * 1e3;
  const Vec3d back = (truth.center_m - truth.center_m.dot(truth.axis) * truth.axis).normalized();
  fmt::print("back {:.2f} mm ", back.dot(platter->center_m - truth.center_m) * 1e3);
  fmt::print(
      "axis {:.3f} (+-{:.3f}) deg, centre {:.2f} (+-{:.2f}) mm, radius {:+.2f} mm, rim {:.2f}, "
      "confidence {:.2f}, {:.2f} s\n",
      out.axis_deg, platter->axis_sigma_rad * kDegreesPerRadian, out.center_mm,
      platter->center_sigma_m * 1e3, (platter->radius_m - options.radius_m) * 1e3,
      platter->rim_share, platter->confidence, seconds);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const int rigs = argc > 1 ? std::stoi(argv[1]) : 50;
  const int frames = argc > 2 ? std::stoi(argv[2]) : 30;
  int good = 0, wrong = 0, refused = 0;
  for (int i = 1; i <= rigs; ++i) {
    const Outcome o = try_rig(std::uint64_t(i), frames);
    const double limit = o.elevation_deg < 20.0 ? 2.0 : 1.0;
    if (!o.found) ++refused;
    if (o.found && o.axis_deg < 0.15 && o.center_mm < limit) ++good;
    if (o.found && (o.axis_deg > 1.0 || o.center_mm > 5.0)) ++wrong;
  }
  fmt::print("{} of {} within the limits, {} refused, {} silently wrong\n", good, rigs, refused,
             wrong);
}
