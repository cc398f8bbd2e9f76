#include "app/jobs.hpp"

#include <QPointer>
#include <algorithm>
#include <chrono>
#include <turnscan/core/process/thread_priority.hpp>

namespace turnscan::studio {

struct JobRunner::Job {
  QString title;
  QPointer<QObject> owner;  // accessed on the window's thread only
  Work work;
  OnError on_error;
  PhasePlan plan;
  QString key;
  RunContext context;
};

JobRunner::JobRunner(QObject* parent)
    : QObject(parent), thread_([this] {
        process::lower_thread_priority();  // keeps the window responsive, whatever a job uses
        run();
      }) {}

JobRunner::~JobRunner() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  cancel();
  wake_.notify_all();
  thread_.join();
}

void JobRunner::start(const QString& title, QObject* owner, Work work, OnError on_error,
                      PhasePlan plan, const QString& key) {
  if (!key.isEmpty() &&
      std::any_of(open_.begin(), open_.end(), [&](const auto& job) { return job->key == key; }))
    return;
  auto job = std::make_shared<Job>();
  job->title = title;
  job->owner = owner;
  job->work = std::move(work);
  job->on_error = std::move(on_error);
  job->plan = std::move(plan);
  job->key = key;
  open_.push_back(job);
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(job));
  }
  wake_.notify_all();
  Q_EMIT queued();
}

QStringList JobRunner::waiting() const {
  QStringList titles;
  for (std::size_t i = 1; i < open_.size(); ++i) titles << open_[i]->title;
  return titles;
}

void JobRunner::cancel() {
  const std::lock_guard lock(mutex_);
  if (running_) running_->context.cancel();
  for (const auto& job : waiting_) job->context.cancel();
}

void JobRunner::run() {
  for (;;) {
    std::shared_ptr<Job> job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      job = waiting_.front();
      waiting_.pop_front();
      running_ = job;
    }
    run_job(job);
    const std::lock_guard lock(mutex_);
    running_.reset();
  }
}

void JobRunner::run_job(const std::shared_ptr<Job>& job) {
  watch(*job);
  QMetaObject::invokeMethod(
      this, [this, job] { Q_EMIT started(job->title); }, Qt::QueuedConnection);
  Result<Finish> result = fail(ErrorCode::kCancelled, "cancelled");
  if (!job->context.cancelled()) {
    try {
      result = job->work(job->context);
    } catch (const std::exception& failure) {
      // Memory may run out, and files may cause unforeseen exceptions; the window must survive.
      result = fail(ErrorCode::kLibrary, "{}", failure.what());
    }
  }
  // The work may hold much memory, which must not be released on the window's thread.
  job->work = nullptr;
  auto shared = std::make_shared<Result<Finish>>(std::move(result));
  QMetaObject::invokeMethod(
      this, [this, job, shared] { end(job, std::move(*shared)); }, Qt::QueuedConnection);
}

void JobRunner::watch(Job& job) {
  using Clock = std::chrono::steady_clock;
  struct State {
    OverallProgress overall;
    int number = 0;
    Clock::time_point begin = Clock::now();
  };
  State state;
  const bool planned = !job.plan.empty();
  state.overall.plan(job.plan);
  job.context.set_listener([this, planned, state](const Progress& now) mutable {
    const auto seconds = [](Clock::duration time) {
      return std::chrono::duration<double>(time).count();
    };
    double fraction = now.fraction, left = -1.0;
    if (planned) {
      state.overall.update(now, seconds(Clock::now() - state.begin));
      fraction = state.overall.fraction().value_or(0.0);
      left = state.overall.seconds_left().value_or(-1.0);
    } else {
      if (now.phase_number != state.number) state.begin = Clock::now();
      state.number = now.phase_number;
      const double passed = seconds(Clock::now() - state.begin);
      if (fraction > 0.02 && passed > 0.5) left = passed * (1.0 / fraction - 1.0);
    }
    const QString name = QString::fromStdString(now.phase);
    QMetaObject::invokeMethod(
        this, [this, name, fraction, left] { Q_EMIT progress(name, fraction, left); },
        Qt::QueuedConnection);
  });
}

void JobRunner::end(const std::shared_ptr<Job>& job, Result<Finish> result) {
  open_.pop_front();  // they end in their order
  // Emitted before the error itself, which may be shown in the same line.
  if (!result && result.error().code == ErrorCode::kCancelled) {
    Q_EMIT cancelled(job->title);
  } else if (!result) {
    Q_EMIT failed(job->title);
  }
  if (job->owner) {
    if (result && *result) (*result)();
    if (!result && result.error().code != ErrorCode::kCancelled && job->on_error)
      job->on_error(QString::fromStdString(result.error().text()));
  }
  Q_EMIT finished(job->title, result.has_value());
}

}  // namespace turnscan::studio
