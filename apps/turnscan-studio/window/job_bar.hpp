#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;

namespace turnscan::studio {

class JobRunner;

/// Shows the running job in the status line: phase, progress, remaining time (or elapsed time if
/// that is not known), how many wait, Cancel.
class JobBar : public QWidget {
  Q_OBJECT
 public:
  explicit JobBar(JobRunner& jobs, QWidget* parent = nullptr);

 private:
  void show_progress(const QString& phase, double fraction, double seconds_left);
  void show_elapsed();
  void show_waiting();

  JobRunner& jobs_;
  QLabel* text_;
  QProgressBar* bar_;
  QLabel *left_, *waiting_;
  QToolButton* cancel_;
  QString title_;
  QElapsedTimer since_;
  QTimer each_second_;
  bool left_known_ = false;
};

}  // namespace turnscan::studio
