#include "explorer/tool_panel.hpp"

#include <QButtonGroup>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QSlider>
#include <QVBoxLayout>

#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

enum Tool { kMeasure = 0, kPlane = 1, kLasso = 2 };
constexpr int kPlaneSteps = 1000;

}  // namespace

/// Two clicks; the third begins anew.
class MeasureTool : public ViewTool {
 public:
  MeasureTool(SceneView& view, QLabel& text) : view_(view), text_(text) {}

  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override {
    if (keys != Qt::NoModifier) return false;
    const auto point = view_.pick(at);
    if (!point) return false;  // on the background the mouse turns the camera
    if (points_.size() == 2) points_.clear();
    points_.push_back(*point);
    show();
    return true;
  }

  void paint(QPainter& painter) override {
    std::vector<QPointF> pixels;
    for (const Vec3d& p : points_)
      if (const auto pixel = view_.project(p)) pixels.push_back(*pixel);
    painter.setPen(QPen(QColor(0xd2453c), 2));
    if (pixels.size() == 2) painter.drawLine(pixels[0], pixels[1]);
    painter.setBrush(QColor(0xd2453c));
    for (const QPointF& pixel : pixels) painter.drawEllipse(pixel, 4, 4);
    if (pixels.size() < 2) return;
    const QRectF card(0.5 * (pixels[0] + pixels[1]) - QPointF(48, 26), QSizeF(96, 22));
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(255, 255, 255, 230));
    painter.drawRoundedRect(card, 5, 5);
    painter.setPen(QColor(0x1d2630));
    painter.drawText(card, Qt::AlignCenter, length());
  }

  void clear() {
    points_.clear();
    show();
  }
  std::optional<double> distance() const {
    if (points_.size() < 2) return std::nullopt;
    return (points_[1] - points_[0]).norm();
  }

 private:
  QString length() const {
    return points_.size() < 2 ? QString() : QObject::tr("%1 mm").arg(1e3 * *distance(), 0, 'f', 2);
  }
  void show() {
    text_.setText(points_.size() == 2   ? QObject::tr("Distance: %1").arg(length())
                  : points_.size() == 1 ? QObject::tr("Click the second point")
                                        : QObject::tr("Click two points on a model"));
    view_.update_overlay();
  }

  SceneView& view_;
  QLabel& text_;
  std::vector<Vec3d> points_;
};

class LassoTool : public ViewTool {
 public:
  LassoTool(SceneView& view, ToolPanel& panel) : view_(view), panel_(panel) {}

  bool press(const QPointF& at, Qt::KeyboardModifiers keys) override {
    if (keys != Qt::NoModifier) return false;
    path_ = {{at.x(), at.y()}};
    return true;
  }
  void drag(const QPointF& at, Qt::KeyboardModifiers /*keys*/) override {
    path_.emplace_back(at.x(), at.y());
    view_.update_overlay();
  }
  void release(const QPointF& /*at*/) override {
    const Outline outline = std::move(path_);
    path_.clear();
    view_.update_overlay();
    if (outline.size() > 2) Q_EMIT panel_.lassoed(outline, view_.to_pixels());
  }
  void paint(QPainter& painter) override {
    if (path_.size() < 2) return;
    QPainterPath path(QPointF(path_[0].first, path_[0].second));
    for (const auto& [x, y] : path_) path.lineTo(x, y);
    path.closeSubpath();
    painter.setPen(QPen(QColor(0xd2453c), 2));
    painter.setBrush(QColor(210, 69, 60, 40));
    painter.drawPath(path);
  }

 private:
  SceneView& view_;
  ToolPanel& panel_;
  Outline path_;
};

