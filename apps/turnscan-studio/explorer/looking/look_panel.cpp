#include "explorer/looking/look_panel.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <cmath>

#include "explorer/models.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr int kClipSteps = 1000;

QSlider* look_slider(int steps, const QString& name, const QString& said, QWidget* parent) {
  auto* made = new QSlider(Qt::Horizontal, parent);
  made->setRange(0, steps);
  made->setObjectName(name);
  made->setAccessibleName(said);
  return made;
}

Box box_of_shown(const ModelStore& store) {
  Box box;
  for (const Model& model : store.models()) {
    const Box& own = box_of(*model.data->drawable);
    if (!model.visible || own.empty()) continue;
    box.add(own.min);
    box.add(own.max);
  }
  return box;
}

}  // namespace

LookPanel::LookPanel(SceneView& view, ModelStore& store, QWidget* parent)
    : QWidget(parent),
      view_(&view),
      store_(store),
      surface_(new QComboBox(this)),
      opacity_(look_slider(100, "look_opacity", tr("Opacity of the selected model"), this)),
      isolate_(button(tr("Isolate"), tr("Show the selected model alone"), this)),
      movie_(button(tr("Turntable movie…"),
                    tr("A film or pictures of the view, turned once about the vertical"), this)),
      stages_(button(tr("Stages…"), tr("What is checked in the list, side by side in one picture"),
                     this)),
      occlusion_(new QCheckBox(tr("Ambient occlusion"), this)) {
  surface_->setObjectName("look_surface");
  surface_->addItems({tr("Shaded"), tr("Shaded, with edges"), tr("Wireframe"), tr("Normals")});
  surface_->setFocusPolicy(Qt::StrongFocus);
  // The longest entry would widen the panel.
  surface_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  surface_->setMinimumContentsLength(8);
  surface_->setToolTip(tr("How surfaces are drawn; normals: x red, y green, z blue"));
  opacity_->setToolTip(tr("Opacity of the selected model"));
  occlusion_->setObjectName("look_occlusion");
  occlusion_->setToolTip(
      tr("Draw recesses darker (ambient occlusion) while the view does not move; slow without a "
         "graphics card"));
  isolate_->setCheckable(true);
  isolate_->setObjectName("look_isolate");
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(8);
  auto* surface = new QLabel(tr("Surface"), this);
  surface->setBuddy(surface_);
  auto* opacity = new QLabel(tr("Opacity"), this);
  opacity->setBuddy(opacity_);
  grid->addWidget(surface, 0, 0);
  grid->addWidget(surface_, 0, 1);
  grid->addWidget(isolate_, 0, 2);
  grid->addWidget(opacity, 1, 0);
  grid->addWidget(opacity_, 1, 1, 1, 2);
  grid->addWidget(new QLabel(tr("Clip"), this), 2, 0);
  grid->addWidget(make_clip_row(), 2, 1, 1, 2);
  grid->addWidget(occlusion_, 3, 0, 1, 2);
  grid->addWidget(movie_, 3, 2);
  grid->addWidget(stages_, 4, 2);
  grid->setColumnStretch(1, 1);
  connect(surface_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int look) {
    if (view_) view_->set_surface_look(SurfaceLook(look));
  });
  connect(opacity_, &QSlider::valueChanged, this,
          [this](int percent) { store_.set_opacity(model_, 0.01 * percent); });
  connect(isolate_, &QPushButton::toggled, this, &LookPanel::isolation_changed);
  connect(movie_, &QPushButton::clicked, this, &LookPanel::movie_wanted);
  connect(stages_, &QPushButton::clicked, this, &LookPanel::stages_wanted);
  connect(occlusion_, &QCheckBox::toggled, this, [this](bool on) {
    if (view_) view_->set_ambient_occlusion(on);
  });
  connect(&store_, &ModelStore::changed, this, &LookPanel::follow);
  follow();
}

QWidget* LookPanel::make_clip_row() {
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  axis_ = new QComboBox(row);
  axis_->setObjectName("look_clip");
  axis_->setAccessibleName(tr("Axis of the clipping plane"));
  axis_->addItems({tr("Off"), "X", "Y", "Z"});
  axis_->setFocusPolicy(Qt::StrongFocus);
  place_ = look_slider(kClipSteps, "look_clip_place", tr("Place of the clipping plane"), row);
  place_->setValue(kClipSteps / 2);
  flip_ = button(tr("Flip"), tr("Show the other side"), row);
  flip_->setCheckable(true);
  flip_->setAccessibleName(tr("Show the other side of the clipping plane"));
  layout->addWidget(axis_);
  layout->addWidget(place_, 1);
  layout->addWidget(flip_);
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, &LookPanel::clip);
  connect(place_, &QSlider::valueChanged, this, &LookPanel::clip);
  connect(flip_, &QPushButton::toggled, this, &LookPanel::clip);
  return row;
}

void LookPanel::show_model(int id) {
  model_ = id;
  follow();
}

bool LookPanel::isolated() const { return isolate_->isChecked(); }

void LookPanel::follow() {
  const Model* model = store_.find(model_);
  const QSignalBlocker quiet(opacity_);
  opacity_->setEnabled(model != nullptr);
  opacity_->setValue(model ? int(std::lround(100.0 * model->opacity)) : 100);
  movie_->setEnabled(!store_.models().empty());
  stages_->setEnabled(!store_.models().empty());
  clip();
}

void LookPanel::clip() {
  const int axis = axis_->currentIndex() - 1;
  const Box box = box_of_shown(store_);
  place_->setEnabled(axis >= 0);
  flip_->setEnabled(axis >= 0);
  if (!view_) return;
  if (axis < 0 || box.empty()) {
    view_->set_view_clip(Vec3d::Zero(), 0.0);
    return;
  }
  const double at = box.min[axis] + box.size()[axis] * place_->value() / kClipSteps;
  const double sign = flip_->isChecked() ? 1.0 : -1.0;
  view_->set_view_clip(sign * Vec3d::Unit(axis), sign * at);
}

}  // namespace turnscan::studio
