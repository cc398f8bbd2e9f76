#pragma once
// Long work on a thread of its own, one job after the other. The window never waits for it.

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <turnscan/core/run_context.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>

namespace turnscan::studio {

/// What a job leaves to be done on the thread of the window.
using Finish = std::function<void()>;
/// Runs on the worker's thread. It must not touch a widget; what it returns does.
using Work = std::function<Result<Finish>(const RunContext&)>;
/// Called on the thread of the window when the work failed, unless it was cancelled.
using OnError = std::function<void(const QString& text)>;

class JobRunner : public QObject {
  Q_OBJECT
 public:
  explicit JobRunner(QObject* parent = nullptr);
  /// Cancels everything and waits for it; nothing of it reaches the window any more.
  ~JobRunner() override;

  /// Queues a job. `owner` may be destroyed meanwhile: then neither Finish nor OnError is called.
  /// With a plan, progress is that of the whole job.
  void start(const QString& title, QObject* owner, Work work, OnError on_error,
             PhasePlan plan = {});
  /// Cancels the running job and those that wait.
  void cancel();
  bool busy() const { return open_jobs_ > 0; }

 Q_SIGNALS:
  void started(const QString& title);
  /// fraction, 0 to 1, and seconds_left, of the whole job where it has a plan, else of the phase;
  /// negative: not known yet.
  void progress(const QString& phase, double fraction, double seconds_left);
  /// The title of the job, and whether its result was used.
  void finished(const QString& title, bool good);
  /// Before OnError and finished(), of a job that was cancelled.
  void cancelled(const QString& title);
  /// The same, of one that failed.
  void failed(const QString& title);

 private:
  struct Job;
  void run();
  void run_job(const std::shared_ptr<Job>& job);
  void watch(Job& job);
  void end(const std::shared_ptr<Job>& job, Result<Finish> result);

  std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::deque<std::shared_ptr<Job>> waiting_;
  std::shared_ptr<Job> running_;
  bool stop_ = false;

  int open_jobs_ = 0;  // thread of the window only
  std::thread thread_;
};

}  // namespace turnscan::studio
