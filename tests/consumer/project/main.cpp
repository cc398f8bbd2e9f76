// A scan made in memory goes through the installed library: a ball of 40 mm radius, seen from six
// sides by a scanner whose points are exact.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/reconstruction/pipeline.hpp>

namespace {

constexpr double kRadius = 0.04;
constexpr double kDistance = 0.5;

/// Sensor frame: z forward, the ball's centre at kDistance on the axis.
turnscan::PointCloud half_ball() {
  turnscan::PointCloud cloud;
  for (int i = 0; i < 5000; ++i) {
    // Fibonacci spiral over the half that faces the sensor.
    const double z = (i + 0.5) / 5000.0, r = std::sqrt(1.0 - z * z), a = 2.399963 * i;
    cloud.points.emplace_back(kRadius * r * std::cos(a), kRadius * r * std::sin(a),
                              kDistance - kRadius * z);
  }
  return cloud;
}

class Scan : public turnscan::FrameSequence {
 public:
  Scan() {
    using turnscan::Pose;
    header_.sensors.resize(1);
    header_.sensors[0].kind = turnscan::SensorKind::kPointScanner;
    const double pi = std::numbers::pi;
    const Pose around[] = {turnscan::rotation_about_y(0.0),
                           turnscan::rotation_about_y(0.5 * pi),
                           turnscan::rotation_about_y(pi),
                           turnscan::rotation_about_y(1.5 * pi),
                           Pose(Eigen::AngleAxisd(0.5 * pi, Eigen::Vector3d::UnitX())),
                           Pose(Eigen::AngleAxisd(-0.5 * pi, Eigen::Vector3d::UnitX()))};
    for (const Pose& turn : around) {
      turnscan::FrameInfo info;
      info.index = static_cast<std::uint32_t>(infos_.size());
      info.T_table_sensor = turn * Eigen::Translation3d(0.0, 0.0, -kDistance);
      infos_.push_back(info);
    }
  }
  const turnscan::SequenceHeader& header() const override { return header_; }
  const std::vector<turnscan::FrameInfo>& frames() const override { return infos_; }
  turnscan::Result<turnscan::Frame> read(std::size_t position) const override {
    turnscan::Frame frame;
    frame.info = infos_[position];
    frame.points = half_ball();
    return frame;
  }

 private:
  turnscan::SequenceHeader header_;
  std::vector<turnscan::FrameInfo> infos_;
};

}  // namespace

int main() {
  const auto result = turnscan::reconstruct(Scan(), turnscan::ReconstructOptions(),
                                            turnscan::StageSink(), turnscan::RunContext());
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().text().c_str());
    return 1;
  }
  const auto& object = result->objects.front();
  const double ball_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
  std::printf("turnscan %s: %zu triangles, watertight: %s, volume %.4f of the ball's\n",
              turnscan::version(), object.mesh.triangles.size(),
              object.check.watertight() ? "yes" : "no", object.check.volume_m3 / ball_m3);
  const bool good = result->objects.size() == 1 && object.check.watertight() &&
                    std::abs(object.check.volume_m3 / ball_m3 - 1.0) < 0.05;
  return good ? 0 : 1;
}
