#include "explorer/verdict_panel.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "explorer/scan_quality.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"

namespace turnscan::studio {

namespace {

QString light_text(const Verdict& verdict) {
  const QString colour = QString::fromUtf8(verdict.colour().data(), int(verdict.colour().size()));
  return QString("%1  %2").arg(sign_of(verdict.level()), colour.toUpper());
}

/// The first of what is worst; of a good scan, how far it lies from the truth.
std::size_t most_important(const Verdict& verdict) {
  const auto& all = verdict.sentences;
  const auto at = std::find_if(all.begin(), all.end(), [&](const VerdictSentence& s) {
    return s.level == verdict.level() && (s.level != Level::kGood || s.topic == "error");
  });
  return at == all.end() ? 0 : std::size_t(at - all.begin());
}

/// "0.21 mm", with the digits that the sentence gives it; empty: it has no single number.
QString figure_of(const VerdictSentence& sentence) {
  if (sentence.unit.empty()) return {};
  const QRegularExpression number(
      QString(R"(\d+(?:\.(\d+))? %1)").arg(QString::fromStdString(sentence.unit)));
  auto matches = number.globalMatch(QString::fromStdString(sentence.text));
  while (matches.hasNext()) {
    const auto match = matches.next();
    const double written = match.captured(0).section(' ', 0, 0).toDouble();
    const double last_digit = std::pow(10.0, -match.captured(1).size());
    if (std::abs(written - sentence.value) < 0.51 * last_digit)
      return match.captured(0).replace("cm2", "cm²");
  }
  return {};
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
  first_ = new ParagraphLabel(this);
  first_->setObjectName("verdict_first");
  more_ = new Section(tr("Other findings"), false, this, Section::kNested);
  more_->setObjectName("verdict_more");
  others_ = new ParagraphLabel(more_);
  others_->setObjectName("verdict_others");
  for (ParagraphLabel* each : {first_, others_}) each->setTextFormat(Qt::RichText);
  more_->body()->addWidget(others_);
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
  layout->addWidget(first_);
  layout->addWidget(more_);
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
  more_->setVisible(quality && quality->verdict.sentences.size() > 1);
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
    first_->show_text(
        tr("Select a mesh that was made from a recording: how good it is, and why, stands here. "
           "One that was edited, opened from a file or restored has no verdict; reconstruct its "
           "recording for one."));
    return;
  }
  const std::size_t first = most_important(quality->verdict);
  const auto& sentences = quality->verdict.sentences;
  QString headline = light_text(quality->verdict), html;
  if (!sentences.empty())
    headline += QString("&nbsp;&nbsp;&nbsp;<span style=\"font-size:large\">%1</span>")
                    .arg(figure_of(sentences[first]));
  light_->setText(headline);
  light_->setStyleSheet(
      QString("background:%1; color:#101010; font-weight:bold; padding:6px 10px; border-radius:4px")
          .arg(color_of(quality->verdict.level()).name()));
  for (std::size_t i = 0; i < sentences.size(); ++i)
    if (i != first) html += sentence_html(sentences[i]);
  first_->show_text(sentences.empty() ? QString() : sentence_html(sentences[first]));
  others_->show_text(html);
}

QString VerdictPanel::color_way() const { return colors_->currentData().toString(); }

QString VerdictPanel::text() const {
  if (!quality_) return first_->text();
  QString out = light_text(quality_->verdict);
  for (const VerdictSentence& sentence : quality_->verdict.sentences)
    out += "\n" + QString::fromStdString(sentence.text);
  return out;
}

}  // namespace turnscan::studio
