#pragma once
// Runs long jobs on a separate thread, one after the other. The window never waits for it.

#include <QElapsedTimer>
#include <QObject>
#include <QStringList>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <turnscan/core/run_context.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>

namespace turnscan::studio {

/// The part of a job that runs on the window's thread afterwards.
using Finish = std::function<void()>;
/// Runs on the worker thread. It must not touch a widget; the Finish that it returns may.
using Work = std::function<Result<Finish>(const RunContext&)>;
/// Called on the window's thread if the work failed, unless it was cancelled.
using OnError = std::function<void(const QString& text)>;

class JobRunner : public QObject {
  Q_OBJECT
 public:
  explicit JobRunner(QObject* parent = nullptr);
  /// Cancels everything and waits for it; no callback is called any more.
  ~JobRunner() override;

  /// Queues a job. `owner` may be destroyed meanwhile: then neither Finish nor OnError is called.
  /// With a plan, progress is that of the whole job. Does nothing while a job of the same key, if
  /// that is not empty, waits or runs: a button pressed again.
  void start(const QString& title, QObject* owner, Work work, OnError on_error, PhasePlan plan = {},
             const QString& key = {});
  /// Cancels the running job and the queued ones.
  void cancel();
  bool busy() const { return !open_.empty(); }
  /// Titles of the jobs that wait, the next one first.
  QStringList waiting() const;

 Q_SIGNALS:
  void started(const QString& title);
  void queued();
  /// fraction, 0 to 1, and seconds_left are those of the whole job if it has a plan, else of the
  /// phase; negative: not known yet.
  void progress(const QString& phase, double fraction, double seconds_left);
  /// The title of the job, and whether its result was used.
  void finished(const QString& title, bool good);
  /// Emitted before OnError and finished(), if a job was cancelled.
  void cancelled(const QString& title);
  /// The same, if it failed.
  void failed(const QString& title);

 private:
  struct Job;
  void run();
  void run_job(const std::shared_ptr<Job>& job);
  void watch(Job& job);
  void end(const std::shared_ptr<Job>& job, Result<Finish> result);

  std::mutex mutex_;  // guards the following members
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Job>> waiting_;
  std::shared_ptr<Job> running_;
  bool stop_ = false;

  std::deque<std::shared_ptr<Job>> open_;  ///< the running one first; window's thread only
  std::thread thread_;
};

}  // namespace turnscan::studio
