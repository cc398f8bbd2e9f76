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

}  // namespace turnscan::studio
