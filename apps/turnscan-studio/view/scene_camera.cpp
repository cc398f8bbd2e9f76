// The camera of the view: position, flights, and picking.

#include <vtkMatrix4x4.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/scene_view_parts.hpp"

namespace turnscan::studio {

void SceneView::Parts::fly(double share) {
  const Vec3d focus = (1 - share) * from_focus + share * to_focus;
  const Vec3d offset = (1 - share) * from_offset + share * to_offset;
  const double length = (1 - share) * from_offset.norm() + share * to_offset.norm();
  const Vec3d position = focus + length * offset.normalized();
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(up.data());
}

void SceneView::reset_camera() {
  Vec3d position, focus;
  parts_->camera->GetPosition(position.data());
  parts_->camera->GetFocalPoint(focus.data());
  const Box box = scene_box();
  if (box.empty()) return;
  const bool flying = parts_->flight.state() == QAbstractAnimation::Running;
  const Vec3d from = flying ? parts_->to_offset : Vec3d(position - focus);
  parts_->flight.stop();
  parts_->aim(box.center(), std::max(1e-4, box.size().norm()), from, size());
  parts_->fly(1.0);
  camera_moved();
}

void SceneView::fit_unless_moved() {
  if (!parts_->touched) reset_camera();
}

bool SceneView::sees(const Box& box) const {
  if (box.empty()) return true;
  QRectF seen;
  for (int i = 0; i < 8; ++i) {
    const auto at = project(Vec3d((i & 1) != 0 ? box.max.x() : box.min.x(),
                                  (i & 2) != 0 ? box.max.y() : box.min.y(),
                                  (i & 4) != 0 ? box.max.z() : box.min.z()));
    if (!at || !QRectF(rect()).contains(*at)) return false;
    seen = seen.united(QRectF(*at, QSizeF(1e-3, 1e-3)));
  }
  constexpr double kMinShare = 0.05;
  return std::max(seen.width(), seen.height()) > kMinShare * std::min(width(), height());
}

void SceneView::bring_into_view(const Box& box) {
  if (!sees(box)) fly_to(box.center(), box.size().norm(), Vec3d::Zero());
}

void SceneView::turn(double angle_rad) {
  Parts& p = *parts_;
  Vec3d position, focus;
  p.camera->GetPosition(position.data());
  p.camera->GetFocalPoint(focus.data());
  position = focus + Eigen::AngleAxisd(angle_rad, p.up.normalized()) * (position - focus);
  p.camera->SetPosition(position.data());
  p.camera->SetViewUp(p.up.data());
  request_render();
}

void SceneView::Parts::aim(const Vec3d& center, double size_m, const Vec3d& from,
                           const QSize& pixels) {
  Vec3d position, focus;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(focus.data());
  from_focus = focus;
  from_offset = position - focus;
  to_focus = center;
  Vec3d direction = from.isZero() ? from_offset : from;
  // Seen exactly from above or below, the up direction would be undefined.
  if (direction.normalized().cross(up).norm() < 0.02)
    direction += 0.03 * direction.norm() * (up.unitOrthogonal());
  const double aspect = double(pixels.width()) / (split ? 2.0 : 1.0) / std::max(1, pixels.height());
  const double narrow = std::min(1.0, aspect);
  const double distance =
      0.5 * size_m / std::sin(0.5 * kViewAngle * std::numbers::pi / 180.0) / narrow;
  to_offset = distance * direction.normalized();
}

void SceneView::look(StandardView from) {
  static const std::array<Vec3d, 7> directions{
      Vec3d(0, 0, 1), Vec3d(0, 0, -1), Vec3d(-1, 0, 0),     Vec3d(1, 0, 0),
      Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(0.55, 0.45, 1)};
  Vec3d direction = directions[static_cast<std::size_t>(from)];
  if (parts_->up.y() < 0.0) direction = Vec3d(direction.x(), -direction.y(), -direction.z());
  const Box box = scene_box();
  if (!box.empty()) fly_to(box.center(), box.size().norm(), direction);
}

void SceneView::fly_to(const Vec3d& center, double size_m, const Vec3d& from) {
  parts_->flight.stop();
  parts_->aim(center, std::max(1e-4, size_m), from, size());
  parts_->flight.start();
}

void SceneView::look_as_sensor(const Vec3d& target) {
  set_up(-Vec3d::UnitY());
  const Vec3d focus(0, 0, std::max(0.1, target.z()));
  parts_->camera->SetFocalPoint(focus.data());
  parts_->camera->SetPosition(0, 0, 0);
  parts_->touched = true;
  camera_moved();
}

void SceneView::orbit(double dx, double dy) {
  Parts& p = *parts_;
  Vec3d position, focus;
  p.camera->GetPosition(position.data());
  p.camera->GetFocalPoint(focus.data());
  const double scale = p.speed * std::numbers::pi / std::max(200, height());
  const Vec3d up = p.up.normalized();
  Vec3d offset = Eigen::AngleAxisd(-dx * scale, up) * (position - focus);
  const double elevation = std::asin(std::clamp(offset.normalized().dot(up), -1.0, 1.0));
  const double limit = 89.0 * std::numbers::pi / 180.0;
  const double turn = std::clamp(elevation + dy * scale, -limit, limit) - elevation;
  const Vec3d side = offset.cross(up);
  if (side.norm() > 1e-12) offset = Eigen::AngleAxisd(turn, side.normalized()) * offset;
  position = focus + offset;
  p.camera->SetPosition(position.data());
  p.camera->SetViewUp(up.data());
  camera_moved();
}

void SceneView::pan(double dx, double dy) {
  Parts& p = *parts_;
  Vec3d position, focus, up;
  p.camera->GetPosition(position.data());
  p.camera->GetFocalPoint(focus.data());
  const Vec3d forward = (focus - position).normalized();
  const Vec3d right = forward.cross(p.up).normalized();
  up = right.cross(forward);
  const Vec3d shift = p.speed * metres_per_pixel() * (-dx * right + dy * up);
  position += shift;
  focus += shift;
  p.camera->SetPosition(position.data());
  p.camera->SetFocalPoint(focus.data());
  camera_moved();
}

void SceneView::zoom(double factor) {
  Vec3d position, focus;
  parts_->camera->GetPosition(position.data());
  parts_->camera->GetFocalPoint(focus.data());
  const double distance = std::clamp((position - focus).norm() / factor, 1e-3, 1e3);
  position = focus + distance * (position - focus).normalized();
  parts_->camera->SetPosition(position.data());
  camera_moved();
}

CameraPlace SceneView::camera() const {
  CameraPlace place;
  parts_->camera->GetPosition(place.position.data());
  parts_->camera->GetFocalPoint(place.focus.data());
  parts_->camera->GetViewUp(place.up.data());
  return place;
}

void SceneView::set_camera(const CameraPlace& place) {
  parts_->flight.stop();
  parts_->camera->SetPosition(place.position.data());
  parts_->camera->SetFocalPoint(place.focus.data());
  parts_->camera->SetViewUp(place.up.data());
  parts_->touched = true;
  camera_moved();
}

void SceneView::camera_moved() {
  Q_EMIT camera_changed();
  parts_->moving = true;
  parts_->rest.start(kRestAfterMs);
  parts_->more.stop();
  if (!parts_->render.isActive()) parts_->render.start(0);
}

void SceneView::set_clipping_range() {
  Box box = scene_box();
  for (const auto& [id, item] : parts_->items) {
    if (!item.style.visible || !item.drawable || item.drawable->box.empty()) continue;
    box.add(item.drawable->box.min);
    box.add(item.drawable->box.max);
  }
  if (box.empty()) return;
  Vec3d position, focus;
  parts_->camera->GetPosition(position.data());
  parts_->camera->GetFocalPoint(focus.data());
  const Vec3d forward = (focus - position).normalized();
  const double middle = forward.dot(box.center() - position), reach = 0.5 * box.size().norm();
  const double far = std::max(middle + 1.05 * reach, 1e-3);
  parts_->camera->SetClippingRange(std::max(middle - 1.05 * reach, 2e-3 * far), far);
}

Eigen::Matrix4d SceneView::to_pixels() const {
  const Parts& p = *parts_;
  const double w = width() / (p.split ? 2.0 : 1.0), h = height();
  vtkMatrix4x4* m = p.camera->GetCompositeProjectionTransformMatrix(w / h, -1, 1);
  Eigen::Matrix4d clip;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) clip(r, c) = m->GetElement(r, c);
  Eigen::Matrix4d pixels = Eigen::Matrix4d::Identity();
  pixels(0, 0) = 0.5 * w;
  pixels(0, 3) = 0.5 * w;
  pixels(1, 1) = -0.5 * h;
  pixels(1, 3) = 0.5 * h;
  return pixels * clip;
}

