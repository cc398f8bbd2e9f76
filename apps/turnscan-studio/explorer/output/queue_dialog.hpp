#pragma once
// Several recordings, reconstructed one after the other while nobody looks.

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

  /// Folders of recordings, or files that `turnscan import` reads; those that are there already
  /// are left out.
  void add(const QStringList& recordings);
  /// Queues all that wait. One that fails does not keep the others back.
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
