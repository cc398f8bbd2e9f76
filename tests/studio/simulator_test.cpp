#include "simulator/simulator.hpp"

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMouseEvent>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <turnscan/simulator/scene_file.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "simulator/scanner_editor.hpp"
#include "simulator/sweep_panel.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Simulator : public ::testing::Test, FirstStart {
 protected:
  Simulator() {
    show_window(window, {1440, 900});
    window.show_mode("simulator");
    mode().set_object("builtin:letter-a");
    mode().set_folder(folder.filePath("scan"));
    EXPECT_TRUE(wait_for([&] { return mode().ready() && mode().view().settled(); }));
  }
  SimulatorMode& mode() { return window.simulator(); }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Simulator, RecordsTheBytesOfTheCommandLineAndSendsThemToReconstruction) {
  ASSERT_TRUE(type(named(mode(), "option:frames"), "24"));
  ASSERT_TRUE(type(named(mode(), "option:elevation"), "25deg"));
  mode().add_scanner("kinect-v1");
  ASSERT_EQ(mode().scanner_count(), 2);
  ASSERT_TRUE(wait_for([&] { return mode().ready() && mode().view().settled(); }));
  keep_picture(window, "simulator-rig");
  ASSERT_TRUE(click(button_with(mode(), "Scan")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_NE(mode().result(), nullptr);
  keep_picture(window, "simulator-coverage");
  auto* coloring = qobject_cast<QComboBox*>(named(mode(), "coverage_coloring"));
  ASSERT_NE(coloring, nullptr);
  for (int i = 1; i < 4; ++i) {
    coloring->setCurrentIndex(i);
    ASSERT_TRUE(wait_for([&] { return mode().view().settled(); }));
    keep_picture(window, QString("simulator-coverage-%1").arg(i));
  }
  auto* holes = qobject_cast<QTableWidget*>(named(mode(), "holes"));
  ASSERT_GT(holes->rowCount(), 0);
  QTest::mouseClick(holes->viewport(), Qt::LeftButton, {},
                    holes->visualItemRect(holes->item(0, 0)).center());
  ASSERT_TRUE(wait_for([&] { return mode().view().settled(); }));
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", folder.filePath("cli"),
                              "--frames", "24", "--scanner", "kinect-v2,elevation=25deg",
                              "--scanner", "kinect-v1,azimuth=90deg"}),
            0);
  for (const char* file : {"recording.json", "frames.csv", "depth/000007.png", "truth/poses.csv",
                           "truth/object.ply", "truth/scene.toml"})
    EXPECT_TRUE(content(folder.filePath(QString("scan/") + file)) ==
                content(folder.filePath(QString("cli/") + file)))
        << file << "\n"
        << (QString(file).endsWith(".toml") ? content(folder.filePath(QString("scan/") + file))
                                            : QByteArray())
               .toStdString();
  ASSERT_TRUE(click(named(mode(), "simulator_reconstruct")));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(window.explorer().store().models().size(), 2u);
}

TEST_F(Simulator, AScannerOfTheFieldsRecordsTheBytesOfItsFile) {
  const auto slide = [&](const char* name, int steps) {
    auto* slider = qobject_cast<QSlider*>(named(mode(), QString("slider:") + name));
    ASSERT_NE(slider, nullptr) << name;
    slider->setValue(slider->value() + steps);
  };
  const QImage before = mode().view().screenshot();
  slide("near", -40);
  slide("far", -60);
  slide("vertical-fov", 50);
  slide("columns", -150);
  slide("rows", -150);
  slide("pan", 3);
  ASSERT_TRUE(type(named(mode(), "option:baseline"), "55"));
  ASSERT_TRUE(type(named(mode(), "option:frames"), "6"));
  ASSERT_TRUE(wait_for([&] { return mode().ready() && mode().view().settled(); }));
  EXPECT_NE(mode().view().screenshot(), before);
  keep_picture(window, "simulator-editor");
  const ScannerEntry entry = mode().scene().scanners.at(0);
  EXPECT_EQ(entry.model, "kinect-v2");
  EXPECT_GE(entry.options.size(), 8u);  // the focal length, too
  auto* editor = mode().findChild<ScannerEditor*>();
  ASSERT_NE(editor, nullptr);
  const auto scan = [&](const QString& to) {
    mode().set_folder(folder.filePath(to));
    ASSERT_TRUE(click(button_with(mode(), "Scan")));
    ASSERT_TRUE(wait_idle(window));
    ASSERT_NE(mode().result(), nullptr);
  };
  ASSERT_TRUE(type(named(mode(), "option:name"), "own"));
  scan("fields");
  editor->save_as(folder.filePath("own.toml"));
  EXPECT_TRUE(mode().scene().scanners.at(0).model.ends_with("own.toml"));
  EXPECT_EQ(mode().scene().scanners.at(0).options.size(), 1u);  // pan
  ASSERT_EQ(
      run_command_line({"simulate", "builtin:letter-a", "-o", folder.filePath("cli"), "--frames",
                        "6", "--pan", "3deg", "--scanner", folder.filePath("own.toml")}),
      0);
  for (const char* file :
       {"recording.json", "frames.csv", "depth/000003.png", "truth/poses.csv", "truth/object.ply"})
    EXPECT_TRUE(content(folder.filePath(QString("fields/") + file)) ==
                content(folder.filePath(QString("cli/") + file)))
        << file;
  // A preset fills the fields, and what cannot be is said.
  editor->fill("gocator");
  EXPECT_EQ(mode().scene().scanners.at(0).model, "gocator");
  ASSERT_TRUE(type(named(mode(), "option:near"), "5m"));
  EXPECT_TRUE(editor->error().contains("near = 5000mm"));
  while (!mode().undo_text().isEmpty()) QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(mode().scene().scanners.at(0).model, "kinect-v2");
}

