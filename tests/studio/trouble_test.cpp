// Whatever goes wrong in the middle of a long job: nothing crashes, nothing half-written is left,
// and nothing recorded is lost.

#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <cmath>
#include <turnscan/io/cloud_io.hpp>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/builtin_objects.hpp>

#include "driver.hpp"
#include "explorer.hpp"
#include "jobs.hpp"
#include "main_window.hpp"
#include "model_list.hpp"
#include "record_panel.hpp"
#include "scanner.hpp"
#include "scene_view.hpp"
#include "simulator.hpp"
#include "tests/io/scarcity.hpp"

namespace turnscan::studio {
namespace {

class Trouble : public ::testing::Test, FirstStart {
 protected:
  QString path(const QString& name) const { return folder.filePath(name); }

  /// A window that a test may close and destroy.
  std::unique_ptr<MainWindow> open_window() {
    auto window = std::make_unique<MainWindow>();
    window->resize(1000, 700);
    window->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(window.get()));
    QApplication::setActiveWindow(window.get());  // for its shortcuts; nobody manages windows here
    return window;
  }

  /// Ball of points, large enough for loading and filtering to take a moment.
  QString large_cloud() {
    PointCloud cloud;
    for (int i = 0; i < 300000; ++i) {
      const double a = 2.399963 * i, y = 1.0 - 2.0 * (i + 0.5) / 300000;
      const double r = std::sqrt(1.0 - y * y);
      cloud.points.emplace_back(float(0.1 * r * std::cos(a)), float(0.1 * y),
                                float(0.1 * r * std::sin(a)));
    }
    EXPECT_TRUE(write_cloud(path("large.ply").toStdString(), cloud));
    return path("large.ply");
  }

  QString recording() {
    EXPECT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", path("letter"), "--frames",
                                "24", "--scanner", "kinect-v2"}),
              0);
    return path("letter");
  }

  QTemporaryDir folder;
};

bool shows_error(QWidget& in, const QString& part) {
  const auto labels = in.findChildren<QLabel*>("error");
  return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) {
    return !label->text().isEmpty() && label->text().contains(part);
  });
}

/// Long jobs, each as what begins it in a window, and a widget that tells it has begun.
struct Job {
  const char* name;
  std::function<void(MainWindow&)> prepare, begin;
};

std::vector<Job> jobs_of(const QString& cloud, const QString& recording, const QString& out) {
  const auto nothing = [](MainWindow&) {};
  const auto load = [](const QString& file) {
    return [file](MainWindow& window) {
      window.open(file);
      EXPECT_TRUE(wait_idle(window));
    };
  };
  return {
      {"load", nothing, [cloud](MainWindow& window) { window.open(cloud); }},
      {"filter", load(cloud),
       [](MainWindow& window) { EXPECT_TRUE(click(named(window.explorer(), "run:outliers"))); }},
      {"reconstruct", load(recording),
       [](MainWindow& window) {
         EXPECT_TRUE(click(button_with(window.explorer(), "Reconstruct")));
       }},
      {"simulate",
       [out](MainWindow& window) {
         window.show_mode("simulator");
         window.simulator().set_folder(out);
         EXPECT_TRUE(wait_for([&] { return window.simulator().ready(); }));
       },
       [](MainWindow& window) { EXPECT_TRUE(click(button_with(window.simulator(), "Scan"))); }}};
}

TEST_F(Trouble, CancellingAndClosingInTheMiddleOfEachJobLeaveNothingBehind) {
  for (const Job& job : jobs_of(large_cloud(), recording(), path("scan"))) {
    SCOPED_TRACE(job.name);
    auto window = open_window();
    job.prepare(*window);
    const std::size_t before = window->explorer().store().models().size();
    job.begin(*window);
    ASSERT_TRUE(window->jobs().busy()) << "selected " << window->explorer().list().selected();
    run_for(30);
    QTest::keyClick(window.get(), Qt::Key_Escape);
    ASSERT_TRUE(wait_for([&] { return !window->jobs().busy(); }));
    // It may have been quicker than the key; then its result is whole.
    EXPECT_LE(window->explorer().store().models().size(), before + 1);
    EXPECT_FALSE(shows_error(*window, "cancel"));
    EXPECT_TRUE(!QDir(path("scan")).exists() || window->simulator().result() != nullptr);
    job.begin(*window);
    run_for(30);
    window->close();
    window.reset();
    QDir(path("scan")).removeRecursively();
  }
}

