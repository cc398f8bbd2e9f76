#pragma once
// The menu bar of the window.

class QAction;
class QMenu;

namespace turnscan::studio {

class MainWindow;

/// What of the menus follows the state of the window.
struct MainMenu {
  QMenu* recent = nullptr;  ///< filled by the window whenever it is opened
  QAction* undo = nullptr;
  QAction* redo = nullptr;
  QAction* dark = nullptr;
};

/// Fills the menu bar. The actions call the window, which must have its modes by then.
MainMenu make_main_menu(MainWindow& window);

}  // namespace turnscan::studio
