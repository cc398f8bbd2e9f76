#include "app/mode.hpp"

#include <QFrame>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QSplitter>
#include <QTimer>
#include <QVBoxLayout>

#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

Mode::Mode(const Services& services, QWidget* parent)
    : QWidget(parent), services_(services), view_(new SceneView(this)) {
  services_.settings.attach(view_);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* split = new QSplitter(Qt::Horizontal, this);
  split->setChildrenCollapsible(false);
  split->setHandleWidth(1);
  auto* side = new QWidget(split);
  side->setObjectName("panel");
  side->setMinimumWidth(360);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(new ViewPanel(services_.settings, *view_, side));
  auto* rule = new QFrame(side);
  rule->setObjectName("rule");
  rule->setFixedHeight(1);
  column->addWidget(rule);
  area_ = new QScrollArea(side);
  body_ = scrolled_body(area_);
  column->addWidget(area_, 1);
  auto* lower_rule = new QFrame(side);
  lower_rule->setObjectName("rule");
  lower_rule->setFixedHeight(1);
  column->addWidget(lower_rule);
  footer_ = new QVBoxLayout;
  footer_->setContentsMargins(14, 8, 14, 10);
  footer_->setSpacing(6);
  column->addLayout(footer_);
  split->addWidget(view_);
  split->addWidget(side);
  split->setStretchFactor(0, 1);
  split->setStretchFactor(1, 0);
  split->setSizes({900, 390});
  layout->addWidget(split);
}

void Mode::set_footer(std::initializer_list<QWidget*> parts) {
  for (QWidget* part : parts) footer_->addWidget(part);
}

void Mode::reveal(QWidget* part) {
  // After the layout has made room for it.
  QTimer::singleShot(0, part, [this, part] { area_->ensureWidgetVisible(part, 0, 24); });
}

}  // namespace turnscan::studio
