#include "scanner/scanner.hpp"

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/recording/recording.hpp>

#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "scanner/motor_panel.hpp"
#include "scanner/record_panel.hpp"
#include "tests/capture/simulated_table.hpp"
#include "tests/io/scarcity.hpp"
#include "view/scene_view.hpp"
#include "widgets/section.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Scanner : public ::testing::Test, FirstStart {
 protected:
  Scanner() {
    show_window(window, {1440, 900});
    window.show_mode("scanner");
    mode().recording().set_folder(folder.filePath("recording"));
  }
  ScannerMode& mode() { return window.scanner(); }
  bool enabled(const QString& text) {
    const QPushButton* found = button_with(mode(), text);
    return found && found->isEnabled();
  }

  ScansFolder folder;
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
  ASSERT_TRUE(wait_idle(window));
  EXPECT_FALSE(content(folder.filePath("table.json")).isEmpty());
  {
    const turnscan::testing::FullDisk full(10);
    mode().save_calibration(folder.filePath("full.json"));
    ASSERT_TRUE(wait_idle(window));
  }
  EXPECT_FALSE(QFile::exists(folder.filePath("full.json")));
  mode().load_calibration(folder.filePath("table.json"));
  EXPECT_NEAR(*mode().calibration()->table.radius_m, 0.150, 0.003);
  // Only what stands on the table: a part of the points.
  const auto points = [&] {
    for (const QLabel* label : mode().findChildren<QLabel*>("quiet"))
      if (label->text().contains(" frames a second"))
        return label->text().section(", ", 1, 1).remove(QRegularExpression("[^0-9]")).toInt();
    return 0;
  };
  ASSERT_TRUE(wait_for([&] { return points() > 60000; }));
  QCheckBox* filter = nullptr;
  for (QCheckBox* box : mode().findChildren<QCheckBox*>())
    if (box->text() == "Filter points") filter = box;
  ASSERT_TRUE(filter && filter->isEnabled());
  filter->setChecked(true);
  EXPECT_TRUE(wait_for([&] { return points() > 1000 && points() < 20000; }));
}

TEST_F(Scanner, WhatIsKnownOfOneDeviceIsNotBelievedOfTheNext) {
  const QString first = "virtual:letter-a?sensor=kinect-v2&room=desk&frames=6000";
  const auto* speed = static_cast<QLineEdit*>(named(mode(), "option:speed"));
  mode().set_device(first);
  ASSERT_TRUE(type(named(mode(), "option:average-frames"), "4"));
  ASSERT_TRUE(type(named(mode(), "option:speed"), "25deg/s"));
  const QString typed = speed->text();
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Averaged scan"); }));
  ASSERT_TRUE(click(button_with(mode(), "Averaged scan")));
  ASSERT_TRUE(wait_for([&] { return enabled("Calibrate"); }));
  ASSERT_TRUE(click(button_with(mode(), "Calibrate")));
  ASSERT_TRUE(wait_for([&] { return mode().calibration() != nullptr; }));
  mode().save_calibration(folder.filePath("table.json"));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_TRUE(click(button_with(mode(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return enabled("Play"); }));
  EXPECT_NE(mode().calibration(), nullptr);
  mode().set_device("virtual:cylinder?sensor=kinect-v1&frames=6000");
  EXPECT_EQ(speed->text(), "");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  EXPECT_EQ(mode().calibration(), nullptr);
  ASSERT_TRUE(click(button_with(mode(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return enabled("Play"); }));
  // One that is loaded before a device plays is meant for it.
  mode().load_calibration(folder.filePath("table.json"));
  mode().set_device(first);
  EXPECT_EQ(speed->text(), typed);
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  EXPECT_NE(mode().calibration(), nullptr);
}

TEST_F(Scanner, ATableThatHasMovedIsToldAndTheMotionTakesOver) {
  const auto play_until_checked = [&](const QString& uri) {
    mode().load_calibration(folder.filePath("table.json"));
    mode().set_device(uri);
    EXPECT_TRUE(click(button_with(mode(), "Play")));
    EXPECT_TRUE(wait_for([&] { return mode().rig_check().has_value(); }));
  };
  const QString uri = "virtual:doll?sensor=kinect-v2&realtime=1&frames=6000";
  ASSERT_EQ(run_command_line({"calibrate", "--device", uri + "&seed=3", "--detect", "--save",
                              folder.filePath("table.json")}),
            0);
  play_until_checked(uri);
  EXPECT_FALSE(mode().rig_check()->moved) << mode().rig_check()->text;
  auto* banner = named(mode(), "rig_moved");
  ASSERT_NE(banner, nullptr);
  EXPECT_FALSE(banner->isVisible());
  ASSERT_TRUE(click(button_with(mode(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return enabled("Play"); }));
  play_until_checked(uri + "&table-x=10mm");
  EXPECT_TRUE(mode().rig_check()->moved) << mode().rig_check()->text;
  EXPECT_TRUE(banner->isVisible());
  keep_picture(window, "scanner-moved");
  ASSERT_TRUE(click(button_with(*banner, "Use motion")));
  EXPECT_EQ(mode().calibration(), nullptr);
  EXPECT_TRUE(wait_for([&] { return !banner->isVisible(); }));
}

TEST_F(Scanner, WhatIsKeptOfARigThatHasMovedSinceIsNotUsed) {
  const QString uri = "virtual:doll?sensor=kinect-v2&realtime=1&frames=6000";
  ASSERT_EQ(run_command_line({"calibrate", "--device", uri, "--detect"}), 0);
  mode().set_device(uri);
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return mode().rig_check().has_value(); }));
  EXPECT_NE(mode().calibration(), nullptr);
  ASSERT_TRUE(click(button_with(mode(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return enabled("Play"); }));
  mode().set_device(uri + "&table-x=10mm");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return mode().calibration() != nullptr; }));
  EXPECT_TRUE(wait_for([&] { return mode().calibration() == nullptr; }));
  run_for(500);
  EXPECT_EQ(mode().calibration(), nullptr);
  EXPECT_FALSE(named(mode(), "rig_moved")->isVisible());
  const auto labels = mode().findChildren<QLabel*>();
  EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
    return label->text().startsWith("The calibration of the last recording is not used");
  }));
  // A device that says itself where its table is needs nothing that is kept.
  ASSERT_TRUE(click(button_with(mode(), "Stop")));
  ASSERT_TRUE(wait_for([&] { return enabled("Play"); }));
  mode().set_device("virtual:skull?sensor=kinect-v2&calibration=true&realtime=1&frames=6000");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  run_for(300);
  EXPECT_EQ(mode().calibration(), nullptr);
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

