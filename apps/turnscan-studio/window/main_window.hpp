#pragma once

#include <QMainWindow>
#include <memory>
#include <vector>

#include "window/main_menu.hpp"

class QLabel;
class QStackedWidget;
class QToolButton;

namespace turnscan::studio {

class ExplorerMode;
class JobRunner;
class Mode;
class ScannerMode;
class SimulatorMode;
class ViewSettings;

/// The three modes, one of them shown, with the menus and the line of the running job.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  MainWindow();
  ~MainWindow() override;

  void open(const QString& path);
  void show_mode(const QString& name);  ///< "scanner", "explorer" or "simulator"
  void screenshot(const QString& path);

  JobRunner& jobs() { return *jobs_; }
  ViewSettings& settings() { return *settings_; }
  ExplorerMode& explorer() { return *explorer_; }
  ScannerMode& scanner() { return *scanner_; }
  SimulatorMode& simulator() { return *simulator_; }
  Mode& mode() const;

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  void add_mode(const QString& name, const QString& title, const QString& tip, Mode* mode);
  QWidget* make_top_bar();
  void add_recent(const QString& path);
  void fill_recent();
  void apply_settings();
  void update_undo();
  void restore_window();

  JobRunner* jobs_;
  ViewSettings* settings_;
  QStackedWidget* stack_;
  QWidget* mode_bar_;
  ScannerMode* scanner_;
  ExplorerMode* explorer_;
  SimulatorMode* simulator_;
  std::vector<std::pair<QString, QToolButton*>> mode_buttons_;
  QLabel* status_;
  MainMenu menu_;
};

}  // namespace turnscan::studio
