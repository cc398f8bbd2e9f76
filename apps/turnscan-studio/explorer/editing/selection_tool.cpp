#include "explorer/editing/selection_tool.hpp"

#include <QPainter>
#include <QPainterPath>

namespace turnscan::studio {

namespace {

const QColor kAdding(0xe07b00), kSubtracting(0x1f6fd0);

}  // namespace

SelectionTool::SelectionTool(SceneView& view, Shape shape, Done done)
    : view_(view), shape_(shape), done_(std::move(done)) {}

void SelectionTool::set_radius(double pixels) { radius_px_ = pixels; }

bool SelectionTool::press(const QPointF& at, Qt::KeyboardModifiers keys) {
  if (keys.testFlag(Qt::AltModifier)) return false;  // rotates the camera
  how_ = keys.testFlag(Qt::ShiftModifier)     ? std::optional(SelectHow::kAdd)
         : keys.testFlag(Qt::ControlModifier) ? std::optional(SelectHow::kSubtract)
                                              : std::nullopt;
  path_ = {{at.x(), at.y()}};
  view_.update_overlay();
  return true;
}

void SelectionTool::drag(const QPointF& at, Qt::KeyboardModifiers /*keys*/) {
  if (shape_ == kRectangle) path_.resize(1);
  path_.emplace_back(at.x(), at.y());
  view_.update_overlay();
}

void SelectionTool::release(const QPointF& /*at*/) {
  const ScreenRegion made = region();
  path_.clear();
  view_.update_overlay();
  if (!made.points.empty()) done_(made, how_);
}

/// Empty if no area is enclosed, as for a click without movement.
ScreenRegion SelectionTool::region() const {
  if (path_.empty()) return {};
  if (shape_ == kBrush) return {path_, radius_px_};
  if (shape_ == kLasso) return path_.size() > 2 ? ScreenRegion{path_, 0.0} : ScreenRegion{};
  const Eigen::Vector2d a = path_.front(), b = path_.back();
  if ((a - b).cwiseAbs().minCoeff() < 1.0) return {};
  return {{a, {b.x(), a.y()}, b, {a.x(), b.y()}}, 0.0};
}

void SelectionTool::paint(QPainter& painter) {
  const ScreenRegion shown = region();
  if (shown.points.empty()) return;
  const QColor color = how_ == SelectHow::kSubtract ? kSubtracting : kAdding;
  QColor fill = color;
  fill.setAlpha(60);
  QPainterPath path(QPointF(shown.points[0].x(), shown.points[0].y()));
  for (const auto& p : shown.points) path.lineTo(p.x(), p.y());
  if (shape_ == kBrush) {
    fill.setAlpha(110);
    path.lineTo(path.currentPosition() + QPointF(0.01, 0.0));  // a single click is a dot
    painter.setPen(QPen(fill, 2.0 * radius_px_, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
    return;
  }
  path.closeSubpath();
  painter.setPen(QPen(color, 2));
  painter.setBrush(fill);
  painter.drawPath(path);
}

ScreenView screen_of(const SceneView& view) {
  return {view.to_pixels(), view.width(), view.height()};
}

}  // namespace turnscan::studio
