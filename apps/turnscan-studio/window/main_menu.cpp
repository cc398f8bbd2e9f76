#include "window/main_menu.hpp"

#include <QAction>
#include <QDialog>
#include <QFileDialog>
#include <QKeySequence>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QVBoxLayout>
#include <functional>
#include <turnscan/core/version.hpp>
#include <vector>

#include "app/jobs.hpp"
#include "app/mode.hpp"
#include "explorer/explorer.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "widgets/message_log.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {

namespace {

QString menu_text(const char* source) { return MainWindow::tr(source); }

struct MenuEntry {
  QString title;  ///< empty: a separator
  std::function<void(MainWindow&)> run;
  QKeySequence keys;
};

/// Returns the actions of the entries that are none but separators.
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
  const QString folder = QFileDialog::getExistingDirectory(&window, menu_text("Open a recording"));
  if (!folder.isEmpty()) window.open(folder);
}

void save_screenshot(MainWindow& window) {
  const QString path = QFileDialog::getSaveFileName(&window, menu_text("Save screenshot"),
                                                    "view.png", menu_text("Pictures (*.png)"));
  if (!path.isEmpty()) window.screenshot(path);
}

void toggle_boxes(MainWindow& window) { window.settings().set_boxes(!window.settings().boxes()); }

void show_keys(MainWindow& window) {
  QMessageBox::information(
      &window, menu_text("Keys and mouse"),
      menu_text(
          "Left button: turn\nMiddle button, or Shift and left: move\n"
          "Wheel or right button: nearer, farther\nArrows, +, -: the same by keys\n"
          "1 to 7: from front, back, left, right, top, bottom, corner\nHome: show everything\n"
          "B: bounding boxes\nF1 to F3: the modes\nEsc: cancel the running job"));
}

void show_messages(MainWindow& window) {
  auto* dialog = new QDialog(&window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName("messages");
  dialog->setWindowTitle(menu_text("Messages"));
  dialog->resize(720, 360);
  auto* text = new QPlainTextEdit(dialog);
  text->setReadOnly(true);
  text->setAccessibleName(menu_text("Messages, oldest first"));
  const auto fill = [text] {
    text->setPlainText(messages().text());
    text->moveCursor(QTextCursor::End);
  };
  QObject::connect(&messages(), &MessageLog::added, text, fill);
  fill();
  auto* layout = new QVBoxLayout(dialog);
  layout->addWidget(text);
  dialog->show();
}

void show_about(MainWindow& window) {
  QMessageBox::about(
      &window, menu_text("About turnscan Studio"),
      menu_text("turnscan Studio %1\nFrom an object on a turntable to a watertight mesh.")
          .arg(version()));
}

MenuEntry standard_view(const char* title, StandardView from, int key) {
  return {menu_text(title), [from](MainWindow& w) { w.mode().view().look(from); },
          QKeySequence(key)};
}

QMenu* add_menu(MainWindow& window, const char* title) {
  return window.menuBar()->addMenu(menu_text(title));
}

/// Returns the menu of recent files.
QMenu* add_file_menu(MainWindow& window) {
  QMenu* menu = add_menu(window, "&File");
  add_entries(window, *menu,
              {{menu_text("&Open…"), open_files, QKeySequence::Open},
               {menu_text("Open &recording…"), open_recording, QKeySequence("Ctrl+Shift+O")}});
  QMenu* recent = menu->addMenu(menu_text("Open r&ecent"));
  add_entries(window, *menu,
              {{menu_text("&Save…"), [](MainWindow& w) { w.mode().save(); }, QKeySequence::Save},
               {menu_text("Save s&creenshot…"), save_screenshot, QKeySequence("Ctrl+P")},
               {},
               {menu_text("&Quit"), [](MainWindow& w) { w.close(); }, QKeySequence::Quit}});
  return recent;
}

/// Returns its actions; the first two are undo and redo.
std::vector<QAction*> add_edit_menu(MainWindow& window) {
  return add_entries(
      window, *add_menu(window, "&Edit"),
      {{menu_text("Undo"), [](MainWindow& w) { w.mode().undo(); }, QKeySequence::Undo},
       {menu_text("Redo"), [](MainWindow& w) { w.mode().redo(); }, QKeySequence("Ctrl+Shift+Z")},
       {menu_text("Delete"), [](MainWindow& w) { w.mode().remove_selected(); },
        QKeySequence::Delete},
       {},
       {menu_text("Cancel the running job"), [](MainWindow& w) { w.jobs().cancel(); },
        QKeySequence(Qt::Key_Escape)}});
}

/// Returns the action of the dark theme.
QAction* add_view_menu(MainWindow& window) {
  QMenu* menu = add_menu(window, "&View");
  add_entries(window, *menu,
              {{menu_text("Reset camera"), [](MainWindow& w) { w.mode().view().reset_camera(); },
                QKeySequence(Qt::Key_Home)},
               standard_view("Front", StandardView::kFront, Qt::Key_1),
               standard_view("Back", StandardView::kBack, Qt::Key_2),
               standard_view("Left", StandardView::kLeft, Qt::Key_3),
               standard_view("Right", StandardView::kRight, Qt::Key_4),
               standard_view("Top", StandardView::kTop, Qt::Key_5),
               standard_view("Bottom", StandardView::kBottom, Qt::Key_6),
               standard_view("Corner", StandardView::kCorner, Qt::Key_7),
               {},
               {menu_text("Bounding boxes"), toggle_boxes, QKeySequence(Qt::Key_B)}});
  QAction* dark = menu->addAction(menu_text("Dark"), &window.settings(), &ViewSettings::set_dark,
                                  QKeySequence("Ctrl+Shift+D"));
  dark->setCheckable(true);
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
  add_entries(window, *add_menu(window, "&Help"),
              {{menu_text("Keys and mouse"), show_keys, {}},
               {menu_text("Messages"), show_messages, QKeySequence("Ctrl+L")},
               {menu_text("About turnscan Studio"), show_about, {}}});
  return out;
}

}  // namespace turnscan::studio
