#include "explorer.hpp"

#include <gtest/gtest.h>

#include <QApplication>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>
#include <random>
#include <turnscan/io/cloud_io.hpp>
#include <turnscan/io/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/builtin_objects.hpp>

#include "driver.hpp"
#include "main_window.hpp"
#include "model_list.hpp"
#include "scene_view.hpp"

namespace turnscan::studio {
namespace {

class Explorer : public testing::Test {
 protected:
  Explorer() {
    window.resize(1440, 900);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
    QApplication::setActiveWindow(&window);  // there is no window manager to do it
    window.show_mode("explorer");
  }
  QString path(const QString& name) const { return folder.filePath(name); }
  QWidget* in_panel(const QString& name) { return named(window.explorer(), name); }

  QTemporaryDir folder;
  MainWindow window;
};

/// A small recording of the letter A.
QString record_letter(const QTemporaryDir& folder) {
  const QString path = folder.filePath("letter");
  EXPECT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", path, "--frames", "24",
                              "--scanner", "kinect-v2"}),
            0);
  return path;
}

TEST_F(Explorer, ReconstructsARecordingToTheBytesOfTheCommandLine) {
  keep_picture(window, "explorer-empty");
  const QString recording = record_letter(folder);
  window.open(recording);
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(window.explorer().store().models().size(), 1u);
  ASSERT_TRUE(type(in_panel("option:voxel-size"), "3"));
  ASSERT_TRUE(click(in_panel("run:candidates")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(window.explorer().store().models().size(), 2u);
  window.explorer().save_as(2, path("candidates.ply"));
  window.explorer().list().select(1);
  ASSERT_TRUE(click(button_with(window, "Reconstruct")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(window.explorer().store().models().size(), 3u);
  window.explorer().save_as(3, path("mesh.ply"));
  ASSERT_TRUE(wait_idle(window));
  keep_picture(window, "explorer-mesh");
  EXPECT_GT(busyness(window.mode().view().screenshot()), 0.005);
  ASSERT_EQ(run_command_line({"reconstruct", recording, "-o", path("cli.ply"), "--voxel-size",
                              "3mm", "--save-stage", "candidates=" + path("cli-candidates.ply")}),
            0);
  EXPECT_TRUE(content(path("mesh.ply")) == content(path("cli.ply")));
  EXPECT_TRUE(content(path("candidates.ply")) == content(path("cli-candidates.ply")));
  for (int i = 0; i < 20 && window.explorer().store().can_undo(); ++i)
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(window.explorer().store().models().empty());
}

}  // namespace
}  // namespace turnscan::studio