TEST_F(Scanner, TheSurfaceGrowsWhileItRecordsWithNothingTyped) {
  // Neither the table's place nor its speed is known. Not in real time, and two turns: the surface
  // has time to come on a machine that does other things, too.
  mode().set_device("virtual:doll?sensor=kinect-v2&prepared=240&frames=24000&turns=100");
  ASSERT_TRUE(type(named(mode(), "option:turns"), "2"));
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }, 120.0));
  for (QCheckBox* box : mode().findChildren<QCheckBox*>())
    if (box->text() == "Make the mesh when it is done") box->setChecked(false);
  ASSERT_TRUE(click(named(mode(), "record")));
  const auto said = [&](const QString& text) {
    for (const QLabel* label : mode().findChildren<QLabel*>("quiet"))
      if (label->text().contains(text)) return true;
    return false;
  };
  EXPECT_TRUE(wait_for([&] { return said("of the surface is still missing"); }));
  keep_picture(window, "scanner-growing");
  ASSERT_TRUE(wait_for([&] { return !mode().is_recording(); }));
}

/// Pixels of the colour in which what no view saw is drawn.
int magenta(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const QRgb c = image.pixel(x, y);
      count += qRed(c) > 2 * qGreen(c) + 40 && qBlue(c) > qGreen(c) + 20 ? 1 : 0;
    }
  return count;
}

