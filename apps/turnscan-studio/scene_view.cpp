#include "scene_view.hpp"

#include <QVTKOpenGLNativeWidget.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>

#include <QElapsedTimer>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTimer>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "drawable_parts.hpp"
#include "scene_view_parts.hpp"
#include "theme.hpp"

namespace turnscan::studio {

namespace {

constexpr double kViewAngle = 30.0;            // degrees, vertical
constexpr std::size_t kMovingPoints = 200000;  // drawn at most while the camera moves
constexpr double kFrameGoalMs = 45.0;
constexpr int kRestAfterMs = 180;

}  // namespace

/// The OpenGL surface; the mouse belongs to the view.
class VtkCanvas : public QVTKOpenGLNativeWidget {
 public:
  explicit VtkCanvas(SceneView* view) : QVTKOpenGLNativeWidget(view), view_(view) {}

 protected:
  bool event(QEvent* event) override {
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

 private:
  SceneView* view_;
};

/// Scale bar, legend, hints and what tools paint, above the canvas.
class ViewOverlay : public QWidget {
 public:
  explicit ViewOverlay(SceneView* view) : QWidget(view), view_(view) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
  }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    view_->paint_overlay(painter);
  }

 private:
  SceneView* view_;
};

SceneView::SceneView(QWidget* parent) : QWidget(parent), parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.canvas = new VtkCanvas(this);
  p.canvas->setMouseTracking(true);
  p.overlay = new ViewOverlay(this);
  p.window->SetMultiSamples(0);
  p.canvas->setRenderWindow(p.window);
  for (auto& renderer : p.renderers) {
    renderer->SetActiveCamera(p.camera);
    renderer->GradientBackgroundOn();
  }
  p.window->AddRenderer(p.renderers[0]);
  p.camera->SetViewAngle(kViewAngle);
  p.camera->SetPosition(0.4, 0.3, 0.9);
  p.camera->SetFocalPoint(0, 0.05, 0);
  p.render.setSingleShot(true);
  p.rest.setSingleShot(true);
  p.more.setSingleShot(true);
  connect(&p.render, &QTimer::timeout, this, &SceneView::render_now);
  connect(&p.rest, &QTimer::timeout, this, [this] {
    parts_->moving = false;
    draw_coarse();
  });
  connect(&p.more, &QTimer::timeout, this, &SceneView::draw_rest);
  connect(&p.flight, &QVariantAnimation::valueChanged, this, [this](const QVariant& value) {
    parts_->fly(value.toDouble());
    camera_moved();
  });
  p.flight.setDuration(350);
  p.flight.setStartValue(0.0);
  p.flight.setEndValue(1.0);
  p.flight.setEasingCurve(QEasingCurve::InOutQuad);
  setMinimumSize(320, 240);
  setFocusPolicy(Qt::StrongFocus);
  set_theme(light_theme());
}

SceneView::~SceneView() = default;

void SceneView::Parts::fly(double share) {
  const Vec3d focus = (1 - share) * from_focus + share * to_focus;
  const Vec3d offset = (1 - share) * from_offset + share * to_offset;
  const double length = (1 - share) * from_offset.norm() + share * to_offset.norm();
  const Vec3d position = focus + length * offset.normalized();
  camera->SetFocalPoint(focus.data());
  camera->SetPosition(position.data());
  camera->SetViewUp(up.data());
}

int SceneView::add(DrawablePtr drawable, const ItemStyle& style) {
  Parts& p = *parts_;
  const int id = p.next_item++;
  p.items[id].style = style;
  const bool first = scene_box().empty();
  replace(id, std::move(drawable));
  if (first && style.in_view) reset_camera();
  return id;
}

void SceneView::replace(int id, DrawablePtr drawable) {
  const auto found = parts_->items.find(id);
  if (found == parts_->items.end()) return;
  Item& item = found->second;
  parts_->drop(item);
  item.drawable = std::move(drawable);
  const auto actor_of = [&](vtkPolyData* geometry) {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(geometry);
    mapper->StaticOn();
    if (parts_->clip_planes->GetNumberOfItems() > 0 && item.style.boxed)
      mapper->SetClippingPlanes(parts_->clip_planes);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    return actor;
  };
  for (const auto& chunk : item.drawable->chunks) item.actors.push_back(actor_of(chunk));
  if (item.drawable->coarse) item.coarse = actor_of(item.drawable->coarse);
  apply_style(item);
  request_render();
}

