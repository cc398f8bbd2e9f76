#include "scanner.hpp"

#include <gtest/gtest.h>

#include <QApplication>
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
#include "scene_view.hpp"

namespace turnscan::studio {
namespace {

class Scanner : public testing::Test {
 protected:
  Scanner() {
    window.resize(1440, 900);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    QApplication::setActiveWindow(&window);
    window.show_mode("scanner");
    mode().set_folder(folder.filePath("recording"));
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

TEST_F(Scanner, RecordsUntilTheTurnIsDoneAndReconstructs) {
  mode().set_device(
      "virtual:letter-a?sensor=kinect-v2&calibration=true&angles=1&frames=6000&turns=200");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  ASSERT_TRUE(click(named(mode(), "record")));
  ASSERT_TRUE(wait_for([&] { return !window.explorer().store().models().empty(); }));
  ASSERT_TRUE(wait_idle(window));
  const auto recording = Recording::open(folder.filePath("recording").toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_TRUE(recording->complete());
  EXPECT_GE(recording->frames().size(), 20u);
  EXPECT_EQ(window.explorer().store().models().size(), 2u);
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
  mode().set_device("virtual:letter-a?sensor=kinect-v2&angles=1&frames=6000&fault=lost@10s");
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
