#include "app/mode.hpp"

#include <QFrame>
#include <QHBoxLayout>
#include <QScrollArea>
#include <QSplitter>
#include <QTabBar>
#include <QTabWidget>
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
  split_ = new QSplitter(Qt::Horizontal, this);
  split_->setChildrenCollapsible(false);
  split_->setHandleWidth(1);
  auto* side = new QWidget(split_);
  side->setObjectName("panel");
  side->setMinimumWidth(360);
  column_ = new QVBoxLayout(side);
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(0);
  view_panel_ = new ViewPanel(services_.settings, *view_, side);
  column_->addWidget(view_panel_);
  area_ = new QScrollArea(side);
  body_ = scrolled_body(area_);
  column_->addWidget(area_, 1);
  auto* lower_rule = new QFrame(side);
  lower_rule->setObjectName("rule");
  lower_rule->setFixedHeight(1);
  column_->addWidget(lower_rule);
  footer_ = new QVBoxLayout;
  footer_->setContentsMargins(14, 8, 14, 10);
  footer_->setSpacing(6);
  column_->addLayout(footer_);
  split_->addWidget(view_);
  split_->addWidget(side);
  split_->setStretchFactor(0, 1);
  split_->setStretchFactor(1, 0);
  split_->setSizes({900, 390});
  layout->addWidget(split_);
}

QVBoxLayout* Mode::add_tab(const QString& title) {
  if (!tabs_) {
    tabs_ = new QTabWidget(this);
    tabs_->setDocumentMode(true);
    tabs_->setMinimumWidth(380);
    tabs_->tabBar()->setDrawBase(false);
    delete column_->replaceWidget(area_, tabs_);
    delete area_;
    column_->setStretchFactor(tabs_, 1);
  }
  auto* area = new QScrollArea(tabs_);
  tabs_->addTab(area, title);
  return scrolled_body(area);
}

void Mode::set_tree(QWidget* tree) {
  auto* panel = new QWidget(split_);
  panel->setObjectName("tree_panel");
  auto* layout = new QVBoxLayout(panel);
  layout->setContentsMargins(4, 12, 4, 4);
  layout->addWidget(tree);
  split_->insertWidget(0, panel);
  split_->setStretchFactor(0, 0);
  split_->setSizes({232, 810, 380});
}

void Mode::set_footer(std::initializer_list<QWidget*> parts) {
  for (QWidget* part : parts) footer_->addWidget(part);
}

void Mode::reveal(QWidget* part) {
  for (int i = 0; tabs_ && i < tabs_->count(); ++i)
    if (tabs_->widget(i)->isAncestorOf(part)) tabs_->setCurrentIndex(i);
  // After the layout has made room for it.
  QTimer::singleShot(0, part, [part] {
    for (QWidget* up = part->parentWidget(); up; up = up->parentWidget())
      if (auto* area = qobject_cast<QScrollArea*>(up)) area->ensureWidgetVisible(part, 0, 24);
  });
}

}  // namespace turnscan::studio
