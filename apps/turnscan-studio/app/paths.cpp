#include "app/paths.hpp"

#include <QDir>

namespace turnscan::studio {

QString shown_path(const QString& path) {
  const QString home = QDir::homePath();
  if (path == home) return "~";
  return home.size() > 1 && path.startsWith(home + '/') ? "~" + path.mid(home.size()) : path;
}

QString typed_path(const QString& text) {
  const QString path = text.trimmed();
  return path == "~" || path.startsWith("~/") ? QDir::homePath() + path.mid(1) : path;
}

QString free_folder(const QString& path) {
  QString folder = path;
  for (int i = 2; QDir(folder).exists() && !QDir(folder).isEmpty(); ++i)
    folder = QString("%1-%2").arg(path).arg(i);
  return folder;
}

}  // namespace turnscan::studio