TEST_F(Trouble, ClosingTheWindowWhileItRecordsKeepsTheRecording) {
  auto window = open_window();
  window->show_mode("scanner");
  window->scanner().recording().set_folder(path("recording"));
  window->scanner().set_device("virtual:letter-a?sensor=kinect-v2&realtime=1");
  ASSERT_TRUE(click(button_with(window->scanner(), "Play")));
  QWidget* record = named(window->scanner(), "record");
  ASSERT_TRUE(wait_for([&] { return record->isEnabled(); }));
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] { return QDir(path("recording/depth")).count() > 8; }));
  window->close();
  window.reset();
  const auto recording = Recording::open(path("recording").toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_TRUE(recording->complete());
  EXPECT_GE(recording->frames().size(), 5u);
}

TEST_F(Trouble, AFullDiskInTheMiddleOfEachJobIsSaidAndHalfAFileIsNotLeft) {
  ASSERT_TRUE(write_mesh(path("doll.ply").toStdString(), *builtin_object("doll")));
  auto window = open_window();
  window->open(path("doll.ply"));
  ASSERT_TRUE(wait_idle(*window));
  {
    const turnscan::testing::FullDisk full(20000);
    window->explorer().save_as(1, path("saved.stl"));
    ASSERT_TRUE(wait_for([&] { return !window->jobs().busy(); }));
  }
  EXPECT_TRUE(shows_error(window->explorer(), "saved.stl"));
  EXPECT_FALSE(QFile::exists(path("saved.stl")));
  window->show_mode("simulator");
  window->simulator().set_folder(path("scan"));
  ASSERT_TRUE(wait_for([&] { return window->simulator().ready(); }));
  {
    const turnscan::testing::FullDisk full(20000);
    ASSERT_TRUE(click(button_with(window->simulator(), "Scan")));
    ASSERT_TRUE(wait_for([&] { return !window->jobs().busy(); }));
  }
  EXPECT_TRUE(shows_error(window->simulator(), "scan"));
  EXPECT_EQ(window->simulator().result(), nullptr);
  EXPECT_FALSE(QDir(path("scan")).exists());
}

TEST_F(Trouble, ADiskThatIsFullWhileItRecordsKeepsWhatWasThere) {
  auto window = open_window();
  window->show_mode("scanner");
  ScannerMode& mode = window->scanner();
  mode.recording().set_folder(path("recording"));
  mode.set_device("virtual:letter-a?sensor=kinect-v2&realtime=1&room=desk");
  ASSERT_TRUE(click(button_with(mode, "Play")));
  QWidget* record = named(mode, "record");
  ASSERT_TRUE(wait_for([&] { return record->isEnabled(); }));
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] { return QDir(path("recording/depth")).count() > 6; }));
  {
    const turnscan::testing::FullDisk full(5000);
    ASSERT_TRUE(wait_for([&] { return shows_error(mode, "recording"); }));
  }
  const auto recording = Recording::open(path("recording").toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_GE(recording->frames().size(), 3u);
  EXPECT_TRUE(record->isEnabled());  // the sensor goes on, and so may the person
}

TEST_F(Trouble, ABrokenFrameIsLeftOutOfTheMeshWhichSaysSo) {
  const QString broken = recording();
  QFile frame(broken + "/depth/000003.png");
  ASSERT_TRUE(frame.open(QIODevice::ReadWrite));
  ASSERT_TRUE(frame.resize(200));
  frame.close();
  auto window = open_window();
  window->open(broken);
  ASSERT_TRUE(wait_idle(*window));
  ASSERT_EQ(window->explorer().store().models().size(), 1u);
  ASSERT_TRUE(click(button_with(window->explorer(), "Reconstruct")));
  ASSERT_TRUE(wait_idle(*window));
  // As on the command line the other frames make the mesh, and it says so.
  ASSERT_EQ(window->explorer().store().models().size(), 2u);
  const QString report = window->explorer().store().models().back().data->report;
  EXPECT_TRUE(report.contains("depth/000003.png is truncated")) << report.toStdString();
}

}  // namespace
}  // namespace turnscan::studio
