#include "app/paths.hpp"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>

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

QString ask_save_path(QWidget* parent, const QString& title, const QString& name,
                      const QString& filter) {
  QSettings settings;
  const QDir folder(settings.value("files/folder", QDir::homePath()).toString());
  const QString path = QFileDialog::getSaveFileName(parent, title, folder.filePath(name), filter);
  if (!path.isEmpty()) settings.setValue("files/folder", QFileInfo(path).absolutePath());
  return path;
}

QString free_folder(const QString& path) {
  QString folder = path;
  for (int i = 2; QDir(folder).exists() && !QDir(folder).isEmpty(); ++i)
    folder = QString("%1-%2").arg(path).arg(i);
  return folder;
}

}  // namespace turnscan::studio
