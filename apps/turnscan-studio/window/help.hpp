#pragma once
// Contents of the Help menu: keys, the manual, messages, about.

#include <QString>
#include <vector>

namespace turnscan::studio {

class MainWindow;

/// Keys and mouse actions with their effects, in the order of the menus; the mouse first.
struct KeyLine {
  QString keys, what;
};
std::vector<KeyLine> keys_of(const MainWindow& window);
void show_keys(MainWindow& window);

/// docs/reference/studio.md as shipped with the program; empty if it is not installed.
QString manual_file();
/// The first page of the manual as a site; empty if that is not installed.
QString site_file();
/// The site in the system's browser, or the page in a window of our own.
void show_manual(MainWindow& window);

void show_messages(MainWindow& window);

/// Version and licences as HTML.
QString about_html();
void show_about(MainWindow& window);

}  // namespace turnscan::studio
