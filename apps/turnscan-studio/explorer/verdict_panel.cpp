#include "explorer/verdict_panel.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "explorer/scan_quality.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

QString light_text(const Verdict& verdict) {
  const QString colour = QString::fromUtf8(verdict.colour().data(), int(verdict.colour().size()));
  return QString("%1  %2").arg(sign_of(verdict.level()), colour.toUpper());
}

/// Worded for users who do not use the command line.
QString shown_sentence(const VerdictSentence& sentence) {
  static const QRegularExpression command(R"( \(turnscan [^)]*\))");
  return QString::fromStdString(sentence.text).remove(command).replace("cm2", "cm²");
}

QString sentence_html(const VerdictSentence& sentence) {
  return QString("<p style=\"margin:3px 0\"><span style=\"color:%1\">%2</span>&nbsp;%3</p>")
      .arg(color_of(sentence.level).name(), sign_of(sentence.level),
           shown_sentence(sentence).toHtmlEscaped());
}

}  // namespace

VerdictPanel::VerdictPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(8);
  light_ = new QLabel(this);
  light_->setObjectName("verdict");
  light_->setAccessibleName(tr("Verdict"));
  sentences_ = new ParagraphLabel(this);
  sentences_->setObjectName("verdict_sentences");
  sentences_->setTextFormat(Qt::RichText);
  auto* row = new QHBoxLayout;
  colors_ = new QComboBox(this);
  colors_->setObjectName("verdict_colors");
  colors_->setAccessibleName(tr("Colours of the mesh"));
  colors_->setToolTip(tr("What the colours of the selected mesh show"));
  leave_wheel_to_panel(colors_);
  report_ = button(tr("Export report…"),
                   tr("One HTML file with the model in 3D, the verdict, pictures and plots"), this);
  row->addWidget(colors_, 1);
  row->addWidget(report_);
  layout->addWidget(light_);
  layout->addWidget(sentences_);
  layout->addLayout(row);
  connect(colors_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          &VerdictPanel::color_way_changed);
  connect(report_, &QPushButton::clicked, this, &VerdictPanel::report_wanted);
  show_quality(nullptr);
}

void VerdictPanel::show_quality(const std::shared_ptr<const ScanQuality>& quality) {
  const bool other = quality != quality_;
  quality_ = quality;
  light_->setVisible(quality != nullptr);
  colors_->setEnabled(quality != nullptr);
  report_->setEnabled(quality != nullptr);
  if (other || !quality) {
    const QSignalBlocker quiet(colors_);
    const QString before = color_way();
    colors_->clear();
    colors_->addItem(tr("Own colours"), QString());
    if (quality)
      for (const ColorWay& way : color_ways(*quality)) colors_->addItem(way.label, way.id);
    colors_->setCurrentIndex(std::max(0, colors_->findData(before)));
  }
  if (!quality) {
    sentences_->show_text(
        tr("Select a mesh that was made from a recording: how good it is, and why, stands here. "
           "One that was edited, opened from a file or restored has no verdict; reconstruct its "
           "recording for one."));
    return;
  }
  light_->setText(light_text(quality->verdict));
  light_->setStyleSheet(
      QString("background:%1; color:#101010; font-weight:bold; padding:6px 10px; border-radius:4px")
          .arg(color_of(quality->verdict.level()).name()));
  QString html;
  for (const VerdictSentence& sentence : quality->verdict.sentences)
    html += sentence_html(sentence);
  sentences_->show_text(html);
}

QString VerdictPanel::color_way() const { return colors_->currentData().toString(); }

QString VerdictPanel::text() const {
  if (!quality_) return sentences_->text();
  QString out = light_->text();
  for (const VerdictSentence& sentence : quality_->verdict.sentences)
    out += "\n" + QString::fromStdString(sentence.text);
  return out;
}

}  // namespace turnscan::studio
