#pragma once
// What the Help menu shows: keys, the manual, messages, what the program is made of.

#include <QString>
#include <vector>

namespace turnscan::studio {

class MainWindow;

/// What a person can press, and what that does, in the order of the menus; the mouse first.
struct KeyLine {
  QString keys, what;
};
std::vector<KeyLine> keys_of(const MainWindow& window);
void show_keys(MainWindow& window);

/// docs/studio.md as it came with the program, or empty: then it is not here.
QString manual_file();
void show_manual(MainWindow& window);

void show_messages(MainWindow& window);

/// Version and licences as HTML.
QString about_html();
void show_about(MainWindow& window);

}  // namespace turnscan::studio
