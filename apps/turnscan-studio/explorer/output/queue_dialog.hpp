#pragma once
// Reconstructs several recordings one after the other, unattended.

#include <QDialog>
#include <QStringList>

class QLineEdit;
class QPushButton;
class QTableWidget;

namespace turnscan::studio {

class ExplorerMode;
class JobRunner;

class QueueDialog : public QDialog {
  Q_OBJECT
 public:
  QueueDialog(ExplorerMode& mode, JobRunner& jobs, QWidget* parent = nullptr);

  /// Adds folders of recordings, or files that `turnscan import` reads; skips those already in the
  /// list.
  void add(const QStringList& recordings);
  /// Queues all waiting recordings. A failure does not affect the others.
  void start();

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QWidget* make_buttons();
  void remove_selected();
  void set_state(const QString& recording, const QString& state, const QString& text);
  int row_of(const QString& recording) const;
  QString state_of(int row) const;
  void follow();

  ExplorerMode& mode_;
  QTableWidget* table_;
  QLineEdit* folder_;
  QPushButton *start_, *remove_;
};

}  // namespace turnscan::studio
