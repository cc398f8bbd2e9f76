#pragma once
// Paths as people read and type them: ~ stands for the folder of whoever is at the window.

#include <QString>

namespace turnscan::studio {

/// A path below that folder begins with ~, others stay.
QString shown_path(const QString& path);
/// The way back, without blanks around it.
QString typed_path(const QString& text);
/// The path, or with a number added the first that is not a folder with content.
QString free_folder(const QString& path);

}  // namespace turnscan::studio
