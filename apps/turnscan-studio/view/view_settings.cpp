#include "view/view_settings.hpp"

#include <QCheckBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QSettings>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVariant>
#include <algorithm>
#include <cmath>

#include "view/scene_view.hpp"
#include "widgets/section.hpp"
#include "widgets/theme.hpp"

namespace turnscan::studio {

ViewSettings::ViewSettings(QObject* parent) : QObject(parent) {
  const QSettings stored;
  camera_speed_ = std::clamp(stored.value("view/camera_speed", 1.0).toDouble(), 0.1, 10.0);
  point_size_ = std::clamp(stored.value("view/point_size", 2.0).toDouble(), 1.0, 12.0);
  boxes_ = stored.value("view/boxes", false).toBool();
  dark_ = stored.value("view/dark", false).toBool();
}

const Theme& ViewSettings::theme() const { return dark_ ? dark_theme() : light_theme(); }

void ViewSettings::set_camera_speed(double factor) {
  camera_speed_ = factor;
  store();
}

void ViewSettings::set_point_size(double pixels) {
  point_size_ = pixels;
  store();
}

void ViewSettings::set_boxes(bool on) {
  boxes_ = on;
  store();
}

void ViewSettings::set_dark(bool on) {
  dark_ = on;
  store();
}

void ViewSettings::store() {
  QSettings stored;
  stored.setValue("view/camera_speed", camera_speed_);
  stored.setValue("view/point_size", point_size_);
  stored.setValue("view/boxes", boxes_);
  stored.setValue("view/dark", dark_);
  Q_EMIT changed();
}

void ViewSettings::attach(SceneView* view) {
  const auto apply = [this, view] {
    view->set_camera_speed(camera_speed_);
    view->set_point_size(point_size_);
    view->set_boxes(boxes_);
    view->set_theme(theme());
  };
  connect(this, &ViewSettings::changed, view, apply);
  apply();
}

namespace {

QMenu* view_menu(SceneView& view, QWidget* parent) {
  auto* menu = new QMenu(parent);
  const std::pair<QString, StandardView> views[] = {
      {QObject::tr("Front\t1"), StandardView::kFront},
      {QObject::tr("Back\t2"), StandardView::kBack},
      {QObject::tr("Left\t3"), StandardView::kLeft},
      {QObject::tr("Right\t4"), StandardView::kRight},
      {QObject::tr("Top\t5"), StandardView::kTop},
      {QObject::tr("Bottom\t6"), StandardView::kBottom},
      {QObject::tr("Corner\t7"), StandardView::kCorner}};
  for (const auto& [name, from] : views)
    QObject::connect(menu->addAction(name), &QAction::triggered, &view,
                     [&view, from = from] { view.look(from); });
  return menu;
}

void add_camera_buttons(QHBoxLayout& row, SceneView& view, QWidget* parent) {
  auto* reset =
      tool_button(QObject::tr("Reset camera"), QObject::tr("Show everything (Home)"), parent);
  auto* views =
      tool_button(QObject::tr("Views"), QObject::tr("Look from one side (1 to 7)"), parent);
  views->setMenu(view_menu(view, views));
  views->setProperty("menu", true);
  views->setPopupMode(QToolButton::InstantPopup);
  row.addWidget(reset);
  row.addWidget(views);
  QObject::connect(reset, &QToolButton::clicked, &view, [&view] { view.reset_camera(); });
}

/// 100 steps of a slider on a logarithmic scale.
int step_of(double value, double low, double high) {
  return int(std::lround(100.0 * std::log(value / low) / std::log(high / low)));
}
double value_of(int step, double low, double high) {
  return low * std::pow(high / low, step / 100.0);
}

QSlider* slider(const QString& said, const QString& tip, const QString& name, QWidget* parent) {
  auto* made = new QSlider(Qt::Horizontal, parent);
  made->setAccessibleName(said);
  made->setRange(0, 100);
  made->setToolTip(tip);
  made->setObjectName(name);
  return made;
}

}  // namespace

ViewPanel::ViewPanel(ViewSettings& settings, SceneView& view, QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  setObjectName("view_panel");
  setAttribute(Qt::WA_StyledBackground);
  grid->setContentsMargins(18, 12, 18, 10);
  grid->setHorizontalSpacing(10);
  grid->setVerticalSpacing(8);
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  add_camera_buttons(*row, view, this);
  row->addStretch();
  auto* boxes = new QCheckBox(tr("Bounding boxes"), this);
  boxes->setToolTip(tr("Draw the box around each model (B)"));
  grid->addLayout(row, 0, 0, 1, 4);
  grid->addWidget(boxes, 2, 0, 1, 4);
  auto* speed = slider(tr("Camera speed"), tr("How fast mouse and keys move the camera"),
                       "camera_speed", this);
  auto* size = slider(tr("Point size"), tr("Size of points on the screen"), "point_size", this);
  grid->addWidget(new QLabel(tr("Camera speed"), this), 1, 0);
  grid->addWidget(speed, 1, 1);
  grid->addWidget(new QLabel(tr("Point size"), this), 1, 2);
  grid->addWidget(size, 1, 3);
  connect(boxes, &QCheckBox::toggled, &settings, &ViewSettings::set_boxes);
  connect(speed, &QSlider::valueChanged, &settings,
          [&settings](int step) { settings.set_camera_speed(value_of(step, 0.1, 10.0)); });
  connect(size, &QSlider::valueChanged, &settings,
          [&settings](int step) { settings.set_point_size(value_of(step, 1.0, 12.0)); });
  const auto show = [&settings, boxes, speed, size] {
    const QSignalBlocker quiet_boxes(boxes), quiet_speed(speed), quiet_size(size);
    boxes->setChecked(settings.boxes());
    speed->setValue(step_of(settings.camera_speed(), 0.1, 10.0));
    size->setValue(step_of(settings.point_size(), 1.0, 12.0));
  };
  connect(&settings, &ViewSettings::changed, this, show);
  show();
}

}  // namespace turnscan::studio