ToolPanel::ToolPanel(SceneView& view, QWidget* parent)
    : QWidget(parent), view_(view), alive_(&view), buttons_(new QButtonGroup(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  layout->addLayout(make_tool_buttons());
  text_ = quiet_label({}, this);
  text_->setVisible(false);
  layout->addWidget(text_);
  plane_box_ = make_plane_box();
  layout->addWidget(plane_box_);
  measure_ = std::make_unique<MeasureTool>(view_, *text_);
  lasso_ = std::make_unique<LassoTool>(view_, *this);
  connect(buttons_, &QButtonGroup::idToggled, this, &ToolPanel::choose);
  set_box({});
}

QLayout* ToolPanel::make_tool_buttons() {
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  const std::pair<QString, QString> names[] = {
      {tr("Measure"), tr("Click two points; the distance is shown")},
      {tr("Cut"), tr("Cut the selected model by a plane")},
      {tr("Lasso"), tr("Draw around a part of the selected model to delete it")}};
  buttons_->setExclusive(false);
  for (int i = 0; i < 3; ++i) {
    auto* made = button(names[i].first, names[i].second, this);
    made->setCheckable(true);
    buttons_->addButton(made, i);
    row->addWidget(made, 1);
  }
  return row;
}

QWidget* ToolPanel::make_plane_box() {
  auto* box = new QWidget(this);
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  axis_ = new QComboBox(box);
  axis_->addItems({"X", "Y", "Z"});
  axis_->setCurrentIndex(1);
  place_ = new QSlider(Qt::Horizontal, box);
  place_->setRange(0, kPlaneSteps);
  place_->setObjectName("plane_place");
  flip_ = button(tr("Flip"), tr("Keep the other side"), box);
  flip_->setCheckable(true);
  auto* apply = button(tr("Cut"), tr("Add the part that is shown as a new model"), box);
  apply->setObjectName("plane_cut");
  row->addWidget(axis_);
  row->addWidget(place_, 1);
  row->addWidget(flip_);
  row->addWidget(apply);
  box->setVisible(false);
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, &ToolPanel::show_plane);
  connect(place_, &QSlider::valueChanged, this, &ToolPanel::show_plane);
  connect(flip_, &QPushButton::toggled, this, &ToolPanel::show_plane);
  connect(apply, &QPushButton::clicked, this, [this] {
    const auto [normal, offset] = plane();
    stop();
    Q_EMIT cut_wanted(normal, offset);
  });
  return box;
}

ToolPanel::~ToolPanel() {
  // When the window ends, the view may have gone before.
  if (alive_) view_.set_tool(nullptr);
}

void ToolPanel::set_box(const Box& box) {
  box_ = box;
  buttons_->button(kPlane)->setEnabled(!box.empty());
  buttons_->button(kLasso)->setEnabled(!box.empty());
  if (plane_box_->isVisible()) show_plane();
}

void ToolPanel::stop() {
  for (QAbstractButton* each : buttons_->buttons()) each->setChecked(false);
}

std::optional<double> ToolPanel::measured_m() const { return measure_->distance(); }

void ToolPanel::choose(int tool, bool on) {
  if (on) {
    for (QAbstractButton* each : buttons_->buttons())
      if (buttons_->id(each) != tool) each->setChecked(false);
  }
  const int active = buttons_->button(kMeasure)->isChecked() ? kMeasure
                     : buttons_->button(kPlane)->isChecked() ? kPlane
                     : buttons_->button(kLasso)->isChecked() ? kLasso
                                                             : -1;
  plane_box_->setVisible(active == kPlane);
  text_->setVisible(active == kMeasure || active == kLasso);
  if (active == kLasso) text_->setText(tr("Draw around what is to go; Ctrl+Z brings it back"));
  if (active == kMeasure) {
    measure_->clear();
    view_.set_tool(measure_.get());
  } else {
    view_.set_tool(active == kLasso ? lasso_.get() : nullptr);
  }
  if (active == kPlane) {
    place_->setValue(kPlaneSteps / 2);
    show_plane();
  } else {
    view_.set_clip(Vec3d::Zero(), 0.0);
  }
}

std::pair<Vec3d, double> ToolPanel::plane() const {
  const int axis = axis_->currentIndex();
  const double at = box_.min[axis] + box_.size()[axis] * place_->value() / kPlaneSteps;
  const double sign = flip_->isChecked() ? -1.0 : 1.0;
  return {sign * Vec3d::Unit(axis), sign * at};
}

void ToolPanel::show_plane() {
  if (box_.empty()) return;
  const auto [normal, offset] = plane();
  view_.set_clip(normal, offset);
}

}  // namespace turnscan::studio
