// The Explorer with every stage, every list command and every format, on real data where it is
// there.

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QStatusBar>
#include <QTest>
#include <QTreeWidget>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "explorer/output/stage_sheet.hpp"
#include "explorer/stage_panel.hpp"
#include "tests/support/shared_data.hpp"
#include "view/scene_view.hpp"
#include "widgets/text.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Stages : public ::testing::Test, FirstStart {
 protected:
  Stages() {
    show_window(window, {1100, 760});
    window.show_mode("explorer");
  }
  ExplorerMode& mode() { return window.explorer(); }
  const std::vector<Model>& models() { return mode().store().models(); }
  void run(const std::string& button) {
    const std::size_t before = models().size();
    const int selected = mode().list().selected();
    ASSERT_TRUE(click(named(mode(), QString::fromStdString("run:" + button)))) << button;
    ASSERT_TRUE(wait_idle(window));
    EXPECT_EQ(models().size(), before + 1) << button;
    mode().list().select(selected);
  }
  void act(const QString& text) {
    for (QAction* each : mode().list().findChildren<QAction*>())
      if (each->text() == text) return each->trigger();
    ADD_FAILURE() << text.toStdString();
  }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Stages, EveryStageOfARecordingAddsAModelAndAllIsTakenBack) {
  const QString recording = folder.filePath("letter");
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", recording, "--frames", "16",
                              "--scanner", "kinect-v2"}),
            0);
  window.open(recording);
  ASSERT_TRUE(wait_idle(window));
  ASSERT_TRUE(type(named(mode(), "option:voxel-size"), "4"));
  for (const char* stage : {"merged", "voxels", "candidates", "refined", "oriented"}) run(stage);
  auto* method = qobject_cast<QComboBox*>(named(mode(), "option:method"));
  ASSERT_NE(method, nullptr);
  for (const char* name : {"volumetric", "poisson", "concave-hull"}) {
    mode().list().select(models().front().id);
    method->setCurrentText(name);
    const ModelDataPtr before = models().back().data;
    QTest::keyClick(&window, Qt::Key_R, Qt::ControlModifier);
    ASSERT_TRUE(wait_for([&] { return models().back().data != before; })) << name;
    ASSERT_TRUE(wait_idle(window));
    EXPECT_EQ(models().back().data->kind, ModelKind::kMesh) << name;
  }
  EXPECT_EQ(models().size(), 7u);
  while (mode().store().can_undo()) QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(models().empty());
}

