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
      waiting_(new QLabel(this)),
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
  waiting_->setObjectName("jobs_waiting");
  for (QWidget* part : std::initializer_list<QWidget*>{text_, bar_, left_, waiting_, cancel_})
    layout->addWidget(part);
  setVisible(false);
  each_second_.setInterval(1000);
  connect(&each_second_, &QTimer::timeout, this, &JobBar::show_elapsed);
  connect(cancel_, &QToolButton::clicked, this, [this] { jobs_.cancel(); });
  connect(&jobs_, &JobRunner::started, this, [this](const QString& title) {
    title_ = title;
    since_.start();
    show_waiting();
    each_second_.start();
    show_progress({}, 0.0, -1.0);
    setVisible(true);
  });
  connect(&jobs_, &JobRunner::progress, this, &JobBar::show_progress);
  connect(&jobs_, &JobRunner::queued, this, &JobBar::show_waiting);
  connect(&jobs_, &JobRunner::finished, this, [this] {
    setVisible(jobs_.busy());
    if (!jobs_.busy()) each_second_.stop();
  });
}

void JobBar::show_waiting() {
  const QStringList waiting = jobs_.waiting();
  waiting_->setText(waiting.isEmpty() ? QString() : tr("%1 more").arg(waiting.size()));
  waiting_->setToolTip(tr("Next:") + "\n" + waiting.join("\n"));
}

void JobBar::show_progress(const QString& phase, double fraction, double seconds_left) {
  text_->setText(phase.isEmpty() ? title_ : QString("%1: %2").arg(title_, phase));
  bar_->setValue(static_cast<int>(1000.0 * fraction));
  left_known_ = seconds_left >= 0.0;
  if (left_known_) {
    left_->setText(time_left(seconds_left));
  } else {
    show_elapsed();
  }
}

/// A job of unknown length shows its elapsed seconds. A constantly moving bar would recompose the
/// whole window 30 times a second, which costs a software renderer a third of a processor.
void JobBar::show_elapsed() {
  if (left_known_) return;
  const auto seconds = since_.elapsed() / 1000;
  left_->setText(seconds > 0 ? tr("%1 s so far").arg(seconds) : QString());
}

}  // namespace turnscan::studio