void SceneView::set_style(int id, const ItemStyle& style) {
  const auto found = parts_->items.find(id);
  if (found == parts_->items.end()) return;
  found->second.style = style;
  apply_style(found->second);
  request_render();
}

void SceneView::remove(int id) {
  const auto found = parts_->items.find(id);
  if (found == parts_->items.end()) return;
  parts_->drop(found->second);
  parts_->items.erase(found);
  request_render();
}

void SceneView::apply_style(Item& item) {
  Parts& p = *parts_;
  const ItemStyle& style = item.style;
  const Drawable& drawable = *item.drawable;
  std::vector<vtkActor*> actors(item.actors.begin(), item.actors.end());
  if (item.coarse) actors.push_back(item.coarse);
  for (vtkActor* actor : actors) {
    vtkProperty* property = actor->GetProperty();
    property->SetColor(style.color.redF(), style.color.greenF(), style.color.blueF());
    property->SetPointSize(float(p.point_size * style.point_scale * devicePixelRatioF()));
    property->SetLineWidth(float(style.line_width * devicePixelRatioF()));
    property->SetLighting(style.lit && drawable.kind == DrawableKind::kMesh);
    property->SetInterpolationToPhong();
    property->SetAmbient(0.12);
    property->SetDiffuse(0.85);
    property->SetSpecular(0.12);
    property->SetSpecularPower(20.0);
    actor->GetMapper()->SetScalarVisibility(style.own_colors && drawable.colored);
    const int pane = p.split && style.pane == 1 ? 1 : 0;
    p.renderers[1 - pane]->RemoveActor(actor);
    if (!p.renderers[pane]->HasViewProp(actor)) p.renderers[pane]->AddActor(actor);
  }
  update_box(item);
}

void SceneView::update_box(Item& item) {
  Parts& p = *parts_;
  for (auto& renderer : p.renderers)
    if (item.box) renderer->RemoveActor(item.box);
  item.box = nullptr;
  if (!p.boxes || !item.style.visible || !item.style.boxed || item.drawable->box.empty()) return;
  const DrawablePtr lines = make_drawable(box_segments(item.drawable->box));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(lines->chunks.front());
  item.box = vtkSmartPointer<vtkActor>::New();
  item.box->SetMapper(mapper);
  item.box->GetProperty()->SetColor(p.theme->accent.redF(), p.theme->accent.greenF(),
                                    p.theme->accent.blueF());
  item.box->GetProperty()->SetLineWidth(float(1.2 * devicePixelRatioF()));
  item.box->GetProperty()->LightingOff();
  p.renderers[p.split && item.style.pane == 1 ? 1 : 0]->AddActor(item.box);
}

void SceneView::set_theme(const Theme& theme) {
  parts_->theme = &theme;
  for (auto& renderer : parts_->renderers) {
    renderer->SetBackground(theme.view_bottom.redF(), theme.view_bottom.greenF(),
                            theme.view_bottom.blueF());
    renderer->SetBackground2(theme.view_top.redF(), theme.view_top.greenF(),
                             theme.view_top.blueF());
  }
  for (auto& [id, item] : parts_->items) update_box(item);
  request_render();
}

void SceneView::set_point_size(double pixels) {
  parts_->point_size = pixels;
  for (auto& [id, item] : parts_->items) apply_style(item);
  request_render();
}

void SceneView::set_camera_speed(double factor) { parts_->speed = factor; }

void SceneView::set_boxes(bool on) {
  parts_->boxes = on;
  for (auto& [id, item] : parts_->items) update_box(item);
  request_render();
}

