// Whatever goes wrong in the middle of a long job: nothing crashes, nothing half-written is left,
// and nothing recorded is lost.

#include <gtest/gtest.h>

#include <QApplication>
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTest>
#include <chrono>
#include <cmath>
#include <thread>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "scanner/record_panel.hpp"
#include "scanner/scanner.hpp"
#include "simulator/simulator.hpp"
#include "tests/io/scarcity.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Trouble : public ::testing::Test, FirstStart {
 protected:
  QString path(const QString& name) const { return folder.filePath(name); }

  /// A window that a test may close and destroy.
  std::unique_ptr<MainWindow> open_window() {
    auto window = std::make_unique<MainWindow>();
    window->set_close_question([](const QStringList&) { return true; });
    show_window(*window, {1000, 700});
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

  /// Ball of triangles, the same.
  QString large_ball() {
    constexpr std::uint32_t kSide = 250;
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < kSide; ++i)
      for (std::uint32_t j = 0; j < kSide; ++j) {
        const double a = 6.283185 * i / kSide, y = std::cos(3.141593 * (j + 0.5) / kSide);
        const double r = std::sqrt(1.0 - y * y);
        mesh.vertices.emplace_back(float(0.1 * r * std::cos(a)), float(0.1 * y),
                                   float(0.1 * r * std::sin(a)));
        if (j + 1 == kSide) continue;
        const std::uint32_t at = i * kSide + j, next = (i + 1) % kSide * kSide + j;
        mesh.triangles.push_back({at, next, at + 1});
        mesh.triangles.push_back({at + 1, next, next + 1});
      }
    EXPECT_TRUE(write_mesh(path("ball.ply").toStdString(), mesh));
    return path("ball.ply");
  }

  QString recording() {
    EXPECT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", path("letter"), "--frames",
                                "24", "--scanner", "kinect-v2"}),
              0);
    return path("letter");
  }

  ScansFolder folder;
};

bool shows_error(QWidget& in, const QString& part) {
  const auto labels = in.findChildren<QLabel*>("error");
  return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) {
    return !label->text().isEmpty() && label->text().contains(part);
  });
}

/// A long job: what gets a window ready for it, and what starts it there.
struct Job {
  const char* name;
  std::function<void(MainWindow&)> prepare, begin;
};

using Step = std::function<void(MainWindow&)>;

Step load(const std::vector<QString>& files) {
  return [files](MainWindow& window) {
    for (const QString& file : files) window.open(file);
    EXPECT_TRUE(wait_idle(window));
  };
}

Step click_explorer(const QString& text) {
  return [text](MainWindow& window) { EXPECT_TRUE(click(button_with(window.explorer(), text))); };
}

void click_when_ready(QWidget& in, const QString& text) {
  EXPECT_TRUE(wait_for([&] {
    const QPushButton* found = button_with(in, text);
    return found && found->isEnabled();
  }));
  EXPECT_TRUE(click(button_with(in, text)));
}

/// A sensor that shows a desk.
void play(MainWindow& window) {
  window.show_mode("scanner");
  window.scanner().set_device("virtual:empty?sensor=kinect-v2&room=desk&frames=60000");
  EXPECT_TRUE(type(named(window.scanner(), "option:average-frames"), "12"));
  click_when_ready(window.scanner(), "Play");
}

void average(MainWindow& window) {
  click_when_ready(window.scanner(), "Averaged scan");
  EXPECT_TRUE(wait_for([&] { return window.jobs().busy(); }));
}

Step play_and_average() {
  return [](MainWindow& window) {
    play(window);
    average(window);
    EXPECT_TRUE(wait_for([&] { return !window.jobs().busy(); }));
  };
}

Step prepare_simulation(const QString& out) {
  return [out](MainWindow& window) {
    window.show_mode("simulator");
    window.simulator().set_folder(out);
    EXPECT_TRUE(wait_for([&] { return window.simulator().ready(); }));
  };
}

void simulate(MainWindow& window) { EXPECT_TRUE(click(button_with(window.simulator(), "Scan"))); }

/// Until the recording is whole and what it covered is counted.
void simulate_until_coverage(MainWindow& window) {
  bool counting = false;
  const auto watch =
      QObject::connect(&window.jobs(), &JobRunner::progress, &window,
                       [&counting](const QString& phase) { counting |= phase == "coverage"; });
  simulate(window);
  EXPECT_TRUE(wait_for([&] { return counting || !window.jobs().busy(); }));
  QObject::disconnect(watch);
  EXPECT_TRUE(counting);
}

std::vector<Job> jobs_of(const QString& cloud, const QString& ball, const QString& recording,
                         const QString& out) {
  const auto nothing = [](MainWindow&) {};
  return {
      {"load", nothing, [cloud](MainWindow& window) { window.open(cloud); }},
      {"filter", load({cloud}),
       [](MainWindow& window) { EXPECT_TRUE(click(named(window.explorer(), "run:outliers"))); }},
      {"reconstruct", load({recording}), click_explorer("Reconstruct")},
      {"compare", load({ball, ball}), click_explorer("Distances")},
      {"save", load({ball}),
       [out](MainWindow& window) { window.explorer().save_as(1, out + ".stl"); }},
      {"average", play, average},
      {"calibrate", play_and_average(),
       [](MainWindow& window) { click_when_ready(window.scanner(), "Calibrate"); }},
      {"simulate", prepare_simulation(out), simulate},
      {"coverage", prepare_simulation(out), simulate_until_coverage}};
}

