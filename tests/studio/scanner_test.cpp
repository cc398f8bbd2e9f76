#include "scanner.hpp"

#include <gtest/gtest.h>

#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <cmath>
#include <numbers>
#include <turnscan/core/calibration.hpp>
#include <turnscan/recording/recording.hpp>

#include "driver.hpp"
#include "explorer.hpp"
#include "main_window.hpp"
#include "motor_panel.hpp"
#include "record_panel.hpp"
#include "scene_view.hpp"
#include "tests/capture/simulated_table.hpp"

namespace turnscan::studio {
namespace {

class Scanner : public ::testing::Test, FirstStart {
 protected:
  Scanner() {
    window.resize(1440, 900);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    QApplication::setActiveWindow(&window);
    window.show_mode("scanner");
    mode().recording().set_folder(folder.filePath("recording"));
  }
  ScannerMode& mode() { return window.scanner(); }
  bool enabled(const QString& text) {
    const QPushButton* found = button_with(mode(), text);
    return found && found->isEnabled();
  }

  QTemporaryDir folder;
  MainWindow window;
};

TEST_F(Scanner, CalibratesRecordsAndShowsTheMesh) {
  keep_picture(window, "scanner-empty");
  mode().set_device("virtual:letter-a?sensor=kinect-v2&room=desk&frames=6000");
  ASSERT_TRUE(type(named(mode(), "option:average-frames"), "6"));
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Averaged scan"); }));
  ASSERT_TRUE(click(button_with(mode(), "Averaged scan")));
  ASSERT_TRUE(wait_for([&] { return enabled("Calibrate"); }));
  ASSERT_TRUE(click(button_with(mode(), "Calibrate")));
  ASSERT_TRUE(wait_for([&] { return mode().calibration() != nullptr; }));
  keep_picture(window, "scanner-calibrated");
  EXPECT_NEAR(*mode().calibration()->table.radius_m, 0.150, 0.003);
  mode().save_calibration(folder.filePath("table.json"));
  EXPECT_FALSE(content(folder.filePath("table.json")).isEmpty());
}

TEST_F(Scanner, RecordsUntilTheTurnIsDoneAndReconstructsAsTheCommandLineDoes) {
  mode().set_device(
      "virtual:letter-a?sensor=kinect-v2&calibration=true&angles=1&frames=6000&turns=200");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  ASSERT_TRUE(click(named(mode(), "record")));
  ASSERT_TRUE(wait_for([&] { return !window.explorer().store().models().empty(); }));
  ASSERT_TRUE(wait_idle(window));
  const QString folder_of = folder.filePath("recording");
  const auto recording = Recording::open(folder_of.toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_TRUE(recording->complete());
  EXPECT_GE(recording->frames().size(), 20u);
  ASSERT_EQ(window.explorer().store().models().size(), 2u);
  window.explorer().save_as(2, folder.filePath("mesh.ply"));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(run_command_line({"reconstruct", folder_of, "-o", folder.filePath("cli.ply")}), 0);
  const QByteArray mesh = content(folder.filePath("mesh.ply")),
                   other = content(folder.filePath("cli.ply"));
  EXPECT_TRUE(mesh == other) << mesh.left(400).toStdString() << other.left(400).toStdString();
}

TEST_F(Scanner, AMotorTurnsTheTableAndWhatIsSeenIsShown) {
  turnscan::testing::SimulatedTable table(true, turnscan::testing::BoardFault::kNone);
  mode().recording().motor().set_port(QString::fromStdString(table.port()));
  mode().set_device("virtual:letter-a?sensor=kinect-v2&calibration=true&realtime=1");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  ASSERT_TRUE(click(button_with(mode(), "Turn")));
  ASSERT_TRUE(wait_for([&] { return table.turning(); }));
  ASSERT_TRUE(click(button_with(mode().recording().motor(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return !table.turning() && enabled("Turn"); }));
  ASSERT_TRUE(type(named(mode(), "option:turns"), "0.12"));
  ASSERT_TRUE(type(named(mode(), "option:speed"), "25"));
  ASSERT_TRUE(click(named(mode(), "record")));
  ASSERT_TRUE(wait_for([&] { return table.turning(); }));
  bool seen = false, pictured = false;
  ASSERT_TRUE(wait_for([&] {
    for (const QLabel* label : mode().findChildren<QLabel*>("quiet"))
      seen = seen || label->text().startsWith("Seen so far: about");
    if (seen && !pictured) keep_picture(window, "scanner-recording");
    pictured = pictured || seen;
    return !window.explorer().store().models().empty();
  }));
  EXPECT_TRUE(seen);
  EXPECT_TRUE(table.stands_within(2.0));
  ASSERT_TRUE(wait_idle(window));
  const auto recording = Recording::open(folder.filePath("recording").toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_TRUE(recording->frames().front().angle_rad.has_value());
}

TEST_F(Scanner, TheCircleFollowsTheClicksOnTheRim) {
  mode().set_device("virtual:empty?sensor=kinect-v2&room=desk&frames=6000");
  ASSERT_TRUE(type(named(mode(), "option:average-frames"), "5"));
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Averaged scan"); }));
  ASSERT_TRUE(click(button_with(mode(), "Averaged scan")));
  ASSERT_TRUE(wait_for([&] { return enabled("Calibrate"); }));
  ASSERT_TRUE(click(button_with(mode(), "Calibrate")));
  ASSERT_TRUE(wait_for([&] { return mode().calibration() != nullptr; }));
  const TurntableInfo table = mode().calibration()->table;
  ASSERT_TRUE(click(button_with(mode(), "Pick rim points")));
  ASSERT_TRUE(wait_for([&] { return mode().view().settled(); }));
  const Vec3d u = table.axis.unitOrthogonal(), v = table.axis.cross(u);
  SceneView& view = mode().view();
  for (int i = 0; i < 5; ++i) {
    const double turn = 2.0 * std::numbers::pi * (i + 0.5) / 5;
    const auto at = view.project(table.center_m + 0.97 * *table.radius_m *
                                                      (std::cos(turn) * u + std::sin(turn) * v));
    ASSERT_TRUE(at.has_value());
    QTest::mouseClick(view.childAt(at->toPoint()), Qt::LeftButton, {}, at->toPoint());
    ASSERT_TRUE(wait_for([&] { return view.settled(); }));
  }
  EXPECT_GE(mode().picks(), 4u);
  EXPECT_EQ(mode().calibration()->method, CalibrationMethod::kPicked);
  EXPECT_NEAR(*mode().calibration()->table.radius_m, *table.radius_m, 0.015);
  keep_picture(window, "scanner-picked");
  const std::size_t before = mode().picks();
  ASSERT_TRUE(click(button_with(mode(), "Undo click")));
  EXPECT_EQ(mode().picks(), before - 1);
}

TEST_F(Scanner, ALostDeviceKeepsWhatWasRecorded) {
  mode().set_device("virtual:letter-a?sensor=kinect-v2&angles=1&realtime=1&fault=lost@4s");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  ASSERT_TRUE(click(named(mode(), "record")));
  ASSERT_TRUE(wait_for([&] { return button_with(mode(), "Play") != nullptr; }));
  const auto recording = Recording::open(folder.filePath("recording").toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_GT(recording->frames().size(), 0u);
}

}  // namespace
}  // namespace turnscan::studio
