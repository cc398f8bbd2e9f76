#include <Eigen/Geometry>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/clouds/cloud_convention.hpp>

namespace turnscan::motion {

namespace {

/// What is level to within 15 degrees, and the share of the samples from which on it counts: less
/// may be folds and chins.
const double kLevel = std::cos(15.0 * kRadiansPerDegree);
constexpr double kMinLevelShare = 0.05;
/// A sensor lower than this may look at a tall object from below its middle.
const double kClearlyAbove = std::sin(5.0 * kRadiansPerDegree);

const double kMostlyUp = std::sqrt(0.5);

/// Whether p lies in the box of the clouds.
bool is_among(const MotionData& data, const Vec3d& p) {
  Eigen::AlignedBox3d box;
  for (const Vec3f& q : data.cloud) box.extend(q.cast<double>());
  return box.contains(p);
}

/// Most normals of what a scanner sees point along its viewing direction, one way or the other;
/// that way on which surfaces lie outside of the middle.
Vec3d where_surfaces_bulge(const MotionData& data) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const MotionFrame& frame : data.frames)
    for (const SurfaceSample& sample : frame.samples)
      spread += sample.n.cast<double>() * sample.n.cast<double>().transpose();
  const Vec3d view = estimation::symmetric_eigen(spread).vectors.col(2);
  double outside = 0.0;
  for (const MotionFrame& frame : data.frames) {
    for (const SurfaceSample& sample : frame.samples) {
      const Vec3d n = sample.n.cast<double>();
      outside += std::copysign(1.0, n.dot(view)) * n.dot(sample.p.cast<double>() - data.middle);
    }
  }
  return outside < 0.0 ? Vec3d(-view) : view;
}

}  // namespace

double upward(const MotionData& data, const Viewpoint& viewpoint, const Vec3d& axis) {
  const bool known = viewpoint.parallel || !is_among(data, viewpoint.value);
  const Vec3d view = known ? data.to_sensor : where_surfaces_bulge(data);
  double above = 0.0, below = 0.0, count = 0.0;
  for (const MotionFrame& frame : data.frames) {
    count += double(frame.samples.size());
    for (const SurfaceSample& sample : frame.samples) {
      const Vec3d n = sample.n.cast<double>();
      const double facing = known || n.dot(view) > 0.0 ? n.dot(axis) : -n.dot(axis);
      above += facing > kLevel ? 1.0 : 0.0;
      below += facing < -kLevel ? 1.0 : 0.0;
    }
  }
  if (std::abs(above - below) > kMinLevelShare * count) return above > below ? 1.0 : -1.0;
  const double elevation = view.dot(axis);
  if (std::abs(elevation) > kClearlyAbove) return elevation > 0.0 ? 1.0 : -1.0;
  return 0.0;
}

std::string convention_text(const Vec3d& axis, const Vec3d& to_sensor) {
  int most = 0;
  axis.cwiseAbs().maxCoeff(&most);
  const bool down = axis[most] < 0.0;
  std::string text = std::string("the clouds are ") + "xyz"[most] + (down ? " down" : " up");
  if (most == 1 && down) text += ", as PCL, Open3D and ROS write them";
  if (most == 1 && !down && to_sensor.z() > 0.0) text += ", as OpenGL writes them";
  return text;
}

Result<> check_handedness(const SensorInfo& sensor, const Vec3d& axis, const Vec3d& middle,
                          double reach_m) {
  const bool in_sensor_frame = !sensor.viewpoint.parallel && sensor.viewpoint.value.isZero();
  if (sensor.kind == SensorKind::kDepthCamera || !in_sensor_frame) return {};
  const auto ask = [](const char* seen, const char* right_handed, const char* left_handed) {
    return fail(ErrorCode::kInvalidOption,
                "the clouds are {}, which programs write right-handed ({}) and left-handed ({}); "
                "both fit, one as a mirror image with angles of the opposite sign: say which when "
                "importing, --axes {:.3} or --axes {:.3}",
                seen, right_handed, left_handed, right_handed, left_handed);
  };
  const Vec3d up = axis.normalized();
  if (up.y() > kMostlyUp && middle.z() > reach_m)
    return ask("y up and z forward", "luf: Kinect's SDK", "ruf: Unity");
  if (up.z() > kMostlyUp && middle.x() > reach_m && middle.x() > std::abs(middle.y()))
    return ask("z up and x forward", "flu: ROS", "fru: Unreal");
  return {};
}

}  // namespace turnscan::motion
