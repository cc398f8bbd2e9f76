#include "explorer/side_panel.hpp"

#include <QCheckBox>
#include <QPushButton>
#include <QVBoxLayout>

#include "explorer/models.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

SidePanel::SidePanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  text_ = new ParagraphLabel(this);
  text_->setObjectName("advice");
  draw_ = new QCheckBox(tr("Show what no view saw"), this);
  draw_->setToolTip(tr("Surface that was closed without a measurement, in magenta"));
  draw_->setChecked(true);
  scan_ = button(tr("Scan another side"),
                 tr("Lay the object another way and record it again; the passes become one mesh"),
                 this);
  for (QWidget* part : std::initializer_list<QWidget*>{text_, draw_, scan_})
    layout->addWidget(part);
  connect(draw_, &QCheckBox::toggled, this, &SidePanel::drawn_changed);
  connect(scan_, &QPushButton::clicked, this, &SidePanel::scan_wanted);
  show_missing(nullptr);
}

void SidePanel::show_missing(const std::shared_ptr<const MissingSurface>& missing) {
  text_->show_text(missing ? missing->side.advice
                           : tr("Select a mesh that was made from a recording: what no view saw of "
                                "it, and how to lay it for the next pass, stands here."));
  draw_->setEnabled(missing && missing->drawable);
  scan_->setEnabled(missing && !missing->side.recording.isEmpty());
}

bool SidePanel::drawn() const { return draw_->isChecked(); }

}  // namespace turnscan::studio
