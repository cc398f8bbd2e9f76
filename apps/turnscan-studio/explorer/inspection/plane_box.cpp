#include "explorer/inspection/plane_box.hpp"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <cmath>

#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

constexpr int kSliderSteps = 1000;

}  // namespace

PlaneBox::PlaneBox(const QString& name, Side stays, QWidget* parent)
    : QWidget(parent),
      axis_(new QComboBox(this)),
      place_(new QDoubleSpinBox(this)),
      slider_(new QSlider(Qt::Horizontal, this)),
      flip_(button(tr("Flip"), tr("Keep the other side"), this)),
      stays_(stays) {
  setObjectName(name);
  axis_->setObjectName(name + "_axis");
  axis_->addItems({"X", "Y", "Z"});
  axis_->setCurrentIndex(1);
  axis_->setToolTip(tr("The axis that the plane is perpendicular to"));
  axis_->setAccessibleName(tr("Axis of the plane"));
  place_->setObjectName(name + "_place");
  place_->setDecimals(2);
  place_->setSuffix(" mm");
  place_->setKeyboardTracking(false);
  place_->setToolTip(tr("Where the plane meets the axis"));
  place_->setAccessibleName(tr("Place of the plane"));
  slider_->setObjectName(name + "_slider");
  slider_->setRange(0, kSliderSteps);
  slider_->setAccessibleName(tr("Place of the plane"));
  flip_->setObjectName(name + "_flip");
  flip_->setCheckable(true);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  grid->addWidget(axis_, 0, 0);
  grid->addWidget(place_, 0, 1);
  grid->addWidget(flip_, 0, 2);
  grid->addWidget(slider_, 1, 0, 1, 3);
  for (QWidget* each : std::initializer_list<QWidget*>{axis_, place_, slider_})
    leave_wheel_to_panel(each);
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    set_range();
    Q_EMIT changed();
  });
  connect(flip_, &QPushButton::toggled, this, &PlaneBox::changed);
  connect(slider_, &QSlider::valueChanged, this, [this](int step) {
    place_->setValue(1e3 * (low() + (high() - low()) * step / kSliderSteps));
  });
  connect(place_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double mm) {
    const QSignalBlocker quiet(slider_);
    const double size = high() - low();
    slider_->setValue(size > 0.0 ? int(std::lround(kSliderSteps * (1e-3 * mm - low()) / size)) : 0);
    Q_EMIT changed();
  });
}

double PlaneBox::low() const { return box_.empty() ? 0.0 : box_.min[axis_->currentIndex()]; }

double PlaneBox::high() const { return box_.empty() ? 0.0 : box_.max[axis_->currentIndex()]; }

void PlaneBox::set_box(const Box& box) {
  const bool same =
      box.empty() == box_.empty() && (box.min - box_.min).isZero() && (box.max - box_.max).isZero();
  box_ = box;
  if (!same) set_range();
}

void PlaneBox::set_range() {
  const QSignalBlocker quiet(place_), quiet_slider(slider_);
  const double before = 1e-3 * place_->value();
  place_->setRange(1e3 * low(), 1e3 * high());
  place_->setSingleStep(std::max(
      0.01, std::pow(10.0, std::floor(std::log10(std::max(1e-6, 10.0 * (high() - low())))))));
  const bool fits = before > low() && before < high();
  place_->setValue(1e3 * (fits ? before : 0.5 * (low() + high())));
  const double size = high() - low();
  slider_->setValue(
      size > 0.0 ? int(std::lround(kSliderSteps * (1e-3 * place_->value() - low()) / size)) : 0);
}

std::pair<Vec3d, double> PlaneBox::plane() const {
  const double sign = flip_->isChecked() == (stays_ == kAbove) ? -1.0 : 1.0;
  return {sign * Vec3d::Unit(axis_->currentIndex()), sign * 1e-3 * place_->value()};
}

}  // namespace turnscan::studio
