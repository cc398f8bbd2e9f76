#include "driver.hpp"

#include <gtest/gtest.h>

#include <QApplication>
#include <QDateTime>
#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QFileInfo>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QTabWidget>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "app/jobs.hpp"
#include "app/mode.hpp"
#include "explorer/session.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {

FirstStart::FirstStart() {
  QSettings().clear();
  QDir(SessionKeeper::default_root()).removeRecursively();
  // What is kept of a device by an earlier test, or by a command line that it ran.
  QDir(qEnvironmentVariable("XDG_STATE_HOME") + "/turnscan/calibrations").removeRecursively();
}

void show_window(MainWindow& window, const QSize& size) {
  window.resize(size);
  window.show();
  EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
  QApplication::setActiveWindow(&window);  // there is no window manager to do it
}

ScansFolder::ScansFolder() {
  QDir(path()).removeRecursively();
  QDir::home().mkpath("scans");
}

ScansFolder::~ScansFolder() { QDir(path()).removeRecursively(); }

QString ScansFolder::path() const { return QDir::home().filePath("scans"); }

QString ScansFolder::filePath(const QString& name) const { return QDir(path()).filePath(name); }

namespace {

double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

}  // namespace

StallWatch::StallWatch() {
  QObject::connect(&timer_, &QTimer::timeout, [this] {
    longest_ms_ = std::max(longest_ms_, 1e-6 * double(since_.nsecsElapsed()));
    longest_cpu_ms_ = std::max(longest_cpu_ms_, thread_cpu_ms() - cpu_since_ms_);
    since_.restart();
    cpu_since_ms_ = thread_cpu_ms();
  });
  reset();
  timer_.start(2);
}

void StallWatch::reset() {
  longest_ms_ = longest_cpu_ms_ = 0.0;
  since_.restart();
  cpu_since_ms_ = thread_cpu_ms();
}

bool wait_for(const std::function<bool()>& condition, double seconds) {
  QElapsedTimer clock;
  clock.start();
  while (!condition()) {
    if (double(clock.elapsed()) > 1e3 * seconds) return false;
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    QTest::qSleep(1);
  }
  return true;
}

bool wait_idle(MainWindow& window, double seconds) {
  return wait_for([&] { return !window.jobs().busy(); }, seconds) &&
         wait_for([&] { return window.mode().view().settled(); }, seconds);
}

void run_for(int milliseconds) { QTest::qWait(milliseconds); }

QWidget* named(QWidget& in, const QString& name) { return in.findChild<QWidget*>(name); }

QPushButton* button_with(QWidget& in, const QString& text) {
  for (QPushButton* each : in.findChildren<QPushButton*>())
    if (each->text() == text) return each;
  return nullptr;
}

bool click(QWidget* widget) {
  if (!widget || !widget->isEnabled()) return false;
  for (QWidget* up = widget->parentWidget(); up; up = up->parentWidget()) {
    if (auto* section = qobject_cast<Section*>(up)) section->set_open(true);
    if (auto* tabs = qobject_cast<QTabWidget*>(up))
      for (int i = 0; i < tabs->count(); ++i)
        if (tabs->widget(i)->isAncestorOf(widget)) tabs->setCurrentIndex(i);
  }
  QApplication::processEvents();
  for (QWidget* up = widget->parentWidget(); up; up = up->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(up)) area->ensureWidgetVisible(widget);
  }
  QApplication::processEvents();
  if (!widget->isVisible()) return false;
  QTest::mouseClick(widget, Qt::LeftButton, Qt::NoModifier, widget->rect().center());
  QApplication::processEvents();
  return true;
}

bool type(QWidget* edit, const QString& text) {
  auto* line = qobject_cast<QLineEdit*>(edit);
  if (!line) return false;
  if (!click(line)) return false;
  line->selectAll();
  QTest::keyClick(line, Qt::Key_Delete);
  QTest::keyClicks(line, text);
  QApplication::processEvents();
  return true;
}

