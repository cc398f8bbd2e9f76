#pragma once
// Paths as shown to and typed by users: ~ stands for the home folder.

#include <QString>

namespace turnscan::studio {

/// Abbreviates the home folder to ~; other paths are unchanged.
QString shown_path(const QString& path);
/// The inverse, with surrounding blanks removed.
QString typed_path(const QString& text);
/// The path, or with the first number appended for which it is not a non-empty folder.
QString free_folder(const QString& path);

/// Asks for a file to write, first in the folder of the last one, or else in the home. Empty: none
/// was chosen.
QString ask_save_path(QWidget* parent, const QString& title, const QString& name,
                      const QString& filter);

}  // namespace turnscan::studio