TEST_F(Trouble, CancellingAndClosingInTheMiddleOfEachJobLeaveNothingBehind) {
  const QStringList before{"ball.ply", "large.ply", "letter"};
  for (const Job& job : jobs_of(large_cloud(), large_ball(), recording(), path("scan"))) {
    SCOPED_TRACE(job.name);
    auto window = open_window();
    job.prepare(*window);
    const std::size_t models = window->explorer().store().models().size();
    job.begin(*window);
    run_for(30);
    QTest::keyClick(window.get(), Qt::Key_Escape);
    ASSERT_TRUE(wait_for([&] { return !window->jobs().busy(); }));
    // It may have been quicker than the key; then its result is whole.
    EXPECT_LE(window->explorer().store().models().size(), models + 1);
    EXPECT_FALSE(shows_error(*window, "cancel"));
    if (QDir(path("scan")).exists()) {
      EXPECT_NE(window->simulator().result(), nullptr);
      const auto made = Recording::open(path("scan").toStdString());
      ASSERT_TRUE(made.has_value());
      EXPECT_TRUE(made->complete());
    }
    job.begin(*window);
    run_for(30);
    window->close();
    window.reset();
    for (const char* made : {"scan", "scan-2"}) QDir(path(made)).removeRecursively();
    QFile::remove(path("scan.stl"));
    EXPECT_EQ(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
              before);
  }
}

TEST_F(Trouble, WhatWentWrongIsSaidAndStaysInTheMessages) {
  auto window = open_window();
  for (const char* name : {"first.stl", "second.obj"}) {
    QFile bad(path(name));
    ASSERT_TRUE(bad.open(QIODevice::WriteOnly));
    bad.write("this is no mesh");
    bad.close();
    window->open(path(name));
  }
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_TRUE(shows_error(*window, "first.stl"));
  EXPECT_TRUE(shows_error(*window, "second.obj"));
  window->open(large_ball());
  ASSERT_TRUE(wait_idle(*window));
  window->explorer().save_as(1, path("good.stl"));
  ASSERT_TRUE(wait_idle(*window));
  const auto* status = window->statusBar()->findChild<QLabel*>();
  ASSERT_NE(status, nullptr);
  EXPECT_TRUE(status->text().startsWith("Wrote ")) << status->text().toStdString();
  window->explorer().save_as(1, path("no-such-folder/bad.stl"));
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_EQ(status->text(), "Save bad.stl: failed");
  // A save that has begun is quick and goes to its end; this one still waits when it is cancelled.
  window->jobs().start("Wait", window.get(),
                       [](const RunContext& context) -> Result<Finish> {
                         while (!context.cancelled())
                           std::this_thread::sleep_for(std::chrono::milliseconds(1));
                         return fail(ErrorCode::kCancelled, "cancelled");
                       },
                       {});
  window->explorer().save_as(1, path("late.ply"));
  window->jobs().cancel();
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_EQ(status->text(), "Save late.ply: cancelled");
  QTest::keyClick(window.get(), Qt::Key_L, Qt::ControlModifier);
  const auto* dialog = window->findChild<QDialog*>("messages");
  ASSERT_NE(dialog, nullptr);
  const QString text = dialog->findChild<QPlainTextEdit*>()->toPlainText();
  for (const char* said :
       {"first.stl", "second.obj", "Wrote ", "Save bad.stl: failed", "Save late.ply: cancelled"})
    EXPECT_TRUE(text.contains(said)) << said;
}

TEST_F(Trouble, StoppingARecordingIsNoLoss) {
  auto window = open_window();
  window->show_mode("scanner");
  window->scanner().recording().set_folder(path("recording"));
  window->scanner().set_device("virtual:letter-a?sensor=kinect-v2&realtime=1");
  click_when_ready(window->scanner(), "Play");
  click_when_ready(window->scanner(), "Record");
  ASSERT_TRUE(wait_for([&] { return QDir(path("recording/depth")).count() > 8; }));
  // The sensor is stopped, not the recording: both end well.
  ASSERT_TRUE(click(button_with(window->scanner(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return button_with(window->scanner(), "Play") != nullptr; }));
  const auto made = Recording::open(path("recording").toStdString());
  ASSERT_TRUE(made.has_value());
  EXPECT_TRUE(made->complete());
  EXPECT_GE(made->frames().size(), 5u);
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
  const auto on_a_full_disk = [&](rlim_t bytes, const std::function<void()>& write) {
    const turnscan::testing::FullDisk full(bytes);
    write();
    ASSERT_TRUE(wait_for([&] { return !window->jobs().busy(); }));
  };
  on_a_full_disk(20000, [&] { window->explorer().save_as(1, path("saved.stl")); });
  EXPECT_TRUE(shows_error(window->explorer(), "saved.stl"));
  on_a_full_disk(10, [&] { window->explorer().save_preset(path("preset.toml")); });
  EXPECT_TRUE(shows_error(window->explorer(), "preset.toml"));
  on_a_full_disk(10, [&] { window->simulator().save_scene(path("scene.toml")); });
  EXPECT_TRUE(shows_error(window->simulator(), "scene.toml"));
  on_a_full_disk(1000, [&] { window->screenshot(path("view.png")); });
  const auto texts = window->statusBar()->findChildren<QLabel*>();
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [](const QLabel* label) {
    return label->text().contains("view.png") && !label->text().startsWith("Wrote");
  }));
  EXPECT_EQ(QDir(folder.path()).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot),
            QStringList{"doll.ply"});
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
