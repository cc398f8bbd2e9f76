#include "widgets/section.hpp"
#include "widgets/message_log.hpp"

#include <QCoreApplication>
#include <QFrame>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

namespace turnscan::studio {

Section::Section(const QString& title, bool open, QWidget* parent, Level level)
    : QWidget(parent), header_(new QToolButton(this)), content_(new QWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  header_->setObjectName("section");
  header_->setText(title);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setCheckable(true);
  header_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  body_ = new QVBoxLayout(content_);
  body_->setContentsMargins(4, 2, 4, 12);
  body_->setSpacing(8);
  layout->addWidget(header_);
  layout->addWidget(content_);
  if (level == kNested) {
    header_->setProperty("nested", true);
    body_->setContentsMargins(16, 0, 0, 8);
  } else {
    auto* rule = new QFrame(this);
    rule->setObjectName("rule");
    rule->setFixedHeight(1);
    layout->addWidget(rule);
  }
  connect(header_, &QToolButton::toggled, this, [this](bool on) {
    content_->setVisible(on);
    header_->setArrowType(on ? Qt::DownArrow : Qt::RightArrow);
  });
  header_->setChecked(open);
  header_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
  content_->setVisible(open);
}

void Section::set_open(bool open) { header_->setChecked(open); }

bool Section::is_open() const { return header_->isChecked(); }

MessageLabel::MessageLabel(QWidget* parent) : QLabel(parent), dismiss_(new QToolButton(this)) {
  setObjectName("error");
  setContentsMargins(0, 0, 16, 0);
  dismiss_->setObjectName("dismiss");
  dismiss_->setText("×");
  dismiss_->setAccessibleName(QCoreApplication::translate("MessageLabel", "Dismiss the message"));
  connect(dismiss_, &QToolButton::clicked, this, [this] { show_text({}); });
  setWordWrap(true);
  setTextInteractionFlags(Qt::TextSelectableByMouse);
  setVisible(false);
}

void MessageLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  dismiss_->setGeometry(width() - 24, 4, 20, 20);
}

void MessageLabel::show_text(const QString& text) {
  messages().add(text, true);
  setText(text);
  setVisible(!text.isEmpty());
}

void MessageLabel::add_text(const QString& added) {
  messages().add(added, true);
  setText(text().isEmpty() ? added : text() + "\n" + added);
  setVisible(true);
}

ParagraphLabel::ParagraphLabel(QWidget* parent) : QLabel(parent) {
  setWordWrap(true);
  setTextInteractionFlags(Qt::TextSelectableByMouse);
}

void ParagraphLabel::show_text(const QString& text) {
  setText(text);
  fit();
  make_room();
}

void ParagraphLabel::showEvent(QShowEvent* event) {
  QLabel::showEvent(event);
  make_room();
}

void ParagraphLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  fit();
}

// In nested layouts, wrapped text gets less height than it needs.
void ParagraphLabel::fit() {
  setMinimumHeight(0);  // otherwise included in the height that a label needs
  setMinimumHeight(std::max(0, heightForWidth(width())));
}

// Each layout requests room from its parent by an event, one event loop iteration after the other:
// until the last has answered, the text overlaps what is below it.
void ParagraphLabel::make_room() {
  for (QWidget* around = parentWidget(); around && !around->isWindow() && around->isVisible();
       around = around->parentWidget())
    QCoreApplication::sendPostedEvents(around, QEvent::LayoutRequest);
}

QLabel* quiet_label(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setObjectName("quiet");
  label->setWordWrap(true);
  return label;
}

QPushButton* button(const QString& text, const QString& tip, QWidget* parent) {
  auto* made = new QPushButton(text, parent);
  made->setToolTip(tip);
  return made;
}

QPushButton* primary_button(const QString& text, const QString& tip, QWidget* parent) {
  auto* made = button(text, tip, parent);
  made->setObjectName("primary");
  return made;
}

QToolButton* tool_button(const QString& text, const QString& tip, QWidget* parent) {
  auto* made = new QToolButton(parent);
  made->setText(text);
  made->setToolTip(tip);
  made->setObjectName("tool");
  return made;
}

QVBoxLayout* scrolled_body(QScrollArea* area) {
  auto* body = new QWidget(area);
  body->setObjectName("panel_body");
  auto* layout = new QVBoxLayout(body);
  layout->setContentsMargins(14, 6, 14, 12);
  layout->setSpacing(0);
  area->setWidget(body);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  return layout;
}

}  // namespace turnscan::studio
