#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/texture/lamp_view.hpp>

namespace turnscan::texture {

namespace {

constexpr double kFarAway = 200.0;  // distance of the camera, in radii of the object
constexpr int kMaxMap_px = 2048;

/// A camera so distant that the directions to all of the object agree to a third of a degree.
ColorView lamp_camera(const TriangleMesh& mesh, const Vec3f& to_lamp, double pixel_m) {
  const auto box = bounds(mesh.vertices);
  const double radius = std::max(0.5 * box.size().norm(), 1e-6);
  const double distance = kFarAway * radius;
  const double wanted = std::ceil(2.1 * radius / pixel_m);
  const int size = int(std::clamp(wanted, 16.0, double(kMaxMap_px)));
  ColorView view;
  CameraIntrinsics camera;
  camera.width = camera.height = size;
  camera.fx = camera.fy = double(size) / (2.1 * radius) * distance;
  camera.cx = camera.cy = 0.5 * (size - 1);
  view.set_camera(camera);
  const Vec3d forward = -to_lamp.cast<double>();
  const Vec3d right = forward.unitOrthogonal();
  Eigen::Matrix3d rows;
  rows << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  view.T_sensor_object.linear() = rows;
  view.T_sensor_object.translation() = -(rows * box.center()) + distance * Vec3d::UnitZ();
  view.set_pose(Pose::Identity());
  return view;
}

}  // namespace

LampView::LampView(const TriangleMesh& mesh, const Vec3f& to_lamp, double pixel_m)
    : to_lamp_(to_lamp), view_(lamp_camera(mesh, to_lamp, pixel_m)) {
  drawn_.emplace(view_, mesh);
}

Lit LampView::lit(const Vec3f& p, const Vec3f& normal) const {
  if (!(normal.dot(to_lamp_) > 0.0f)) return Lit::kNo;
  const Projection at = view_.project(p);
  switch (drawn_->shows(at)) {
    case Shown::kWell:
      return Lit::kYes;
    case Shown::kNearRim:
      return Lit::kUnsure;
    case Shown::kNot:
      break;
  }
  return drawn_->near_rim(at) ? Lit::kUnsure : Lit::kNo;
}

}  // namespace turnscan::texture
