#pragma once
// Common base of the three modes: a view on the left, a panel on the right.

#include <QWidget>
#include <initializer_list>

#include "app/another_side.hpp"
#include "view/drawable.hpp"

class QLabel;
class QScrollArea;
class QSplitter;
class QTabWidget;
class QVBoxLayout;

namespace turnscan::studio {

class JobRunner;
class SceneView;
class ViewSettings;

/// What the window provides to a mode.
struct Services {
  JobRunner& jobs;
  ViewSettings& settings;
};

class Mode : public QWidget {
  Q_OBJECT
 public:
  Mode(const Services& services, QWidget* parent);

  SceneView& view() const { return *view_; }
  /// Whether the mode accepts a file dropped on the window; if so, it opens it.
  virtual bool open_file(const QString& /*path*/) { return false; }
  virtual void undo() {}
  virtual void redo() {}
  /// What undo and redo would revert and restore; empty: nothing.
  virtual QString undo_text() const { return {}; }
  virtual QString redo_text() const { return {}; }
  virtual void save() {}
  virtual void remove_selected() {}
  /// Called when the window closes: finishes what must not be lost.
  virtual void shut_down() {}

 Q_SIGNALS:
  /// One line for the status bar and the messages: what happened.
  void status(const QString& text);
  /// One line for the status bar: what is selected.
  void described(const QString& text);
  /// undo_text() or redo_text() has changed.
  void undo_changed();
  /// Asks to switch to another mode; see MainWindow::show_mode().
  void mode_wanted(const QString& name);
  /// The surface, table frame, that grew with the recording that follows: shown until its mesh is.
  void surface_left(const DrawablePtr& surface);
  /// Asks for the Scanner, which is to play.
  void scan_wanted();
  /// A recording for the Explorer; with `reconstruct` it is also reconstructed.
  void recording_made(const QString& folder, bool reconstruct);
  /// A recording ended by a fault: the Explorer gets it, but the reason is shown in this mode.
  void recording_broken_off(const QString& folder);
  /// Asks the Scanner to add a pass to a recording.
  void another_side_wanted(const AnotherSide& side);

 protected:
  JobRunner& jobs() const { return services_.jobs; }
  ViewSettings& settings() const { return services_.settings; }
  /// Layout for sections.
  QVBoxLayout* panel() const { return body_; }
  /// The same of a tab; the panel then has nothing but tabs.
  QVBoxLayout* add_tab(const QString& title);
  /// The controls that all modes share, which a mode may move.
  QWidget* view_panel() const { return view_panel_; }
  /// A widget to the left of the view.
  void set_tree(QWidget* tree);
  /// Widgets that stay visible below the sections, from top to bottom: errors, progress, the main
  /// action. The action comes last, so that a longer text does not move it.
  void set_footer(std::initializer_list<QWidget*> parts);
  /// Shows the tab of a part of the panel, and scrolls there.
  void reveal(QWidget* part);

 private:
  Services services_;
  SceneView* view_;
  QSplitter* split_;
  QWidget* view_panel_;
  QScrollArea* area_;
  QTabWidget* tabs_ = nullptr;  ///< in place of the area
  QVBoxLayout *column_, *body_, *footer_;
};

}  // namespace turnscan::studio