TEST_F(Stages, VoxelsAreCubesThatAThresholdKeepsAtOnceAndASheetShowsAllStages) {
  const QString recording = folder.filePath("doll");
  ASSERT_EQ(run_command_line({"simulate", "builtin:doll", "-o", recording, "--frames", "24"}), 0);
  window.open(recording);
  ASSERT_TRUE(wait_idle(window));
  ASSERT_TRUE(type(named(mode(), "option:voxel-grid"), "60"));
  ASSERT_TRUE(type(named(mode(), "option:voxel-min-points"), "1"));
  run("voxels");
  const int voxels = models().back().id;
  mode().list().select(voxels);
  const auto drawn = [&] { return window.mode().view().settled(); };
  ASSERT_TRUE(wait_for(drawn));
  run_for(500);
  auto* least = qobject_cast<QSpinBox*>(named(mode(), "voxel_least"));
  auto* kept = qobject_cast<QLabel*>(named(mode(), "voxel_kept"));
  EXPECT_TRUE(qobject_cast<QCheckBox*>(named(mode(), "voxel_cubes"))->isChecked());
  const QImage all = window.mode().view().screenshot();
  keep_picture(window, "voxels-all");
  const std::size_t before = models().size();
  const std::vector<float>& counts = models().back().data->cloud.weights;
  least->setValue(6);
  const auto more =
      std::count_if(counts.begin(), counts.end(), [](float count) { return count >= 6.0f; });
  ASSERT_GT(more, 0);
  EXPECT_TRUE(kept->text().startsWith(grouped(std::size_t(more)) + " of "))
      << kept->text().toStdString();
  ASSERT_TRUE(wait_for([&] { return drawn() && window.mode().view().screenshot() != all; }));
  keep_picture(window, "voxels-kept");
  EXPECT_EQ(models().size(), before);  // no stage was run
  const auto said = [&](const QString& text) {
    for (const QLabel* label : window.statusBar()->findChildren<QLabel*>())
      if (label->text().contains(text)) return true;
    return false;
  };
  ASSERT_TRUE(click(button_with(mode(), "Use for Voxelise")));
  EXPECT_TRUE(said("6 points or more"));
  EXPECT_EQ(qobject_cast<QLineEdit*>(named(mode(), "option:voxel-min-points"))->text(), "6");
  mode().list().select(models().front().id);
  run("sub-voxels");
  mode().list().select(models().back().id);
  run_for(500);
  ASSERT_TRUE(wait_for(drawn));
  keep_picture(window, "sub-voxels");
  EXPECT_TRUE(kept->text().contains("lines")) << kept->text().toStdString();
  // A stage of a stage's points would be another thing than its name says.
  run("candidates");
  EXPECT_EQ(models().back().name, "doll candidates");
  EXPECT_EQ(std::count_if(models().begin(), models().end(),
                          [](const Model& model) { return model.visible; }),
            1)
      << "models of one recording lie in the same place";
  ASSERT_TRUE(click(button_with(mode(), "Reconstruct")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_TRUE(click(button_with(mode(), "Stages…")));
  SheetDialog* sheet = nullptr;
  ASSERT_TRUE(wait_for([&] { return (sheet = mode().findChild<SheetDialog*>()) != nullptr; }));
  keep_picture(*sheet, "sheet");
  sheet->save_as(folder.filePath("stages.png"));
  const QImage saved(folder.filePath("stages.png"));
  EXPECT_EQ(saved.width(), 4 * 420);  // the recording is none of them
  sheet->close();
}

TEST_F(Stages, ARealScanGoesThroughTheStagesAndIsSavedAndReadAgain) {
  const auto scan = turnscan::testing::shared_data("stanford_bunny/bun000.ply");
  TURNSCAN_NEEDS_DATA(scan);
  window.open(QString::fromStdString(scan.string()));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(models().size(), 1u);
  for (const char* stage : {"outliers", "voxels", "candidates"}) run(stage);
  ASSERT_TRUE(click(button_with(mode(), "Reconstruct")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(models().size(), 5u);
  mode().save_as(models().back().id, folder.filePath("bunny.ply"));
  ASSERT_TRUE(wait_idle(window));
  const std::size_t triangles = models().back().data->mesh.triangles.size();
  while (mode().store().can_undo()) QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  window.open(folder.filePath("bunny.ply"));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(models().size(), 1u);
  EXPECT_EQ(models().front().data->mesh.triangles.size(), triangles);
}

TEST_F(Stages, AMeshIsSavedInEachFormatAndReadAgain) {
  const TriangleMesh letter = *builtin_object("letter-a");
  ASSERT_TRUE(write_mesh(folder.filePath("letter.ply").toStdString(), letter));
  window.open(folder.filePath("letter.ply"));
  ASSERT_TRUE(wait_idle(window));
  for (const QString ending : {"stl", "obj", "3mf", "glb"}) {
    const QString file = folder.filePath("letter." + ending);
    mode().save_as(1, file);
    ASSERT_TRUE(wait_idle(window));
    window.open(file);
    ASSERT_TRUE(wait_idle(window));
    for (const QLabel* label : mode().findChildren<QLabel*>("error"))
      EXPECT_EQ(label->text().toStdString(), "");
    const ModelData& read = *models().back().data;
    EXPECT_EQ(read.mesh.triangles.size(), letter.triangles.size()) << ending.toStdString();
    EXPECT_NEAR(bounds(read.mesh.vertices).size().y(), bounds(letter.vertices).size().y(), 1e-4);
  }
  EXPECT_EQ(models().size(), 5u);
}

TEST_F(Stages, ModelsAreHiddenRenamedDuplicatedColouredAndDeleted) {
  ASSERT_TRUE(write_mesh(folder.filePath("letter.ply").toStdString(), *builtin_object("letter-a")));
  window.open(folder.filePath("letter.ply"));
  ASSERT_TRUE(wait_idle(window));
  auto* tree = qobject_cast<QTreeWidget*>(named(mode(), "model_list"));
  ASSERT_NE(tree, nullptr);
  const QImage shown = window.mode().view().screenshot();
  tree->topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  ASSERT_TRUE(wait_for([&] { return !models().front().visible; }));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_NE(window.mode().view().screenshot(), shown);
  tree->topLevelItem(0)->setCheckState(0, Qt::Checked);
  ASSERT_TRUE(wait_for([&] { return models().front().visible; }));
  tree->topLevelItem(0)->setText(0, "initial");
  ASSERT_TRUE(wait_for([&] { return models().front().name == "initial"; }));
  QTest::keyClick(&window, Qt::Key_D, Qt::ControlModifier);
  ASSERT_EQ(models().size(), 2u);
  EXPECT_EQ(models().back().name, "initial (2)");
  act("Own colours on/off");
  EXPECT_FALSE(models().front().own_colors && models().back().own_colors);
  QTest::keyClick(&window, Qt::Key_Delete);
  EXPECT_EQ(models().size(), 1u);
  for (int i = 0; i < 6; ++i) QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(models().front().name, "letter");
}

TEST_F(Stages, OptionsAreKeptAsAPresetThatTheCommandLineTakes) {
  ASSERT_TRUE(type(named(mode(), "option:voxel-size"), "3"));
  EXPECT_FALSE(type(named(mode(), "option:poisson-depth"), "7")) << "a field of another method";
  qobject_cast<QComboBox*>(named(mode(), "option:method"))->setCurrentText("poisson");
  ASSERT_TRUE(type(named(mode(), "option:poisson-depth"), "7"));
  mode().save_preset(folder.filePath("preset.toml"));
  ASSERT_TRUE(wait_idle(window));
  const QString recording = folder.filePath("letter");
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", recording, "--frames", "8"}),
            0);
  EXPECT_EQ(run_command_line({"reconstruct", recording, "-o", folder.filePath("mesh.ply"),
                              "--config", folder.filePath("preset.toml")}),
            0);
  ASSERT_TRUE(click(button_with(mode(), "Defaults")));
  EXPECT_FALSE(mode().stages().preset_text().find("voxel-size") != std::string::npos);
  ASSERT_TRUE(mode().stages().load_preset(folder.filePath("preset.toml").toStdString()));
  EXPECT_EQ(mode().stages().preset_text(), content(folder.filePath("preset.toml")).toStdString());
}

TEST_F(Stages, WhatDiffersFromTheDefaultsIsSaidAndPutBack) {
  auto* notice = mode().stages().notice();
  EXPECT_FALSE(notice->isVisible());
  ASSERT_TRUE(type(named(mode(), "option:voxel-grid"), "100"));
  EXPECT_TRUE(notice->isVisible());
  auto* text = qobject_cast<QLabel*>(notice);
  EXPECT_TRUE(text->text().contains("Voxel grid")) << text->text().toStdString();
  keep_picture(window, "changed-setting");
  QLabel* label = nullptr;
  for (QLabel* each : mode().stages().findChildren<QLabel*>())
    if (each->text().contains("Voxel grid ↺")) label = each;
  ASSERT_NE(label, nullptr);
  Q_EMIT label->linkActivated("reset");
  EXPECT_EQ(qobject_cast<QLineEdit*>(named(mode(), "option:voxel-grid"))->text(), "");
  EXPECT_FALSE(notice->isVisible());
  EXPECT_FALSE(label->text().contains("↺"));
}

TEST_F(Stages, EqualJobsAreQueuedOnceAndTheQueueIsSeen) {
  const QString recording = folder.filePath("letter");
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", recording, "--frames", "16",
                              "--scanner", "kinect-v2"}),
            0);
  window.open(recording);
  ASSERT_TRUE(wait_idle(window));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(click(button_with(mode(), "Reconstruct")));
  EXPECT_TRUE(window.jobs().waiting().isEmpty());
  ASSERT_TRUE(click(named(mode(), "run:merged")));
  EXPECT_EQ(window.jobs().waiting(), QStringList{"letter merged"});
  EXPECT_TRUE(wait_for(
      [&] { return qobject_cast<QLabel*>(named(window, "jobs_waiting"))->text() == "1 more"; }));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(models().size(), 3u);
}

}  // namespace
}  // namespace turnscan::studio