std::optional<QPointF> SceneView::project(const Vec3d& p) const {
  const Eigen::Vector4d q = to_pixels() * p.homogeneous();
  if (q.w() <= 1e-9) return std::nullopt;
  return QPointF(q.x() / q.w(), q.y() / q.w());
}

std::pair<Vec3d, Vec3d> SceneView::sight(const QPointF& at) const {
  Vec3d position;
  parts_->camera->GetPosition(position.data());
  double x = at.x();
  if (parts_->split && x > 0.5 * width()) x -= 0.5 * width();
  const Eigen::Matrix4d back = to_pixels().inverse();
  const Eigen::Vector4d far = back * Eigen::Vector4d(x, at.y(), 0.9, 1.0);
  const Vec3d direction = (far.head<3>() / far.w() - position).normalized();
  return {position, direction};
}

std::optional<Vec3d> SceneView::pick(const QPointF& at) {
  Parts& p = *parts_;
  if (!p.canvas->isValid()) return std::nullopt;
  const double ratio = devicePixelRatioF();
  const int x = int(at.x() * ratio), y = int((height() - 1 - at.y()) * ratio);
  // There is background between the points of a cloud: the nearest point within reach counts.
  constexpr int kReach = 8;
  constexpr int kSide = 2 * kReach + 1;
  if (x < kReach || y < kReach) return std::nullopt;
  std::array<float, std::size_t(kSide) * kSide> depths;
  depths.fill(1.0f);
  p.window->GetZbufferData(x - kReach, y - kReach, x + kReach, y + kReach, depths.data());
  float depth = 1.0f;
  int best = kReach * kReach + 1;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int dx = i % kSide - kReach, dy = i / kSide - kReach, away = dx * dx + dy * dy;
    if (away >= best || depths[std::size_t(i)] >= 1.0f) continue;
    best = away;
    depth = depths[std::size_t(i)];
  }
  if (depth >= 1.0f) return std::nullopt;
  double column = at.x();
  if (p.split && column > 0.5 * width()) column -= 0.5 * width();
  const Eigen::Vector4d q =
      to_pixels().inverse() * Eigen::Vector4d(column + 0.0, at.y(), 2.0 * depth - 1.0, 1.0);
  return Vec3d(q.head<3>() / q.w());
}

double SceneView::metres_per_pixel() const {
  const double distance = parts_->camera->GetDistance();
  return 2.0 * distance * std::tan(0.5 * kViewAngle * std::numbers::pi / 180.0) /
         std::max(1, height());
}

}  // namespace turnscan::studio