std::string crowded(QWidget& in) {
  std::string found;
  for (const QLabel* label : in.findChildren<QLabel*>()) {
    if (!label->isVisible() || label->text().isEmpty()) continue;
    const std::string text = label->text().left(40).toStdString();
    if (label->wordWrap() && label->height() < label->heightForWidth(label->width()))
      found += "'" + text + "' is cut; ";
    const QObject* box = label->parent();
    for (const QWidget* other : label->parentWidget()->findChildren<QWidget*>())
      if (other != label && other->parent() == box && other->isVisible() &&
          other->geometry().intersects(label->geometry()))
        found += "'" + text + "' and " + other->metaObject()->className() + " overlap; ";
  }
  return found;
}

int run_command_line(const QStringList& arguments, QByteArray* out) {
  QProcess process;
  process.start(qEnvironmentVariable("TURNSCAN_BIN"), arguments);
  if (!process.waitForFinished(300000)) return -1;
  const QByteArray errors = process.readAllStandardError();
  if (process.exitCode() != 0) std::fprintf(stderr, "%s", errors.constData());
  if (out) *out = process.readAllStandardOutput();
  return process.exitCode();
}

QByteArray content(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

QByteArray kill_in_the_middle(const QString& test, const QString& folder, int after_ms) {
  QProcess process;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(kKilledFolder, folder);
  environment.insert("TMPDIR", folder);  // where its home is
  process.setProcessEnvironment(environment);
  process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  process.start("/proc/self/exe", {"--gtest_also_run_disabled_tests", "--gtest_filter=" + test});
  QByteArray said;
  while (!said.contains("begun") && process.waitForReadyRead(180000))
    said += process.readAllStandardOutput();
  EXPECT_TRUE(said.contains("begun")) << said.constData();
  QTest::qSleep(std::max(1, after_ms));
  process.kill();
  process.waitForFinished();
  EXPECT_EQ(process.exitStatus(), QProcess::CrashExit);
  return said + process.readAllStandardOutput();
}

QString sessions_of_killed(const QString& folder) {
  QString root;
  for (QDirIterator at(folder, {"sessions"}, QDir::Dirs | QDir::Hidden | QDir::NoDotAndDotDot,
                       QDirIterator::Subdirectories);
       at.hasNext();) {
    const QString found = at.next();
    // Each has a home of its own.
    if (root.isEmpty() || QFileInfo(found).lastModified() > QFileInfo(root).lastModified())
      root = found;
  }
  return root;
}

void keep_picture(QWidget& window, const QString& name) {
  const QString folder = qEnvironmentVariable("TURNSCAN_SCREENSHOTS");
  if (folder.isEmpty()) return;
  run_for(60);
  if (const auto* main = qobject_cast<MainWindow*>(&window))
    (void)wait_for([&] { return main->mode().view().settled(); }, 3.0);
  window.grab().save(QDir(folder).filePath(name + ".png"));
}

double difference_from_kept(const QImage& image, const QString& name) {
  const QString file = QDir(TURNSCAN_STUDIO_PICTURES).filePath(name + ".png");
  const QImage now = image.scaled(96, 72, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                         .convertToFormat(QImage::Format_RGB888);
  if (qEnvironmentVariableIsSet("TURNSCAN_KEEP_PICTURES") && !QFile::exists(file)) {
    now.save(file);
    return 0.0;
  }
  const QImage kept = QImage(file).convertToFormat(QImage::Format_RGB888);
  if (kept.size() != now.size()) return 1.0;
  int far = 0;
  for (int y = 0; y < now.height(); ++y)
    for (int x = 0; x < now.width(); ++x) {
      const QRgb a = now.pixel(x, y), b = kept.pixel(x, y);
      const int away = std::max({std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)),
                                 std::abs(qBlue(a) - qBlue(b))});
      far += away > 40 ? 1 : 0;
    }
  return double(far) / (now.width() * now.height());
}

double busyness(const QImage& image) {
  long long changes = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 1; x < image.width(); ++x) {
      const QRgb a = image.pixel(x - 1, y), b = image.pixel(x, y);
      changes += std::abs(qRed(a) - qRed(b)) + std::abs(qGreen(a) - qGreen(b)) +
                             std::abs(qBlue(a) - qBlue(b)) >
                         12
                     ? 1
                     : 0;
    }
  return double(changes) / std::max(1, image.width() * image.height());
}

}  // namespace turnscan::studio
