#pragma once

#include <QMainWindow>
#include <functional>
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

/// The main window: three modes, one of them visible, with the menus and the status of the running
/// job.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  MainWindow();
  ~MainWindow() override;

  void open(const QString& path);
  void show_mode(const QString& name);  ///< "scanner", "explorer" or "simulator"
  void screenshot(const QString& path);
  /// Shows a text in the status bar and adds it to the messages.
  void say(const QString& text);

  /// Asks for confirmation before the window closes with something at stake, one line each; true:
  /// close. A dialog, unless a test answers.
  using CloseQuestion = std::function<bool(const QStringList& at_stake)>;
  void set_close_question(CloseQuestion question) { ask_to_close_ = std::move(question); }
  /// Offers to restore a session that did not end properly, if there is one.
  void offer_lost_session();
  /// Offers to go on with a recording that did not end properly, if there is one.
  void offer_unfinished_recording();

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
  QStringList at_stake() const;

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
  CloseQuestion ask_to_close_;
};

}  // namespace turnscan::studio