void SceneView::set_split(bool on, const QString& left, const QString& right) {
  Parts& p = *parts_;
  p.pane_titles = {left, right};
  if (on != p.split) {
    p.split = on;
    if (on) {
      p.window->AddRenderer(p.renderers[1]);
      p.renderers[0]->SetViewport(0, 0, 0.5, 1);
      p.renderers[1]->SetViewport(0.5, 0, 1, 1);
    } else {
      p.window->RemoveRenderer(p.renderers[1]);
      p.renderers[0]->SetViewport(0, 0, 1, 1);
    }
    for (auto& [id, item] : p.items) apply_style(item);
  }
  request_render();
}

void SceneView::set_legend(const Legend& legend) {
  parts_->legend = legend;
  update_overlay();
}

void SceneView::set_empty_text(const QString& title, const QString& text) {
  parts_->empty_title = title;
  parts_->empty_text = text;
  update_overlay();
}

void SceneView::set_hint(const QString& text) {
  parts_->hint = text;
  update_overlay();
}

void SceneView::set_tool(ViewTool* tool) {
  tool_ = tool;
  parts_->tool_active = false;
  if (tool) {
    parts_->canvas->setCursor(tool->cursor());
  } else {
    parts_->canvas->unsetCursor();
  }
  update_overlay();
}

void SceneView::set_up(const Vec3d& up) {
  parts_->up = up;
  parts_->camera->SetViewUp(up.data());
}

void SceneView::set_clip(const Vec3d& normal, double offset) {
  Parts& p = *parts_;
  p.clip_planes->RemoveAllItems();
  if (!normal.isZero()) {
    vtkNew<vtkPlane> plane;
    const Vec3d origin = offset * normal / normal.squaredNorm();
    plane->SetNormal(normal.data());
    plane->SetOrigin(origin.data());
    p.clip_planes->AddItem(plane);
  }
  for (auto& [id, item] : p.items) {
    if (!item.style.boxed) continue;
    for (const auto& actor : item.actors) actor->GetMapper()->SetClippingPlanes(p.clip_planes);
    if (item.coarse) item.coarse->GetMapper()->SetClippingPlanes(p.clip_planes);
  }
  request_render();
}

