#pragma once
// The menu bar of the window.

class QAction;
class QMenu;

namespace turnscan::studio {

class MainWindow;

/// Menu items that depend on the state of the window.
struct MainMenu {
  QMenu* recent = nullptr;  ///< filled by the window whenever it is opened
  QAction* undo = nullptr;
  QAction* redo = nullptr;
  QAction* dark = nullptr;
};

/// Fills the menu bar. The actions call the window, whose modes must exist by then.
MainMenu make_main_menu(MainWindow& window);

}  // namespace turnscan::studio
