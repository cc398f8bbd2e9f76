#include "tests/reconstruction/texture/painted_ellipsoid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace turnscan::testing {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDistance = 0.3;

double linear(double srgb) { return std::pow(srgb / 255.0, 2.2); }
double srgb(double light) { return 255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / 2.2); }

CameraIntrinsics color_camera() {
  CameraIntrinsics camera;
  camera.width = 320, camera.height = 240;
  camera.fx = camera.fy = 500.0;
  camera.cx = 159.5, camera.cy = 119.5;
  return camera;
}

/// Looks at the middle from above, a little to the side of the axis.
Pose table_sensor(double angle) {
  Eigen::Matrix3d look;
  const double c = std::cos(0.35), s = std::sin(0.35);
  look.col(0) = Vec3d(-1.0, 0.0, 0.0);
  look.col(1) = Vec3d(0.0, -c, -s);
  look.col(2) = Vec3d(0.0, -s, c);
  Pose T = Pose::Identity();
  T.linear() = look;
  T.translation() = -kDistance * look.col(2);
  return rotation_about_y(-angle) * T;
}

}  // namespace

Vec3d ellipsoid_axes() { return {0.06, 0.045, 0.04}; }

TriangleMesh ellipsoid_mesh(int around) {
  TriangleMesh mesh;
  const int rings = around / 2;
  const Vec3d axes = ellipsoid_axes();
  const auto add = [&](double up, double side) {
    const Vec3d p(std::cos(up) * std::cos(side), std::sin(up), std::cos(up) * std::sin(side));
    mesh.vertices.push_back(p.cwiseProduct(axes).cast<float>());
  };
  add(-kPi / 2, 0.0);
  for (int r = 1; r < rings; ++r)
    for (int i = 0; i < around; ++i) add(kPi * (double(r) / rings - 0.5), 2.0 * kPi * i / around);
  add(kPi / 2, 0.0);
  const auto at = [&](int r, int i) { return std::uint32_t(1 + (r - 1) * around + i % around); };
  const auto top = std::uint32_t(mesh.vertices.size() - 1);
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    mesh.triangles.push_back({top, at(rings - 1, i + 1), at(rings - 1, i)});
    for (int r = 1; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
      mesh.triangles.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
    }
  }
  return mesh;
}

Vec3f pattern_at(const Vec3d& p) {
  const double a = std::sin(p.x() * 420.0 + 60.0 * p.y()), b = std::sin(p.y() * 380.0 + 1.0),
               c = std::sin(p.z() * 400.0 + 2.0 + 90.0 * p.x());
  return {float(128.0 + 60.0 * a + 20.0 * b), float(128.0 + 55.0 * b + 25.0 * c),
          float(128.0 + 50.0 * c - 30.0 * a)};
}

MemoryFrames ellipsoid_frames(const EllipsoidPictures& pictures) {
  SequenceHeader header;
  SensorInfo& sensor = header.sensors.emplace_back();
  sensor.intrinsics = color_camera();
  sensor.color_intrinsics = color_camera();
  sensor.T_color_sensor = pictures.given_T_color_sensor;
  sensor.T_table_sensor = table_sensor(0.0);
  std::vector<Frame> frames;
  const CameraIntrinsics camera = color_camera();
  const Vec3d axes = ellipsoid_axes();
  for (int f = 0; f < pictures.frames; ++f) {
    Frame& frame = frames.emplace_back();
    frame.info.index = std::uint32_t(f);
    frame.info.T_table_sensor = table_sensor(2.0 * kPi * f / pictures.frames);
    frame.depth = DepthImage(camera.width, camera.height, kNoReturn);
    frame.color = ColorImage(camera.width, camera.height, Rgb{10, 10, 10});
    const Pose T_table_sensor = rotation_about_y(-pictures.turned(f)) * *frame.info.T_table_sensor;
    const Pose T = T_table_sensor * pictures.T_color_sensor.inverse();
    const Vec3d eye = T.translation().cwiseQuotient(axes);
    const Vec3f gain = pictures.gain(f);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const Vec3d ray = T.linear() * camera.ray(x, y);
        const Vec3d d = ray.cwiseQuotient(axes);
        const double q = eye.dot(d), r = q * q - d.squaredNorm() * (eye.squaredNorm() - 1.0);
        if (r < 0.0) continue;
        const Vec3d p = T.translation() + (-q - std::sqrt(r)) / d.squaredNorm() * ray;
        const Vec3d normal = p.cwiseQuotient(axes.cwiseProduct(axes)).normalized();
        const Eigen::Matrix3d to_sensor = T_table_sensor.linear().transpose();
        const Vec3d to_eye = to_sensor * -ray.normalized();
        const auto shine = double(pictures.gloss(to_sensor * normal, to_eye));
        const auto mirrored = double(pictures.mirrored(to_sensor * normal, to_eye));
        const Vec3f color = pictures.pattern(p);
        const double lamp = double(pictures.lamp(to_sensor * normal, to_sensor * p));
        std::array<std::uint8_t, 3> bytes{};
        for (int c = 0; c < 3; ++c)
          bytes[std::size_t(c)] = std::uint8_t(std::clamp(
              srgb(double(gain[c]) * (lamp * linear(double(color[c])) + mirrored)) + shine + 0.5,
              0.0, 255.0));
        frame.color.at(x, y) = {bytes[0], bytes[1], bytes[2]};
      }
    }
  }
  return MemoryFrames(std::move(header), std::move(frames));
}

}  // namespace turnscan::testing
