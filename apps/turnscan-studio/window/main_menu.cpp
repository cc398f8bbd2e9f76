#include "window/main_menu.hpp"

#include <QAction>
#include <QActionGroup>
#include <QFileDialog>
#include <QKeySequence>
#include <QMenu>
#include <QMenuBar>
#include <functional>
#include <vector>

#include "app/jobs.hpp"
#include "app/language.hpp"
#include "app/mode.hpp"
#include "app/paths.hpp"
#include "explorer/explorer.hpp"
#include "explorer/output/queue_dialog.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "window/help.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {

namespace {

struct MenuEntry {
  QString title;  ///< empty: a separator
  std::function<void(MainWindow&)> run;
  QKeySequence keys;
};

/// Returns the actions of the entries except separators.
std::vector<QAction*> add_entries(MainWindow& window, QMenu& menu,
                                  const std::vector<MenuEntry>& entries) {
  std::vector<QAction*> actions;
  for (const MenuEntry& entry : entries) {
    if (entry.title.isEmpty()) {
      menu.addSeparator();
      continue;
    }
    actions.push_back(menu.addAction(
        entry.title, &window, [&window, run = entry.run] { run(window); }, entry.keys));
  }
  return actions;
}

void open_files(MainWindow& window) {
  window.show_mode("explorer");
  window.explorer().open_dialog();
}

void open_recording(MainWindow& window) {
  const QString folder =
      QFileDialog::getExistingDirectory(&window, MainWindow::tr("Open a recording"));
  if (!folder.isEmpty()) window.open(folder);
}

void save_all(MainWindow& window) {
  if (window.explorer().store().unsaved().isEmpty())
    return window.say(MainWindow::tr("All models are in files"));
  const QString folder =
      QFileDialog::getExistingDirectory(&window, MainWindow::tr("Folder for all models"));
  if (!folder.isEmpty()) window.explorer().save_all(folder);
}

void save_screenshot(MainWindow& window) {
  const QString path = ask_save_path(&window, MainWindow::tr("Save screenshot"), "view.png",
                                     MainWindow::tr("Pictures (*.png)"));
  if (!path.isEmpty()) window.screenshot(path);
}

void toggle_boxes(MainWindow& window) { window.settings().set_boxes(!window.settings().boxes()); }

void show_queue(MainWindow& window) {
  auto* open = window.findChild<QueueDialog*>();
  if (!open) open = new QueueDialog(window.explorer(), window.jobs(), &window);
  open->show();
  open->raise();
}

MenuEntry standard_view(const QString& title, StandardView from, int key) {
  return {title, [from](MainWindow& w) { w.mode().view().look(from); }, QKeySequence(key)};
}

QMenu* add_menu(MainWindow& window, const QString& title) {
  return window.menuBar()->addMenu(title);
}

/// Returns the menu of recent files.
QMenu* add_file_menu(MainWindow& window) {
  QMenu* menu = add_menu(window, MainWindow::tr("&File"));
  add_entries(window, *menu,
              {{MainWindow::tr("&Open…"), open_files, QKeySequence::Open},
               {MainWindow::tr("Open &recording…"), open_recording, QKeySequence("Ctrl+Shift+O")}});
  QMenu* recent = menu->addMenu(MainWindow::tr("Open r&ecent"));
  add_entries(
      window, *menu,
      {{MainWindow::tr("&Save…"), [](MainWindow& w) { w.mode().save(); }, QKeySequence::Save},
       {MainWindow::tr("Save &all…"), save_all, QKeySequence("Ctrl+Shift+S")},
       {MainWindow::tr("&Export…"),
        [](MainWindow& w) {
          w.show_mode("explorer");
          w.explorer().export_dialog();
        },
        QKeySequence("Ctrl+E")},
       {},
       {MainWindow::tr("Reconstruct se&veral recordings…"), show_queue,
        QKeySequence("Ctrl+Shift+R")},
       {MainWindow::tr("Save s&creenshot…"), save_screenshot, QKeySequence("Ctrl+P")},
       {},
       {MainWindow::tr("&Quit"), [](MainWindow& w) { w.close(); }, QKeySequence::Quit}});
  return recent;
}

/// Returns its actions; the first two are undo and redo.
std::vector<QAction*> add_edit_menu(MainWindow& window) {
  return add_entries(
      window, *add_menu(window, MainWindow::tr("&Edit")),
      {{MainWindow::tr("Undo"), [](MainWindow& w) { w.mode().undo(); }, QKeySequence::Undo},
       {MainWindow::tr("Redo"), [](MainWindow& w) { w.mode().redo(); },
        QKeySequence("Ctrl+Shift+Z")},
       {MainWindow::tr("Delete"), [](MainWindow& w) { w.mode().remove_selected(); },
        QKeySequence::Delete},
       {},
       {MainWindow::tr("Cancel the running job"), [](MainWindow& w) { w.jobs().cancel(); },
        QKeySequence(Qt::Key_Escape)}});
}

/// Widgets keep the texts that they were created with: a choice takes effect at the next start.
void add_language_menu(MainWindow& window, QMenu& menu) {
  QMenu* made = menu.addMenu(MainWindow::tr("&Language"));
  auto* group = new QActionGroup(made);
  const auto add = [&](const QString& name, const QString& code) {
    QAction* action = made->addAction(name, &window, [&window, code] {
      choose_language(code);
      window.say(MainWindow::tr("The language changes with the next start"));
    });
    action->setCheckable(true);
    action->setChecked(code == chosen_language());
    action->setActionGroup(group);
  };
  add(MainWindow::tr("As the system"), {});
  for (const Language& each : languages()) add(each.name, each.code);
}

/// Returns the action of the dark theme.
QAction* add_view_menu(MainWindow& window) {
  QMenu* menu = add_menu(window, MainWindow::tr("&View"));
  add_entries(window, *menu,
              {{MainWindow::tr("Reset camera"),
                [](MainWindow& w) { w.mode().view().reset_camera(); }, QKeySequence(Qt::Key_Home)},
               standard_view(MainWindow::tr("Front"), StandardView::kFront, Qt::Key_1),
               standard_view(MainWindow::tr("Back"), StandardView::kBack, Qt::Key_2),
               standard_view(MainWindow::tr("Left"), StandardView::kLeft, Qt::Key_3),
               standard_view(MainWindow::tr("Right"), StandardView::kRight, Qt::Key_4),
               standard_view(MainWindow::tr("Top"), StandardView::kTop, Qt::Key_5),
               standard_view(MainWindow::tr("Bottom"), StandardView::kBottom, Qt::Key_6),
               standard_view(MainWindow::tr("Corner"), StandardView::kCorner, Qt::Key_7),
               {},
               {MainWindow::tr("Bounding boxes"), toggle_boxes, QKeySequence(Qt::Key_B)}});
  QAction* dark = menu->addAction(MainWindow::tr("Dark"), &window.settings(),
                                  &ViewSettings::set_dark, QKeySequence("Ctrl+Shift+D"));
  dark->setCheckable(true);
  add_language_menu(window, *menu);
  return dark;
}

}  // namespace

MainMenu make_main_menu(MainWindow& window) {
  MainMenu out;
  out.recent = add_file_menu(window);
  const auto edits = add_edit_menu(window);
  out.undo = edits[0];
  out.redo = edits[1];
  out.dark = add_view_menu(window);
  add_entries(window, *add_menu(window, MainWindow::tr("&Help")),
              {{MainWindow::tr("&Manual"), show_manual, QKeySequence("Ctrl+F1")},
               {MainWindow::tr("&Keyboard shortcuts"), show_keys, QKeySequence("?")},
               {MainWindow::tr("Messages"), show_messages, QKeySequence("Ctrl+L")},
               {MainWindow::tr("&About turnscan Studio"), show_about, {}}});
  return out;
}

}  // namespace turnscan::studio
