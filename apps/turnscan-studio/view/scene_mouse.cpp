// Mouse and keyboard input of the view.

#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/scene_view_parts.hpp"

namespace turnscan::studio {

bool VtkCanvas::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::Wheel:
      if (view_->on_mouse(event)) return true;
      break;
    case QEvent::Enter:
    case QEvent::Leave:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
      return QOpenGLWidget::event(event);
    default:
      break;
  }
  return QVTKOpenGLNativeWidget::event(event);
}

/// Shown to those who came by the keyboard; others have seen where they clicked.
void SceneView::focusInEvent(QFocusEvent* event) {
  focus_shown_ = event->reason() != Qt::MouseFocusReason && event->reason() != Qt::OtherFocusReason;
  update_overlay();
}

void SceneView::focusOutEvent(QFocusEvent* /*event*/) {
  focus_shown_ = false;
  update_overlay();
}

bool SceneView::on_mouse(QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
      on_press(static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseMove:
      on_drag(static_cast<QMouseEvent*>(event));
      return true;
    case QEvent::MouseButtonRelease:
      if (parts_->tool_active && tool_)
        tool_->release(static_cast<QMouseEvent*>(event)->localPos());
      parts_->tool_active = false;
      return true;
    case QEvent::Wheel:
      on_wheel(static_cast<QWheelEvent*>(event));
      return true;
    default:
      return false;
  }
}

void SceneView::on_press(QMouseEvent* event) {
  setFocus();
  parts_->touched = true;
  parts_->flight.stop();
  parts_->last_mouse = event->localPos();
  if (tool_ && event->button() == Qt::LeftButton)
    parts_->tool_active = tool_->press(event->localPos(), event->modifiers());
}

void SceneView::on_drag(QMouseEvent* event) {
  const QPointF d = event->localPos() - parts_->last_mouse;
  parts_->last_mouse = event->localPos();
  const Qt::MouseButtons buttons = event->buttons();
  if (buttons == Qt::NoButton) return;
  if (parts_->tool_active && tool_) {
    tool_->drag(event->localPos(), event->modifiers());
    return;
  }
  const bool shift = event->modifiers().testFlag(Qt::ShiftModifier);
  if (buttons.testFlag(Qt::MiddleButton) || (buttons.testFlag(Qt::LeftButton) && shift)) {
    pan(d.x(), d.y());
  } else if (buttons.testFlag(Qt::LeftButton)) {
    orbit(d.x(), d.y());
  } else if (buttons.testFlag(Qt::RightButton)) {
    zoom(std::exp(-0.005 * parts_->speed * d.y()));
  }
}

void SceneView::on_wheel(QWheelEvent* event) {
  parts_->touched = true;
  zoom(std::exp(0.0012 * parts_->speed * event->angleDelta().y()));
}

void SceneView::keyPressEvent(QKeyEvent* event) {
  const double step = 15.0;
  switch (event->key()) {
    case Qt::Key_Left:
      return orbit(-step, 0);
    case Qt::Key_Right:
      return orbit(step, 0);
    case Qt::Key_Up:
      return orbit(0, -step);
    case Qt::Key_Down:
      return orbit(0, step);
    case Qt::Key_Plus:
      return zoom(1.1);
    case Qt::Key_Minus:
      return zoom(1.0 / 1.1);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace turnscan::studio
