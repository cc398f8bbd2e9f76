#pragma once
// What the three modes have in common: a view on the left, a panel on the right.

#include <QWidget>
#include <initializer_list>

#include "app/another_side.hpp"

class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace turnscan::studio {

class JobRunner;
class SceneView;
class ViewSettings;

/// What a mode gets from the window.
struct Services {
  JobRunner& jobs;
  ViewSettings& settings;
};

class Mode : public QWidget {
  Q_OBJECT
 public:
  Mode(const Services& services, QWidget* parent);

  SceneView& view() const { return *view_; }
  /// Whether files dropped on the window are for this mode.
  virtual bool open_file(const QString& /*path*/) { return false; }
  virtual void undo() {}
  virtual void redo() {}
  /// What undo and redo would take back and bring back; empty: nothing.
  virtual QString undo_text() const { return {}; }
  virtual QString redo_text() const { return {}; }
  virtual void save() {}
  virtual void remove_selected() {}
  /// The window closes: what must not be lost is brought to an end.
  virtual void shut_down() {}

 Q_SIGNALS:
  /// One line for the status bar and the messages: what has happened.
  void status(const QString& text);
  /// One line for the status bar: what is selected.
  void described(const QString& text);
  /// undo_text() or redo_text() is another one.
  void undo_changed();
  /// Another mode is where it goes on; see MainWindow::show_mode().
  void mode_wanted(const QString& name);
  /// A recording for the Explorer; with `reconstruct` it goes on to a mesh.
  void recording_made(const QString& folder, bool reconstruct);
  /// One that a fault has ended: the Explorer has it, but the reason stands in this mode.
  void recording_broken_off(const QString& folder);
  /// The Scanner is to add a pass to a recording.
  void another_side_wanted(const AnotherSide& side);

 protected:
  JobRunner& jobs() const { return services_.jobs; }
  ViewSettings& settings() const { return services_.settings; }
  /// Sections go here.
  QVBoxLayout* panel() const { return body_; }
  /// What stays in sight below the sections, from above: errors, progress, the main action. The
  /// action comes last, so that a longer text does not move it.
  void set_footer(std::initializer_list<QWidget*> parts);
  /// Scrolls the panel so that a part of it is seen.
  void reveal(QWidget* part);

 private:
  Services services_;
  SceneView* view_;
  QScrollArea* area_;
  QVBoxLayout* body_;
  QVBoxLayout* footer_;
};

}  // namespace turnscan::studio
