#include "view/scene_view.hpp"

#include <vtkMapper.h>
#include <vtkPlane.h>
#include <vtkRendererCollection.h>

#include <QHBoxLayout>
#include <QPushButton>
#include <algorithm>

#include "view/scene_view_parts.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

/// Scale bar, legend, hints and what tools paint, over the canvas.
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
  p.canvas->setFocusPolicy(Qt::NoFocus);  // the view takes the keys
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

void SceneView::set_live(bool live) {
  if (live == parts_->live) return;
  parts_->live = live;
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

void SceneView::set_empty_actions(const std::vector<Action>& actions) {
  if (parts_->empty_actions) {
    parts_->empty_actions->hide();
    parts_->empty_actions->deleteLater();  // one of them may have been clicked
  }
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setSpacing(10);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    auto* made =
        i == 0 ? primary_button(actions[i].text, {}, row) : button(actions[i].text, {}, row);
    if (i > 0) made->setObjectName("secondary");
    connect(made, &QPushButton::clicked, this, actions[i].run);
    layout->addWidget(made);
  }
  parts_->empty_actions = row;
  place_actions();
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

void SceneView::set_marks(std::function<void(QPainter&)> paint) {
  parts_->marks = std::move(paint);
  update_overlay();
}

void SceneView::set_up(const Vec3d& up) {
  parts_->up = up;
  parts_->camera->SetViewUp(up.data());
}

void SceneView::set_clip(const Vec3d& normal, double offset) {
  parts_->tool_clip = {normal, offset};
  update_clip();
}

void SceneView::set_view_clip(const Vec3d& normal, double offset) {
  const Parts::ClipPlane wanted{normal, offset};
  if (parts_->view_clip == wanted) return;
  parts_->view_clip = wanted;
  update_clip();
}

void SceneView::update_clip() {
  Parts& p = *parts_;
  p.clip_planes->RemoveAllItems();
  for (const Parts::ClipPlane& clip : {p.tool_clip, p.view_clip}) {
    if (clip.normal.isZero()) continue;
    vtkNew<vtkPlane> plane;
    const Vec3d origin = clip.offset * clip.normal / clip.normal.squaredNorm();
    plane->SetNormal(clip.normal.data());
    plane->SetOrigin(origin.data());
    p.clip_planes->AddItem(plane);
  }
  for (auto& [id, item] : p.items) {
    if (!item.style.boxed) continue;
    for (const auto& actor : item.actors)
      if (actor) actor->GetMapper()->SetClippingPlanes(p.clip_planes);
    if (item.coarse) item.coarse->GetMapper()->SetClippingPlanes(p.clip_planes);
  }
  request_render();
}

void SceneView::set_surface_look(SurfaceLook look) {
  parts_->look = look;
  for (auto& [id, item] : parts_->items) apply_style(item);
  request_render();
}

void SceneView::set_ambient_occlusion(bool on) {
  parts_->occlusion = on;
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

void SceneView::request_render() {
  parts_->more.stop();
  parts_->complete = false;
  if (!parts_->render.isActive()) parts_->render.start(0);
}

void SceneView::update_overlay() {
  parts_->overlay->update();
  place_actions();
}

void SceneView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  request_render();  // changes made while it was hidden were not drawn
}

void SceneView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  parts_->canvas->setGeometry(rect());
  parts_->overlay->setGeometry(rect());
  parts_->overlay->raise();
  place_actions();
  // Until the user moves the camera, everything is kept in view.
  if (!parts_->touched) reset_camera();
  request_render();
}

}  // namespace turnscan::studio