TEST_F(Scanner, AnotherSideIsScannedAndJoined) {
  mode().set_device(
      "virtual:skull?sensor=kinect-v2&calibration=true&angles=1&frames=6000&turns=200&noise="
      "gaussian:1mm");
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  ASSERT_TRUE(click(named(mode(), "record")));
  const auto& models = window.explorer().store().models();
  ASSERT_TRUE(wait_for([&] { return models.size() == 2; }, 180.0));
  ASSERT_TRUE(wait_idle(window));
  auto* advice = static_cast<QLabel*>(named(window.explorer(), "advice"));
  EXPECT_TRUE(advice->text().startsWith("No view saw")) << advice->text().toStdString();
  EXPECT_TRUE(advice->text().contains("tip it by"));
  QTest::keyClick(&window, Qt::Key_6);  // from below
  ASSERT_TRUE(wait_for([&] { return window.explorer().view().settled(); }));
  EXPECT_GT(magenta(window.explorer().view().screenshot()), 2000);
  keep_picture(window, "explorer-missing");
  for (QCheckBox* box : window.explorer().findChildren<QCheckBox*>())
    if (box->text() == "Show what no view saw") box->setChecked(false);
  ASSERT_TRUE(wait_for([&] { return window.explorer().view().settled(); }));
  EXPECT_LT(magenta(window.explorer().view().screenshot()), 200);

  ASSERT_TRUE(click(button_with(window.explorer(), "Scan another side")));
  EXPECT_EQ(&window.mode(), static_cast<Mode*>(&mode()));
  auto* next = static_cast<QLabel*>(named(mode(), "next_pass"));
  EXPECT_TRUE(next->isVisible());
  EXPECT_TRUE(next->text().contains("The next pass goes into ~/scans/recording"));
  ASSERT_TRUE(wait_for([&] { return enabled("Record another side"); }));
  run_for(1500);  // the object is laid
  keep_picture(window, "scanner-another-side");
  ASSERT_TRUE(click(named(mode(), "record")));
  const auto joined = [&] { return models[1].data->report.contains("2 passes in one mesh"); };
  ASSERT_TRUE(wait_for(joined, 180.0));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(models.size(), 2u);  // in the place of the mesh of the first pass alone
  EXPECT_FALSE(next->isVisible());
  EXPECT_EQ(models[0].data->kind, ModelKind::kRecording);  // with both passes, and listed once
  EXPECT_EQ(models[0].data->recording->frames().back().pass, 1u);
  const QString folder_of = folder.filePath("recording");
  const auto recording = Recording::open(folder_of.toStdString());
  ASSERT_TRUE(recording.has_value());
  EXPECT_TRUE(recording->complete());
  EXPECT_EQ(recording->frames().front().pass, 0u);
  EXPECT_EQ(recording->frames().back().pass, 1u);
  EXPECT_TRUE(models[1].visible);
  EXPECT_EQ(crowded(window), "");
  keep_picture(window, "explorer-joined");
  window.explorer().save_as(models[1].id, folder.filePath("mesh.ply"));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(run_command_line({"reconstruct", folder_of, "-o", folder.filePath("cli.ply")}), 0);
  EXPECT_TRUE(content(folder.filePath("mesh.ply")) == content(folder.filePath("cli.ply")));
}

TEST_F(Scanner, ANextPassIsGivenUpForANewRecording) {
  mode().set_device("virtual:letter-a?sensor=kinect-v1&frames=6000");
  mode().scan_another_side({folder.filePath("recording"), "Lay it on its back.", {}});
  auto* next = static_cast<QLabel*>(named(mode(), "next_pass"));
  EXPECT_TRUE(next->isVisible());
  EXPECT_FALSE(named(mode(), "scanner_folder")->isEnabled());
  ASSERT_TRUE(click(button_with(mode(), "New recording instead")));
  EXPECT_FALSE(next->isVisible());
  EXPECT_TRUE(named(mode(), "scanner_folder")->isEnabled());
}

/// Whether the colours of what was seen stand in the picture, beside the legend. What was not seen
/// is bluish.
bool shows_sides(const QImage& image) {
  int warm = 0, green = 0;
  for (int y = image.height() / 4; y < image.height(); ++y)
    for (int x = 0; x < image.width() * 3 / 4; ++x) {
      const QRgb c = image.pixel(x, y);
      warm += qRed(c) > qBlue(c) + 30 ? 1 : 0;
      green += qGreen(c) > qBlue(c) + 20 && qGreen(c) > qRed(c) + 20 ? 1 : 0;
    }
  return std::min(warm, green) > 500;
}