Box SceneView::scene_box() const {
  Box box;
  for (const auto& [id, item] : parts_->items) {
    if (!item.style.visible || !item.style.in_view || !item.drawable) continue;
    if (item.drawable->box.empty()) continue;
    box.add(item.drawable->box.min);
    box.add(item.drawable->box.max);
  }
  return box;
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

void SceneView::Parts::aim(const Vec3d& center, double size_m, const Vec3d& from,
                           const QSize& pixels) {
  Vec3d position, focus;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(focus.data());
  from_focus = focus;
  from_offset = position - focus;
  to_focus = center;
  Vec3d direction = from.isZero() ? from_offset : from;
  // Straight from above or below there would be no way up.
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

void SceneView::camera_moved() {
  parts_->moving = true;
  parts_->rest.start(kRestAfterMs);
  parts_->more.stop();
  if (!parts_->render.isActive()) parts_->render.start(0);
}

void SceneView::request_render() {
  parts_->more.stop();
  parts_->complete = false;
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

void SceneView::render_now() {
  if (!isVisible()) return;
  draw_coarse();
}

/// One frame of everything but the points beyond the budget. They follow, piece by piece, when the
/// camera rests.
void SceneView::draw_coarse() {
  Parts& p = *parts_;
  if (!isVisible() || !p.canvas->isValid()) return;
  p.show_first(p.moving);
  set_clipping_range();
  for (auto& renderer : p.renderers) {
    renderer->PreserveColorBufferOff();
    renderer->PreserveDepthBufferOff();
    renderer->SetUseFXAA(!p.moving && p.pending.empty());
  }
  QElapsedTimer clock;
  clock.start();
  p.window->Render();
  const double ms = 1e-6 * double(clock.nsecsElapsed());
  p.complete = !p.moving && p.pending.empty();
  if (p.moving) {
    p.longest_ms = std::max(p.longest_ms, ms);
    // A slow renderer gets fewer points the next time.
    const double wanted = double(p.budget) * std::clamp(kFrameGoalMs / std::max(ms, 1.0), 0.5, 1.3);
    p.budget = std::clamp<std::size_t>(std::size_t(wanted), 20000, kMovingPoints);
  } else if (!p.pending.empty()) {
    p.more.start(0);
  }
  update_overlay();
}

void SceneView::Parts::show_first(bool moving_now) {
  std::size_t all = 0;
  for (auto& [id, item] : items)
    if (item.style.visible && item.drawable->kind == DrawableKind::kCloud)
      all += item.drawable->points;
  const double share = all > budget ? double(budget) / double(all) : 1.0;
  pending.clear();
  points_drawn = 0;
  for (auto& [id, item] : items) {
    const bool cloud = item.drawable->kind == DrawableKind::kCloud;
    const std::size_t n = item.actors.size();
    const std::size_t first =
        cloud ? std::min(n, std::max<std::size_t>(1, std::size_t(share * double(n)))) : n;
    const bool coarse = item.coarse && moving_now;
    for (std::size_t i = 0; i < n; ++i) {
      item.actors[i]->SetVisibility(item.style.visible && i < first && !coarse);
      if (item.style.visible && i >= first) pending.push_back(item.actors[i]);
    }
    if (item.coarse) item.coarse->SetVisibility(item.style.visible && coarse);
    if (item.style.visible && cloud)
      points_drawn += std::min(item.drawable->points, first * kChunkPoints);
  }
}

/// Adds some of the pending points to the picture that is there.
void SceneView::draw_rest() {
  Parts& p = *parts_;
  if (p.moving || p.pending.empty() || !isVisible()) return;
  for (auto& [id, item] : p.items) {
    for (const auto& actor : item.actors) actor->VisibilityOff();
    if (item.coarse) item.coarse->VisibilityOff();
  }
  const std::size_t count = std::min(p.pending.size(), p.chunks_a_frame);
  for (std::size_t i = 0; i < count; ++i) p.pending[p.pending.size() - 1 - i]->VisibilityOn();
  p.pending.resize(p.pending.size() - count);
  for (auto& renderer : p.renderers) {
    renderer->PreserveColorBufferOn();
    renderer->PreserveDepthBufferOn();
    renderer->UseFXAAOff();
  }
  QElapsedTimer clock;
  clock.start();
  p.window->Render();
  const double ms = 1e-6 * double(clock.nsecsElapsed());
  if (ms < 0.5 * kFrameGoalMs) p.chunks_a_frame = std::min<std::size_t>(p.chunks_a_frame + 1, 8);
  if (ms > kFrameGoalMs) p.chunks_a_frame = std::max<std::size_t>(p.chunks_a_frame / 2, 1);
  p.complete = p.pending.empty();
  if (!p.complete) p.more.start(0);
}

bool SceneView::settled() const {
  return parts_->complete && !parts_->render.isActive() && !parts_->rest.isActive() &&
         parts_->flight.state() != QAbstractAnimation::Running;
}

std::size_t SceneView::points_while_moving() const { return parts_->points_drawn; }

double SceneView::longest_frame_ms() const { return parts_->longest_ms; }

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
  // Between the points of a cloud there is background: the nearest within reach counts.
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

QImage SceneView::screenshot() {
  draw_coarse();
  while (!parts_->pending.empty() && !parts_->moving) draw_rest();
  return grab().toImage();
}

void SceneView::update_overlay() { parts_->overlay->update(); }

void SceneView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  parts_->canvas->setGeometry(rect());
  parts_->overlay->setGeometry(rect());
  parts_->overlay->raise();
  // Until somebody moves the camera, everything stays in view.
  if (!parts_->touched) reset_camera();
  request_render();
}

Segments box_segments(const Box& box) {
  Segments lines;
  const auto corner = [&](int i) {
    return Vec3d((i & 1) != 0 ? box.max.x() : box.min.x(), (i & 2) != 0 ? box.max.y() : box.min.y(),
                 (i & 4) != 0 ? box.max.z() : box.min.z());
  };
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if ((i & bit) == 0) lines.add(corner(i), corner(i | bit));
  return lines;
}

}  // namespace turnscan::studio
