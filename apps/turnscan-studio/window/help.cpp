#include "window/help.hpp"

#include <vtkVersion.h>
#include <QAbstractButton>
#include <QAction>
#include <QCoreApplication>
#include <QDesktopServices>
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QPlainTextEdit>
#include <QTextBrowser>
#include <QUrl>
#include <QVBoxLayout>
#include <turnscan/sensors/scanner_file.hpp>
#include <version/named_version.hpp>

#include "widgets/message_log.hpp"
#include "widgets/section.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {

namespace {

QString without_mnemonic(QString text) {
  text.remove("\t");
  return text.replace("&&", "\u0001").remove('&').replace("\u0001", "&").remove(QChar(0x2026));
}

/// A dialog filled by one widget; it is deleted when it is closed.
QDialog* dialog_with(MainWindow& window, const QString& name, const QString& title, QWidget* part,
                     const QSize& size) {
  auto* dialog = new QDialog(&window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName(name);
  dialog->setWindowTitle(title);
  dialog->resize(size);
  part->setParent(dialog);
  auto* layout = new QVBoxLayout(dialog);
  layout->addWidget(part);
  dialog->show();
  return dialog;
}

QString table_of(const std::vector<KeyLine>& lines) {
  QString html = "<table cellspacing=\"0\" cellpadding=\"4\">";
  for (const KeyLine& line : lines)
    html += QString("<tr><td><b>%1</b></td><td>%2</td></tr>")
                .arg(line.keys.toHtmlEscaped(), line.what.toHtmlEscaped());
  return html + "</table>";
}

/// The pages of docs/ with their pictures fitted to the width.
class ManualBrowser : public QTextBrowser {
 public:
  using QTextBrowser::QTextBrowser;

  QVariant loadResource(int type, const QUrl& name) override {
    const QVariant found = QTextBrowser::loadResource(type, name);
    if (type != QTextDocument::ImageResource) return found;
    const QImage image = QImage(source().resolved(name).toLocalFile());
    const int room = viewport()->width() - 40;
    if (image.isNull() || room < 100 || image.width() <= room) return found;
    return image.scaledToWidth(room, Qt::SmoothTransformation);
  }
};

/// The file next to the installed program, or in the source tree; empty if it is in neither.
QString documentation(const QString& name) {
  QStringList folders;
  QDir above(QCoreApplication::applicationDirPath());
  for (int i = 0; i < 4; ++i) {
    folders << above.filePath("share/doc/turnscan");
    if (!above.cdUp()) break;
  }
  if (const auto data = data_folder()) {
    const QDir at(QString::fromStdString(data->string()));
    folders << at.filePath("..") << at.filePath("../doc/turnscan");
  }
  for (const QString& folder : folders) {
    const QString file = QDir(folder).filePath(name);
    if (QFileInfo::exists(file)) return QFileInfo(file).canonicalFilePath();
  }
  return {};
}

}  // namespace

std::vector<KeyLine> keys_of(const MainWindow& window) {
  std::vector<KeyLine> out{
      {MainWindow::tr("Left button"), MainWindow::tr("turn")},
      {MainWindow::tr("Middle button, or Shift and left"), MainWindow::tr("move")},
      {MainWindow::tr("Wheel, or right button"), MainWindow::tr("nearer, farther")},
      {MainWindow::tr("Arrows, +, -"), MainWindow::tr("turn, nearer, farther")}};
  const auto add = [&out](const QKeySequence& keys, const QString& what) {
    if (!keys.isEmpty() && !what.isEmpty())
      out.push_back({keys.toString(QKeySequence::NativeText), without_mnemonic(what)});
  };
  for (const auto* button : window.findChildren<QAbstractButton*>())
    add(button->shortcut(), button->text());
  for (const auto* action : window.findChildren<QAction*>())
    add(action->shortcut(), action->text());
  return out;
}

void show_keys(MainWindow& window) {
  auto* text = new QTextBrowser;
  text->setAccessibleName(MainWindow::tr("Keyboard shortcuts"));
  text->setHtml(table_of(keys_of(window)));
  dialog_with(window, "keys", MainWindow::tr("Keyboard shortcuts"), text, {520, 560});
}

QString manual_file() { return documentation("docs/reference/studio.md"); }

QString site_file() { return documentation("html/index.html"); }

void show_manual(MainWindow& window) {
  if (const QString site = site_file();
      !site.isEmpty() && QDesktopServices::openUrl(QUrl::fromLocalFile(site)))
    return;
  const QString file = manual_file();
  if (file.isEmpty()) {
    window.say(MainWindow::tr("The manual is not installed here"));
    return;
  }
  auto* browser = new ManualBrowser;
  browser->setAccessibleName(MainWindow::tr("Manual"));
  browser->setOpenExternalLinks(true);
  auto* dialog = dialog_with(window, "manual", MainWindow::tr("Manual"), browser, {860, 700});
  // After it has its width, to which pictures are fitted.
  dialog->layout()->activate();
  browser->setSource(QUrl::fromLocalFile(file), QTextDocument::MarkdownResource);
}

void show_messages(MainWindow& window) {
  auto* text = new QPlainTextEdit;
  text->setReadOnly(true);
  text->setAccessibleName(MainWindow::tr("Messages, oldest first"));
  const auto fill = [text] {
    text->setPlainText(messages().text());
    text->moveCursor(QTextCursor::End);
  };
  QObject::connect(&messages(), &MessageLog::added, text, fill);
  fill();
  dialog_with(window, "messages", MainWindow::tr("Messages"), text, {720, 360});
}

QString about_html() {
  struct Part {
    const char *name, *license;
  };
  // Libraries that the desktop program is linked with, in addition to the C++ library.
  static constexpr Part kParts[] = {{"Qt", "LGPL 3"},
                                    {"VTK", "BSD 3-clause"},
                                    {"Eigen", "MPL 2.0"},
                                    {"oneTBB", "Apache 2.0"},
                                    {"fmt", "MIT"},
                                    {"tl::expected", "CC0"},
                                    {"nanoflann", "BSD 2-clause"},
                                    {"meshoptimizer", "MIT"},
                                    {"GEOS", "LGPL 2.1"},
                                    {"Qhull", "Qhull"},
                                    {"Embree", "Apache 2.0"},
                                    {"libserialport", "LGPL 3"},
                                    {"libpng", "libpng"},
                                    {"libdeflate", "MIT"},
                                    {"libjpeg-turbo", "IJG, BSD"},
                                    {"LZ4", "BSD 2-clause"},
                                    {"bzip2", "bzip2"},
                                    {"lib3mf", "BSD 2-clause"},
                                    {"tinygltf", "MIT"},
                                    {"nlohmann-json", "MIT"},
                                    {"toml++", "MIT"}};
  QString html = QString("<h2>turnscan Studio %1</h2><p>%2</p><p>%3</p><p>%4</p><table>")
                     .arg(QString::fromStdString(named_version()),
                          MainWindow::tr("From an object on a turntable to a watertight mesh."),
                          MainWindow::tr("turnscan is free software under the Apache License 2.0, "
                                         "whose text is below."),
                          MainWindow::tr("It uses these libraries, with Qt %1 and VTK %2:")
                              .arg(qVersion(), vtkVersion::GetVTKVersion()));
  for (const Part& part : kParts)
    html += QString("<tr><td>%1&nbsp;&nbsp;</td><td>%2</td></tr>").arg(part.name, part.license);
  QFile license(":/studio/LICENSE");
  if (license.open(QIODevice::ReadOnly))
    html += "</table><pre>" + QString::fromUtf8(license.readAll()).toHtmlEscaped() + "</pre>";
  return html;
}

void show_about(MainWindow& window) {
  auto* text = new QTextBrowser;
  text->setAccessibleName(MainWindow::tr("About turnscan Studio"));
  text->setHtml(about_html());
  dialog_with(window, "about", MainWindow::tr("About turnscan Studio"), text, {640, 620});
}

}  // namespace turnscan::studio
