#include "window/job_bar.hpp"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <cmath>

#include "app/jobs.hpp"

namespace turnscan::studio {

namespace {

QString time_left(double seconds) {
  if (seconds < 0.0) return {};
  const int s = static_cast<int>(std::ceil(std::min(seconds, 1e6)));
  if (s < 60) return QObject::tr("%1 s left").arg(s);
  return QObject::tr("%1 min %2 s left").arg(s / 60).arg(s % 60);
}

}  // namespace

JobBar::JobBar(JobRunner& jobs, QWidget* parent)
    : QWidget(parent),
      jobs_(jobs),
      text_(new QLabel(this)),
      bar_(new QProgressBar(this)),
      left_(new QLabel(this)),
      cancel_(new QToolButton(this)) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 2, 6, 2);
  layout->setSpacing(8);
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setFixedWidth(200);
  bar_->setObjectName("job_progress");
  bar_->setAccessibleName(tr("Progress of the running job"));
  cancel_->setText(tr("Cancel"));
  cancel_->setObjectName("tool");
  cancel_->setToolTip(tr("Stop the running job (Esc)"));
  left_->setMinimumWidth(90);
  for (QWidget* part : std::initializer_list<QWidget*>{text_, bar_, left_, cancel_})
    layout->addWidget(part);
  setVisible(false);
  connect(cancel_, &QToolButton::clicked, this, [this] { jobs_.cancel(); });
  connect(&jobs_, &JobRunner::started, this, [this](const QString& title) {
    title_ = title;
    show_progress({}, 0.0, -1.0);
    setVisible(true);
  });
  connect(&jobs_, &JobRunner::progress, this, &JobBar::show_progress);
  connect(&jobs_, &JobRunner::finished, this, [this] { setVisible(jobs_.busy()); });
}

void JobBar::show_progress(const QString& phase, double fraction, double seconds_left) {
  text_->setText(phase.isEmpty() ? title_ : QString("%1: %2").arg(title_, phase));
  // A phase of unknown length says only that it runs.
  bar_->setRange(0, fraction > 0.0 ? 1000 : 0);
  bar_->setValue(static_cast<int>(1000.0 * fraction));
  left_->setText(time_left(seconds_left));
}

}  // namespace turnscan::studio
