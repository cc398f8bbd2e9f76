#include <algorithm>
#include <cmath>
#include <turnscan/recording/plausibility/finders.hpp>

namespace turnscan::plausibility {

namespace {

constexpr std::size_t kEachPixel = 3, kMinCommon = 100, kMinPairs = 3;
/// Differences of depth count up to this share of it: what one frame hides from the other says
/// nothing.
constexpr double kMostOff = 0.02;
/// Simulated scans of four objects (tests/e2e/narrow.toml, 24 frames, bench/wrong_data): mirrored
/// images fit their poses 1.44 to 1.64 times as badly as when they are turned round, others 0.60 to
/// 0.69 times.
constexpr double kWorse = 1.25;

/// Sums over the points of a that b sees, where T_b_a holds and where it holds for the images
/// turned round.
struct Fit {
  double as_is_m = 0.0, turned_m = 0.0;
};

double depth_m(const SensorInfo& sensor, const DepthImage& image, const Vec3d& p) {
  if (!(p.z() > 0.0)) return 0.0;
  const Eigen::Vector2d at = sensor.intrinsics.project(p);
  if (!(at.x() > -0.5 && at.y() > -0.5 && at.x() < image.width - 0.5 &&
        at.y() < image.height - 0.5))
    return 0.0;
  const std::uint16_t raw = image.at(int(std::lround(at.x())), int(std::lround(at.y())));
  return raw == kNoReturn || raw == kOutsideCrop ? 0.0 : raw * sensor.depth_unit_m;
}

/// Adds what both ways have in common. False if that is little.
bool add_pair(const SensorInfo& sensor, const RayTable& rays, const Frame& a, const Frame& b,
              Fit& sum) {
  const Pose T_b_a = b.info.T_table_sensor->inverse() * *a.info.T_table_sensor;
  const Eigen::Vector3d mirror(-1.0, 1.0, 1.0);
  Fit here;
  std::size_t common = 0;
  for (std::size_t i = 0; i < a.depth.pixels.size(); i += kEachPixel) {
    const std::uint16_t raw = a.depth.pixels[i];
    if (raw == kNoReturn || raw == kOutsideCrop) continue;
    const double z = raw * sensor.depth_unit_m;
    const Vec3d p(rays.x()[i] * z, rays.y()[i] * z, z);
    const Vec3d as_is = T_b_a * p;
    const Vec3d turned = mirror.asDiagonal() * (T_b_a * Vec3d(mirror.asDiagonal() * p));
    const double seen = depth_m(sensor, b.depth, as_is), other = depth_m(sensor, b.depth, turned);
    if (seen == 0.0 || other == 0.0) continue;
    here.as_is_m += std::min(std::abs(seen - as_is.z()), kMostOff * z);
    here.turned_m += std::min(std::abs(other - turned.z()), kMostOff * z);
    ++common;
  }
  if (common < kMinCommon) return false;
  sum.as_is_m += here.as_is_m / double(common);
  sum.turned_m += here.turned_m / double(common);
  return true;
}

}  // namespace

void look_at_handedness(std::size_t number, const SensorInfo& sensor,
                        const std::vector<Frame>& frames, Findings& out) {
  if (sensor.kind != SensorKind::kDepthCamera) return;
  const RayTable rays(sensor.intrinsics);
  Fit sum;
  std::size_t pairs = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const Frame &a = frames[i - 1], &b = frames[i];
    if (!a.info.T_table_sensor || !b.info.T_table_sensor || a.depth.width != b.depth.width ||
        a.depth.width != sensor.intrinsics.width || a.depth.height != sensor.intrinsics.height ||
        b.depth.height != a.depth.height)
      continue;
    pairs += add_pair(sensor, rays, a, b, sum) ? 1 : 0;
  }
  if (pairs < kMinPairs || !(sum.as_is_m > kWorse * sum.turned_m)) return;
  out.push_back(
      {Plausibility::kImplausible,
       fmt::format(
           "the images of sensor {} are mirrored, or its poses go round the wrong way: turned "
           "round from left to right the images agree better by a factor of {:.1f}; write "
           "them the right way round",
           number, sum.as_is_m / sum.turned_m),
       ""});
}

}  // namespace turnscan::plausibility
