#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/reconstruction/estimation/platter_rim.hpp>
#include <turnscan/turntable/crop/crop.hpp>

namespace turnscan::estimation {

namespace {

constexpr int kRimPlaces = 3;  ///< along and across the rim, per sector
constexpr int kMinLooks = 3;   ///< required observations of a sector
constexpr int kSectorsThatTell = 3;

}  // namespace

void PlatterRim::add(const Frame& frame, const SensorInfo& sensor, const Pose& T_table_sensor) {
  const Pose T_sensor_table = T_table_sensor.inverse();
  const auto& depth = frame.depth;
  for (std::size_t s = 0; s < kSectors; ++s) {
    for (int place = 0; place < kRimPlaces * kRimPlaces; ++place) {
      const double turn = (double(s) + (place % kRimPlaces + 0.5) / kRimPlaces) / double(kSectors);
      const double outwards = (place / kRimPlaces + 0.5) / kRimPlaces;
      const double r = radius_m_ * (kInnerShare + (1.0 - kInnerShare) * outwards);
      const Vec3d p(r * std::cos(kTurn * turn), 0.0, r * std::sin(kTurn * turn));
      const Vec3d p_sensor = T_sensor_table * p;
      if (p_sensor.z() <= 0.0) continue;
      const Eigen::Vector2d pixel = sensor.intrinsics.project(p_sensor);
      const double u = std::round(pixel.x()), v = std::round(pixel.y());
      if (!(u >= 0.0 && v >= 0.0 && u < depth.width && v < depth.height)) continue;
      const std::uint16_t raw =
          depth.pixels[std::size_t(v) * std::size_t(depth.width) + std::size_t(u)];
      const double z = raw * sensor.depth_unit_m + sensor.depth_bias_m;
      const double height = (T_table_sensor * Vec3d(p_sensor * (z / p_sensor.z()))).y();
      if (raw == kNoReturn || height < -PlatterReturns::kReach_m)
        ++looks_[s].past;
      else if (height < PlatterReturns::kReach_m)
        ++looks_[s].on;
    }
  }
}

double PlatterRim::share_seen() const {
  int tell = 0, seen = 0;
  for (const Looks& looks : looks_) {
    if (looks.on + looks.past < kMinLooks) continue;
    ++tell;
    seen += looks.on > looks.past ? 1 : 0;
  }
  return tell < kSectorsThatTell ? 0.0 : double(seen) / double(tell);
}

}  // namespace turnscan::estimation