TEST_F(Simulator, ASweepPlotsTheCoverageAndPlacesTheScannerAtItsBest) {
  ASSERT_TRUE(type(named(mode(), "option:frames"), "6"));
  mode().add_scanner("kinect-v1");  // it stays as it is, and the selected one is swept
  ASSERT_TRUE(wait_for([&] { return mode().ready(); }));
  auto* sweep = mode().findChild<SweepPanel*>();
  ASSERT_NE(sweep, nullptr);
  auto* option = qobject_cast<QComboBox*>(named(*sweep, "sweep_option"));
  option->setCurrentIndex(option->findData("tilt"));
  ASSERT_TRUE(type(named(*sweep, "sweep_values"), "-20..20/10"));
  ASSERT_TRUE(click(button_with(*sweep, "Sweep")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(sweep->swept().size(), 5u);
  EXPECT_GT(best_of(sweep->swept()).covered, sweep->swept().back().covered);
  keep_picture(window, "simulator-sweep");
  qobject_cast<QListWidget*>(named(mode(), "scanner_list"))
      ->setCurrentRow(0);  // the swept is meant
  ASSERT_TRUE(click(button_with(*sweep, "Use the best")));
  const ScannerSetup placed =
      *scanner_setup(mode().scene().scanners.at(1), mode().scene().placement);
  EXPECT_NEAR(placed.placement.tilt_rad, best_of(sweep->swept()).value, 1e-6);
  ASSERT_TRUE(type(named(*sweep, "sweep_values"), "20"));
  ASSERT_TRUE(click(button_with(*sweep, "Sweep")));
  const QString problem = sweep->findChild<QLabel*>("error")->text();
  EXPECT_TRUE(problem.contains("from..to/step")) << problem.toStdString();
  ASSERT_TRUE(type(named(*sweep, "sweep_values"), "20..-20/10"));
  ASSERT_TRUE(click(button_with(*sweep, "Sweep")));
  const QString refused = sweep->findChild<QLabel*>("error")->text();
  EXPECT_TRUE(refused.startsWith("tilt: 20deg")) << refused.toStdString();
  EXPECT_TRUE(wait_for([&] { return crowded(window).empty(); }, 5.0)) << crowded(window);
}

TEST_F(Simulator, AScannerIsPlacedByDragging) {
  const std::string before = scene_toml(mode().scene());
  SceneView& view = mode().view();
  view.reset_camera();
  ASSERT_TRUE(wait_for([&] { return view.settled(); }));
  // The scanner stands at azimuth 0, 0.9 m away, 17 degrees up, and looks at the object's middle.
  const auto at = view.project(Vec3d(0.0, 0.097 + 0.9 * 0.29237, -0.9 * 0.95630));
  ASSERT_TRUE(at.has_value());
  QWidget* canvas = view.childAt(at->toPoint());
  ASSERT_NE(canvas, nullptr);
  QTest::mousePress(canvas, Qt::LeftButton, {}, at->toPoint());
  QMouseEvent move(QEvent::MouseMove, *at + QPointF(40, -20), Qt::NoButton, Qt::LeftButton, {});
  QApplication::sendEvent(canvas, &move);
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, at->toPoint() + QPoint(40, -20));
  run_for(50);
  EXPECT_NE(scene_toml(mode().scene()), before);
}

TEST_F(Simulator, TheRigIsThereAgainInTheNextRunAndItsChangesAreTakenBack) {
  const auto text = [](MainWindow& w) { return scene_toml(w.simulator().scene()); };
  const std::string first = text(window);
  ASSERT_TRUE(type(named(mode(), "option:elevation"), "31"));
  mode().add_scanner("gocator");
  ASSERT_TRUE(type(named(mode(), "option:frames"), "45"));
  ASSERT_TRUE(wait_for([&] { return mode().ready(); }));
  const std::string changed = text(window);
  ASSERT_NE(changed, first);
  {
    MainWindow next;
    EXPECT_EQ(text(next), changed);
    EXPECT_EQ(next.simulator().scanner_count(), 2);
  }
  mode().save_scene(folder.filePath("scene.toml"));
  ASSERT_TRUE(wait_for([&] { return !window.jobs().busy(); }));
  while (!mode().undo_text().isEmpty()) QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(mode().scanner_count(), 1);
  while (!mode().redo_text().isEmpty())
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(text(window), changed);
  mode().remove_selected();
  mode().load_scene(folder.filePath("scene.toml"));
  EXPECT_EQ(text(window), changed);
}

}  // namespace
}  // namespace turnscan::studio
