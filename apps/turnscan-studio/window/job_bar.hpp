#pragma once

#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;

namespace turnscan::studio {

class JobRunner;

/// Shows the running job in the status line: phase, progress, time left, Cancel.
class JobBar : public QWidget {
  Q_OBJECT
 public:
  explicit JobBar(JobRunner& jobs, QWidget* parent = nullptr);

 private:
  void show_progress(const QString& phase, double fraction, double seconds_left);

  JobRunner& jobs_;
  QLabel* text_;
  QProgressBar* bar_;
  QLabel* left_;
  QToolButton* cancel_;
  QString title_;
};

}  // namespace turnscan::studio
