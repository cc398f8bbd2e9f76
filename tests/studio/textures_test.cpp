// Textures in the Explorer: shown, told apart by view, exported, and kept over a crash.

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QTest>
#include <set>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/looking/texture_views.hpp"
#include "explorer/model_list.hpp"
#include "explorer/output/export_dialog.hpp"
#include "explorer/session.hpp"
#include "explorer/verdict_panel.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

/// A square of 0.1 m before the origin, facing +z: its picture's upper half red, lower left green,
/// lower right blue.
TriangleMesh painted_square() {
  TriangleMesh mesh;
  mesh.vertices = {
      {-0.05f, 0.0f, 0.0f}, {0.05f, 0.0f, 0.0f}, {0.05f, 0.1f, 0.0f}, {-0.05f, 0.1f, 0.0f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(64, 64, Rgb{220, 0, 0});
  for (int y = 32; y < 64; ++y)
    for (int x = 0; x < 64; ++x) texture->image.at(x, y) = x < 32 ? Rgb{0, 200, 0} : Rgb{0, 0, 220};
  // Not on the border, beyond which pictures repeat.
  const Eigen::Vector2f a(0.02f, 0.98f), b(0.98f, 0.98f), c(0.98f, 0.02f), d(0.02f, 0.02f);
  texture->corners = {{a, b, c}, {a, c, d}};
  mesh.texture = std::move(texture);
  return mesh;
}

class Textures : public ::testing::Test, FirstStart {
 protected:
  Textures() {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
  }
  QString path(const QString& name) const { return folder.filePath(name); }
  ModelStore& store() { return window.explorer().store(); }
  SceneView& view() { return window.mode().view(); }
  void open_square() {
    ASSERT_TRUE(write_mesh(path("square.glb").toStdString(), painted_square()));
    window.open(path("square.glb"));
    ASSERT_TRUE(wait_idle(window));
    ASSERT_EQ(store().models().size(), 1u);
    view().look(StandardView::kFront);
    ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  }
  QColor seen_at(double x, double y) {
    const auto at = view().project(Vec3d(x, y, 0.0));
    const QImage image = view().screenshot();
    return at ? image.pixelColor((*at * view().devicePixelRatioF()).toPoint()) : QColor();
  }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Textures, TheViewShowsThePictureTheRightWayUp) {
  ASSERT_NO_FATAL_FAILURE(open_square());
  keep_picture(window, "texture-square");
  const QColor top = seen_at(0.0, 0.075), left = seen_at(-0.025, 0.025),
               right = seen_at(0.025, 0.025);
  EXPECT_GT(top.red(), 2 * std::max(top.green(), top.blue()) + 20);
  EXPECT_GT(left.green(), 2 * std::max(left.red(), left.blue()) + 20);
  EXPECT_GT(right.blue(), 2 * std::max(right.red(), right.green()) + 20);
  // Without its own colours it has the one of the list.
  store().set_color(1, QColor(128, 128, 128), false);
  ASSERT_TRUE(wait_idle(window));
  const QColor plain = seen_at(0.0, 0.075);
  EXPECT_LT(std::abs(plain.red() - plain.green()), 12);
}

TEST_F(Textures, AreSavedAndExportedAsTheFormatCan) {
  ASSERT_NO_FATAL_FAILURE(open_square());
  for (const char* name : {"again.obj", "again.3mf", "again.glb"}) {
    window.explorer().save_as(1, path(name));
    ASSERT_TRUE(wait_idle(window));
    const auto read = read_mesh(path(name).toStdString());
    ASSERT_TRUE(read) << name;
    EXPECT_TRUE(has_texture(*read)) << name;
  }
  window.explorer().save_as(1, path("again.ply"));
  ASSERT_TRUE(wait_idle(window));
  const auto read = read_mesh(path("again.ply").toStdString());
  ASSERT_TRUE(read);
  ASSERT_EQ(read->colors.size(), 4u);
  EXPECT_EQ(read->colors[0], (Rgb{0, 200, 0}));
  EXPECT_EQ(read->colors[2], (Rgb{220, 0, 0}));
}

TEST_F(Textures, TheExportDialogOffersWhatModelAndFormatHave) {
  ASSERT_NO_FATAL_FAILURE(open_square());
  ExportDialog dialog(*store().models().front().data, "square");
  dialog.show();
  auto* format = dialog.findChild<QComboBox*>("export_format");
  auto* colors = dialog.findChild<QComboBox*>("export_colors");
  auto* unit = dialog.findChild<QComboBox*>("export_unit");
  auto* up = dialog.findChild<QComboBox*>("export_up");
  ASSERT_TRUE(format && colors && unit && up);
  EXPECT_EQ(dialog.ending(), ".glb");
  EXPECT_EQ(dialog.options().colors, ExportColors::kTexture);
  EXPECT_FALSE(unit->isEnabled());
  EXPECT_FALSE(up->isEnabled());
  format->setCurrentIndex(format->findData(".stl"));
  EXPECT_EQ(dialog.options().colors, ExportColors::kNone);
  EXPECT_DOUBLE_EQ(dialog.options().metres_per_unit, 1e-3);
  format->setCurrentIndex(format->findData(".ply"));
  EXPECT_EQ(dialog.options().colors, ExportColors::kVertices);
  EXPECT_TRUE(unit->isEnabled());
  unit->setCurrentIndex(0);
  EXPECT_EQ(dialog.options().up, UpAxis::kFormat);
  up->setCurrentIndex(up->findData(int(UpAxis::kZ)));
  keep_picture(dialog, "export-dialog");
  window.explorer().export_as(1, path("cad.ply"), dialog.options());
  ASSERT_TRUE(wait_idle(window));
  const auto read = read_mesh(path("cad.ply").toStdString());
  ASSERT_TRUE(read);
  // Millimetres; what was up is z in the file, and y where it is read back.
  EXPECT_NEAR(bounds(read->vertices).max.y(), 100.0, 1e-3);
  EXPECT_NEAR(bounds(read->vertices).max.z(), 0.0, 1e-3);
  QFile file(path("cad.ply"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.read(200).contains("obj_info frame z up, base at 0\n"));
  EXPECT_EQ(read->colors.size(), 4u);
}

TEST_F(Textures, SurviveAKillAsAModelInNoFile) {
  ASSERT_NO_FATAL_FAILURE(open_square());
  auto data = std::make_shared<ModelData>(*store().models().front().data);
  store().add("made", data);
  window.explorer().session().flush();
  // What is on disk now is what a killed program leaves.
  const QDir sessions(SessionKeeper::default_root());
  const QStringList folders = sessions.entryList(QDir::Dirs | QDir::NoDotAndDotDot);
  ASSERT_EQ(folders.size(), 1);
  const QDir kept(sessions.filePath(folders.front()));
  ASSERT_TRUE(QFile::exists(kept.filePath("1.glb")));
  const auto read = read_mesh(kept.filePath("1.glb").toStdString());
  ASSERT_TRUE(read);
  ASSERT_TRUE(has_texture(*read));
  EXPECT_EQ(read->texture->image.at(10, 10), (Rgb{220, 0, 0}));
}

TEST_F(Textures, OfAScanAreMadeShownAndTracedToTheirViews) {
  const QString recording = path("doll");
  ASSERT_EQ(
      run_command_line({"simulate", "builtin:doll", "--height", "100mm", "--frames", "12",
                        "--distance", "0.6m", "--noise", "none", "--scan-colour", "--colour-width",
                        "320", "--colour-fov", "20deg", "--out", recording}),
      0);
  window.open(recording);
  ASSERT_TRUE(wait_idle(window));
  ASSERT_TRUE(type(named(window.explorer(), "option:voxel-size"), "3"));
  auto* texture = window.explorer().findChild<QCheckBox*>("option:texture");
  ASSERT_NE(texture, nullptr);
  texture->setChecked(true);
  ASSERT_TRUE(type(named(window.explorer(), "option:texture-size"), "512"));
  window.explorer().run_stage("mesh");
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(store().models().size(), 2u);
  const ModelData& made = *store().models().back().data;
  ASSERT_TRUE(has_texture(made.mesh));
  EXPECT_TRUE(made.report.contains("512 × 512"));
  view().look(StandardView::kFront);
  ASSERT_TRUE(wait_idle(window));
  keep_picture(window, "texture-doll");
  const QImage own = view().screenshot();
  auto* colors = qobject_cast<QComboBox*>(named(window.explorer(), "verdict_colors"));
  ASSERT_NE(colors, nullptr);
  const int views = colors->findData("texture-view");
  ASSERT_GE(views, 0);
  colors->setCurrentIndex(views);
  ASSERT_TRUE(wait_idle(window));
  keep_picture(window, "texture-views");
  EXPECT_NE(view().screenshot(), own);
  ASSERT_TRUE(made.quality && made.quality->texture);
  const TextureReport& report = *made.quality->texture;
  EXPECT_EQ(report.used.size(), report.views);
  std::set<std::uint16_t> used(report.view_of_square.pixels.begin(),
                               report.view_of_square.pixels.end());
  EXPECT_GT(used.size(), 6u);
  const ColoredMesh colored = color_by_view(made.mesh, report);
  ASSERT_NE(colored.drawable, nullptr);
  EXPECT_GT(colored.legend.entries.size(), 6u);
}

}  // namespace
}  // namespace turnscan::studio