TEST_F(Scanner, AMotorTurnsTheTableAndWhatIsSeenIsShown) {
  turnscan::testing::SimulatedTable table(turnscan::testing::BoardKind::kGrbl,
                                          turnscan::testing::BoardFault::kNone);
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
    if (seen && !pictured && shows_sides(mode().view().screenshot())) {
      pictured = true;
      for (Section* section : mode().recording().findChildren<Section*>()) section->set_open(false);
      keep_picture(window, "scanner-recording");
    }
    return !window.explorer().store().models().empty();
  }));
  EXPECT_TRUE(seen);
  EXPECT_TRUE(pictured);  // in the colours of the legend
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
  ASSERT_TRUE(click(button_with(mode(), "Calibrate")));  // takes the averaged scan, too
  ASSERT_TRUE(wait_for([&] { return mode().calibration() != nullptr; }));
  const TurntableInfo table = mode().calibration()->table;
  ASSERT_TRUE(click(button_with(mode(), "Pick rim points")));
  ASSERT_TRUE(wait_for([&] { return mode().view().settled(); }));
  const Vec3d u = table.axis.unitOrthogonal(), v = table.axis.cross(u);
  SceneView& view = mode().view();
  for (int i = 0; i < 5; ++i) {
    const double turn = kTurn * (i + 0.5) / 5;
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
  // Clicks beside the rim are refused with the limit, and what was detected holds.
  for (const double off_m : {-0.05, 0.03}) mode().add_pick(table.center_m + off_m * u);
  const auto errors = mode().findChildren<QLabel*>("error");
  EXPECT_TRUE(std::any_of(errors.begin(), errors.end(), [](const QLabel* label) {
    return label->isVisible() && label->text().contains("4 mm is the limit");
  }));
  EXPECT_EQ(mode().calibration()->method, CalibrationMethod::kDetected);
  // A new detection is not undone by taking clicks back.
  ASSERT_TRUE(click(button_with(mode(), "Calibrate")));
  ASSERT_TRUE(wait_for([&] { return mode().picks() == 0; }));
  mode().undo();
  EXPECT_EQ(mode().calibration()->method, CalibrationMethod::kDetected);
  EXPECT_NEAR(*mode().calibration()->table.radius_m, *table.radius_m, 1e-4);
}

TEST_F(Scanner, ThePlatterIsFoundWhileItPlaysAndReturnPlaysWhatIsTyped) {
  auto* box = qobject_cast<QComboBox*>(named(mode(), "device"));
  const auto play = [&](const QString& uri) {
    ASSERT_TRUE(type(box->lineEdit(), uri));
    QTest::keyClick(box->lineEdit(), Qt::Key_Return);
  };
  auto* chip = qobject_cast<QLabel*>(named(mode(), "platter_chip"));
  play("virtual:doll?sensor=kinect-v2&realtime=1&frames=6000");
  ASSERT_TRUE(wait_for([&] { return chip->isVisible(); }, 180.0));
  EXPECT_EQ(chip->property("grade"), "good") << chip->text().toStdString();
  EXPECT_TRUE(QRegularExpression(R"(radius 1(49|50)\.\d mm, known to \d\.\d mm)")
                  .match(chip->text())
                  .hasMatch())
      << chip->text().toStdString();
  keep_picture(window, "scanner-chip");
  // Another one takes its place: what plays is what the field says.
  play("virtual:empty?sensor=kinect-v2&platter-radius=120mm&realtime=1&frames=6000");
  EXPECT_TRUE(wait_for([&] {
    return chip->isVisible() && chip->text().contains(
                                    "radius 1"
                                    "2");
  })) << chip->text().toStdString();
  // What is typed and left is taken back.
  ASSERT_TRUE(type(box->lineEdit(), "virtual:skull"));
  mode().view().setFocus();
  EXPECT_TRUE(box->currentText().startsWith("virtual:empty"));
}

TEST_F(Scanner, SpaceRecordsAndStopsAndTheSurfaceStaysUntilTheMesh) {
  mode().set_device(
      "virtual:skull?sensor=kinect-v2&calibration=true&angles=1&frames=6000&turns=100");
  ASSERT_TRUE(type(named(mode(), "option:turns"), "20"));
  ASSERT_TRUE(click(button_with(mode(), "Play")));
  ASSERT_TRUE(wait_for([&] { return enabled("Record"); }));
  const auto space = [&] {
    ASSERT_NE(window.focusWidget(), nullptr);
    QTest::keyClick(window.focusWidget(), Qt::Key_Space);
  };
  ASSERT_NO_FATAL_FAILURE(space());
  ASSERT_TRUE(wait_for([&] { return mode().updates().surfaces > 1; }));
  ASSERT_NO_FATAL_FAILURE(space());
  ASSERT_TRUE(wait_for([&] { return !mode().is_recording(); }));
  ExplorerMode& explorer = window.explorer();
  ASSERT_TRUE(wait_for([&] { return explorer.shows_surface(); }));
  ASSERT_TRUE(wait_for([&] { return explorer.view().settled(); }));
  keep_picture(window, "surface-stays");
  ASSERT_TRUE(wait_for([&] { return explorer.store().models().size() == 2; }));
  EXPECT_FALSE(explorer.shows_surface());
  ASSERT_TRUE(wait_idle(window));
  keep_picture(window, "surface-is-mesh");
  // The next one is written beside it, and the panel says so.
  const auto labels = mode().findChildren<QLabel*>("quiet");
  EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
    return label->text().contains("the next recording goes into") &&
           label->text().endsWith("recording-2");
  }));
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
