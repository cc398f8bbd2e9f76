#include "simulator/sweep_panel.hpp"

#include <QComboBox>
#include <QGridLayout>
#include <QLineEdit>
#include <QPainter>
#include <QPushButton>
#include <QRegularExpression>
#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/page/svg_plot.hpp>

#include "app/jobs.hpp"
#include "widgets/no_wheel.hpp"
#include "widgets/section.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

/// The covered share over the values, with the largest marked.
class SweepPlot : public QWidget {
 public:
  using QWidget::QWidget;
  void show_values(std::vector<QPointF> values, const QString& unit) {
    values_ = std::move(values);
    unit_ = unit;
    update();
  }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override;

 private:
  std::vector<QPointF> values_;  ///< in the shown unit, and percent; ascending
  QString unit_;
};

void SweepPlot::paintEvent(QPaintEvent* /*event*/) {
  if (values_.empty()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const auto by_cover = [](const QPointF& a, const QPointF& b) { return a.y() < b.y(); };
  const auto [low, high] = std::minmax_element(values_.begin(), values_.end(), by_cover);
  const auto y_ticks = page::ticks(std::floor(low->y()), std::floor(high->y()) + 1.0, 4);
  const double left = values_.front().x(), right = std::max(values_.back().x(), left + 1e-9);
  const QFontMetrics metrics = painter.fontMetrics();
  const QRectF area(metrics.horizontalAdvance("100.0 %") + 8, 8,
                    width() - metrics.horizontalAdvance("100.0 %") - 24,
                    height() - 2 * metrics.height() - 8);
  const auto at = [&](double x, double y) {
    return QPointF(
        area.left() + area.width() * (x - left) / (right - left),
        area.bottom() - area.height() * (y - y_ticks.front()) / (y_ticks.back() - y_ticks.front()));
  };
  const QColor text = palette().color(QPalette::WindowText);
  QColor grid = text;
  grid.setAlphaF(0.2);
  for (const double y : y_ticks) {
    painter.setPen(grid);
    painter.drawLine(at(left, y), at(right, y));
    painter.setPen(text);
    painter.drawText(
        QRectF(0, at(left, y).y() - metrics.height(), area.left() - 6, 2 * metrics.height()),
        Qt::AlignRight | Qt::AlignVCenter, QString("%1 %").arg(y));
  }
  for (const double x : page::ticks(left, right, 5)) {
    if (x < left - 1e-9 || x > right + 1e-9) continue;
    painter.drawText(QRectF(at(x, 0).x() - 40, area.bottom() + 4, 80, metrics.height()),
                     Qt::AlignCenter, QString("%1 %2").arg(x).arg(unit_));
  }
  const QColor accent = palette().color(QPalette::Highlight);
  QPolygonF line;
  for (const QPointF& value : values_) line << at(value.x(), value.y());
  painter.setPen(QPen(accent, 2.0));
  painter.drawPolyline(line);
  painter.setBrush(accent);
  painter.drawEllipse(at(high->x(), high->y()), 5.0, 5.0);
}

SweepPanel::SweepPanel(JobRunner& jobs, Scene scene, const CoverageMapOptions& coverage,
                       QWidget* parent)
    : QWidget(parent),
      jobs_(jobs),
      scene_(std::move(scene)),
      coverage_(coverage),
      option_(new QComboBox(this)),
      values_(new QLineEdit("-45..45/15", this)),
      run_(button(tr("Sweep"), tr("Find the coverage with each of the values"), this)),
      use_(button(tr("Use the best"), tr("Place the scanner where it covers most"), this)),
      plot_(new SweepPlot(this)),
      best_(quiet_label({}, this)),
      error_(new MessageLabel(this)) {
  option_->setObjectName("sweep_option");
  option_->setAccessibleName(tr("Option to sweep"));
  leave_wheel_to_panel(option_);
  for (const char* name : {"roll", "pan", "tilt", "elevation", "azimuth"})
    option_->addItem(translated_title(name), QString(name));
  values_->setObjectName("sweep_values");
  values_->setAccessibleName(tr("Values: from..to/step"));
  values_->setToolTip(tr("From, to and step in degrees, e.g. -45..45/15"));
  plot_->setFixedHeight(190);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  grid->addWidget(option_, 0, 0, 1, 2);
  grid->addWidget(values_, 1, 0, 1, 2);
  grid->addWidget(run_, 1, 2);
  grid->addWidget(error_, 2, 0, 1, 3);
  grid->addWidget(plot_, 3, 0, 1, 3);
  grid->addWidget(best_, 4, 0, 1, 2);
  grid->addWidget(use_, 4, 2);
  for (QWidget* each : {static_cast<QWidget*>(plot_), static_cast<QWidget*>(use_)})
    each->setVisible(false);
  connect(run_, &QPushButton::clicked, this, &SweepPanel::run);
  connect(use_, &QPushButton::clicked, this, [this] {
    Q_EMIT best_wanted(range_.option, format_quantity(best_of(swept_).value, range_.quantity));
  });
}

void SweepPanel::run() {
  static const QRegularExpression form(R"(^\s*(\S+)\s*\.\.\s*([^/\s]+)\s*/\s*(\S+)\s*$)");
  const auto typed = form.match(values_->text());
  if (!typed.hasMatch())
    return error_->show_text(
        tr("'%1' is not from..to/step in degrees, e.g. -45..45/15").arg(values_->text()));
  QString text = option_->currentData().toString() + "=";
  for (int i = 1; i <= 3; ++i) {
    const QString value = typed.captured(i);
    const bool plain = parse_number(value.toStdString()).has_value();
    text += value + (plain ? "deg" : "") + (i == 1 ? ".." : i == 2 ? "/" : "");
  }
  auto scene = scene_();
  const auto range = scene.and_then(
      [&](const SceneDescription& made) { return parse_sweep_range(text.toStdString(), made); });
  error_->show_text(range ? QString() : QString::fromStdString(range.error().text()));
  if (!range) return;
  jobs_.start(
      tr("Sweep"), this,
      [this, scene = *scene, range = *range,
       coverage = coverage_](const RunContext& context) -> Result<Finish> {
        TURNSCAN_ASSIGN(auto swept, sweep_coverage(scene, range, coverage, context));
        return Finish([this, range, swept = std::move(swept)] { show_swept(range, swept); });
      },
      [this](const QString& problem) { error_->show_text(problem); });
}

void SweepPanel::show_swept(const SweepRange& range, std::vector<SweptCoverage> swept) {
  range_ = range;
  swept_ = std::move(swept);
  std::vector<QPointF> values;
  for (const SweptCoverage& s : swept_)
    values.emplace_back(s.value / kRadiansPerDegree, 100.0 * s.covered);
  plot_->show_values(std::move(values), "°");
  const SweptCoverage& best = best_of(swept_);
  best_->setText(tr("%1 at %2 covers most: %3 % of the surface")
                     .arg(translated_title(range_.option),
                          QString::fromStdString(format_quantity(best.value, range_.quantity)))
                     .arg(100.0 * best.covered, 0, 'f', 1));
  for (QWidget* each : {static_cast<QWidget*>(plot_), static_cast<QWidget*>(use_)})
    each->setVisible(true);
}

}  // namespace turnscan::studio
