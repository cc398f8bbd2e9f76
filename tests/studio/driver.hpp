#pragma once
// A person at the window: clicks, keys, waiting for what is shown.

#include <QElapsedTimer>
#include <QSize>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <string>

class QPushButton;

namespace turnscan::studio {

class MainWindow;

/// Settings and calibrations as at the first start, whatever the test before has left. To be a base
/// of the fixture, before the window.
struct FirstStart {
  FirstStart();
};

/// Shows the window at a size and waits until it is there; it is the one that keys go to.
void show_window(MainWindow& window, const QSize& size);

/// The empty folder ~/scans of whoever runs the tests: a name that may stand in a picture.
class ScansFolder {
 public:
  ScansFolder();
  ~ScansFolder();
  ScansFolder(const ScansFolder&) = delete;
  ScansFolder& operator=(const ScansFolder&) = delete;
  QString path() const;
  QString filePath(const QString& name) const;
};

/// The longest time for which the event loop did not come round, on the clock, and in processor
/// time of its own thread, which other work on the machine does not lengthen.
class StallWatch {
 public:
  StallWatch();
  void reset();
  double longest_ms() const { return longest_ms_; }
  double longest_cpu_ms() const { return longest_cpu_ms_; }

 private:
  QTimer timer_;
  QElapsedTimer since_;
  double cpu_since_ms_ = 0.0, longest_ms_ = 0.0, longest_cpu_ms_ = 0.0;
};

/// Runs the event loop until the condition holds; false after `seconds`.
bool wait_for(const std::function<bool()>& condition, double seconds = 60.0);
/// Until no job runs and the view is drawn.
bool wait_idle(MainWindow& window, double seconds = 120.0);
void run_for(int milliseconds);

/// The widget of that object name, or nullptr.
QWidget* named(QWidget& in, const QString& name);
QPushButton* button_with(QWidget& in, const QString& text);
/// A click of the left button in the middle, after folds and tabs around it are opened. False when
/// the widget is not there or not enabled.
bool click(QWidget* widget);
/// Types a text into a line edit in place of what is there.
bool type(QWidget* edit, const QString& text);

/// Texts of a window that lie over each other or have less room than their lines need; empty: none.
std::string crowded(QWidget& in);

/// Runs `turnscan` with the arguments; its exit code.
int run_command_line(const QStringList& arguments, QByteArray* out = nullptr);
QByteArray content(const QString& path);

/// The folder that a test may use which runs to be killed: a variable of its environment.
inline constexpr const char* kKilledFolder = "TURNSCAN_KILLED_FOLDER";
/// Runs a disabled test as a process of its own, with its home in the folder, waits until it says
/// "begun", and kills it after the pause. What it said.
QByteArray kill_in_the_middle(const QString& test, const QString& folder, int after_ms);
/// Where what was killed in that folder kept its sessions.
QString sessions_of_killed(const QString& folder);

/// Writes the whole window, or a dialog, as NAME.png into the folder TURNSCAN_SCREENSHOTS, if that
/// is set.
void keep_picture(QWidget& window, const QString& name);
/// How far a picture is from pictures/NAME.png, both reduced to 96 x 72: the share of places whose
/// colour differs clearly. Another renderer's edges and fonts stay below one in a hundred. 1 where
/// there is no such picture. With TURNSCAN_KEEP_PICTURES set it is written instead, and 0.
double difference_from_kept(const QImage& image, const QString& name);
/// Share of the pixels that differ clearly from their left neighbour: 0 for an empty view.
double busyness(const QImage& image);

}  // namespace turnscan::studio
