// frames_in_memory: depth images of your own, with an angle each. Here they show a ball with a
// radius of 40 mm on a turntable, seen from 30 degrees above.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <turnscan/turnscan.hpp>

constexpr double kRadius = 0.04, kDistance = 0.5, kUnit = 1e-4;  // metres

turnscan::DepthImage depth_of_ball(const turnscan::CameraIntrinsics& camera) {
  turnscan::DepthImage image(camera.width, camera.height, turnscan::kNoReturn);
  for (int row = 0; row < camera.height; ++row)
    for (int column = 0; column < camera.width; ++column) {
      const double a = camera.ray(column, row).squaredNorm();
      const double q = kDistance * kDistance * (1.0 - a) + a * kRadius * kRadius;
      if (q >= 0.0) image.at(column, row) = std::lround((kDistance - std::sqrt(q)) / a / kUnit);
    }
  return image;
}

int main() {
  turnscan::SequenceHeader header;
  header.sensors.resize(1);
  turnscan::SensorInfo& sensor = header.sensors[0];
  sensor.intrinsics = {320, 240, 300.0, 300.0, 159.5, 119.5, {}};
  sensor.depth_unit_m = kUnit;
  const turnscan::Vec3d up(0.0, -std::sqrt(0.75), -0.5);  // sensor frame: y down, z forward
  header.turntable.emplace();
  header.turntable->axis = up;
  header.turntable->center_m = kDistance * turnscan::Vec3d::UnitZ() - kRadius * up;

  turnscan::MemoryFrames frames(header);
  for (int i = 0; i < 36; ++i) {
    turnscan::Frame frame;
    frame.info.index = i;
    frame.info.angle_rad = 2.0 * std::numbers::pi * i / 36;
    frame.depth = depth_of_ball(sensor.intrinsics);
    frames.add(std::move(frame));
  }

  const auto scan = turnscan::reconstruct(frames, {{"calibration", "recorded"}});
  if (!scan) return std::fprintf(stderr, "%s\n", scan.error().text().c_str()), 1;
  const auto& check = scan->objects().front().check;
  const double ball_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
  std::printf("%s; %.3f of the ball's volume\n", check.text().c_str(), check.volume_m3 / ball_m3);
  // The images do not show the underside, which is closed flat on the platter.
  return check.watertight() && std::abs(check.volume_m3 / ball_m3 - 1.0) < 0.1 ? 0 : 1;
}
