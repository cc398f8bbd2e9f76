// Inspection in the Model Explorer: deviations, measurements, sections, alignment.

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFile>
#include <QLabel>
#include <QTest>
#include <QTreeWidget>
#include <cmath>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/inspection/deviation_panel.hpp"
#include "explorer/inspection/measure_panel.hpp"
#include "explorer/inspection/section_panel.hpp"
#include "explorer/model_list.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

/// A cylinder (radius 40 mm, 160 mm high) and one that is 1 mm wider, which is selected.
class Inspection : public ::testing::Test, FirstStart {
 protected:
  Inspection() : store(window.explorer().store()), view(window.mode().view()) {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
    TriangleMesh mesh = *builtin_object("cylinder");
    open("cylinder", mesh);
    for (Vec3f& p : mesh.vertices) {
      const float r = std::hypot(p.x(), p.z());
      if (r > 0.0f) p = Vec3f(p.x() * (r + 0.001f) / r, p.y(), p.z() * (r + 0.001f) / r);
    }
    open("wide", mesh);
    view.look(StandardView::kFront);
    EXPECT_TRUE(wait_for([&] { return view.settled(); }));
  }
  void open(const QString& name, const TriangleMesh& mesh) {
    EXPECT_TRUE(write_mesh(folder.filePath(name + ".ply").toStdString(), mesh));
    window.open(folder.filePath(name + ".ply"));
    EXPECT_TRUE(wait_idle(window));
  }
  QWidget* in_panel(const QString& name) { return named(window.explorer(), name); }
  void set_length(const QString& name, double mm) {
    auto* box = qobject_cast<QDoubleSpinBox*>(in_panel(name));
    ASSERT_NE(box, nullptr);
    box->setValue(mm);
    ASSERT_TRUE(wait_idle(window));
  }
  void click_at(const Vec3d& place) {
    const auto at = view.project(place);
    ASSERT_TRUE(at.has_value());
    QTest::mouseClick(view.childAt(at->toPoint()), Qt::LeftButton, {}, at->toPoint());
    ASSERT_TRUE(wait_idle(window));
  }
  std::string shown_error() {
    std::string out;
    for (const QLabel* label : window.explorer().findChildren<QLabel*>("error"))
      if (label->isVisible()) out += label->text().toStdString();
    return out;
  }
  void compute_deviations() {
    ASSERT_TRUE(click(in_panel("deviation_run")));
    ASSERT_TRUE(wait_idle(window));
    ASSERT_EQ(shown_error(), "");
  }
  const std::vector<Measurement>& kept() { return window.explorer().measurements().kept(); }

  ScansFolder folder;
  MainWindow window;
  ModelStore& store;
  SceneView& view;
};

TEST_F(Inspection, ShowsSignedDeviationsWithToleranceAndRange) {
  const QImage before = view.screenshot();
  ASSERT_NO_FATAL_FAILURE(compute_deviations());
  const auto& values = window.explorer().deviations().values();
  const auto& vertices = store.models()[1].data->mesh.vertices;
  ASSERT_EQ(values.size(), vertices.size());
  std::size_t on_side = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::hypot(vertices[i].x(), vertices[i].z()) < 0.0405f) continue;
    EXPECT_NEAR(values[i], 0.001f, 5e-5f);
    ++on_side;
  }
  EXPECT_GT(on_side, 10u);
  auto* figures = qobject_cast<QLabel*>(in_panel("deviation_figures"));
  ASSERT_NE(figures, nullptr);
  EXPECT_TRUE(figures->text().startsWith("wide to cylinder: mean "))
      << figures->text().toStdString();
  const QImage red = view.screenshot();
  EXPECT_NE(red, before);
  keep_picture(window, "inspection-deviations");
  // All within a tolerance of 2 mm: other colours, other figures, no other model.
  set_length("deviation_tolerance", 2.0);
  set_length("deviation_range", 5.0);
  EXPECT_NE(view.screenshot(), red);
  EXPECT_TRUE(figures->text().contains("Within ±2 mm 100.0 %")) << figures->text().toStdString();
  EXPECT_EQ(store.models().size(), 2u);
  const auto legend = window.explorer().deviations().legend();
  ASSERT_TRUE(legend.has_value());
  EXPECT_EQ(legend->entries.front().text, "-5 mm");
  EXPECT_EQ(legend->entries.back().text, "+5 mm");
  window.explorer().deviations().export_csv(folder.filePath("deviations.csv"));
  ASSERT_TRUE(wait_idle(window));
  const QByteArray table = content(folder.filePath("deviations.csv"));
  EXPECT_TRUE(table.startsWith("x_mm,y_mm,z_mm,deviation_mm\n"));
  EXPECT_EQ(std::size_t(table.count('\n')), values.size() + 1);
  // The mesh changes: its deviations are no longer so.
  store.undo();
  EXPECT_FALSE(window.explorer().deviations().legend().has_value());
}

TEST_F(Inspection, MeasuresByClicksKeepsRemovesAndExports) {
  ASSERT_TRUE(click(in_panel("measure_deviation")));
  ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.0, 0.08, 0.041)));
  EXPECT_NE(shown_error().find("press Deviations"), std::string::npos);
  EXPECT_TRUE(kept().empty());
  ASSERT_TRUE(click(in_panel("deviation_run")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.0, 0.08, 0.041)));
  ASSERT_EQ(kept().size(), 1u);
  EXPECT_NEAR(kept()[0].value, 0.001, 5e-5);
  ASSERT_TRUE(click(in_panel("measure_distance")));
  ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.0, 0.030, 0.041)));
  ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.0, 0.130, 0.041)));
  ASSERT_EQ(kept().size(), 2u);
  EXPECT_NEAR(kept()[1].value, 0.100, 0.0015);
  ASSERT_TRUE(click(in_panel("measure_thickness")));
  ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.0, 0.060, 0.041)));
  ASSERT_EQ(kept().size(), 3u);
  EXPECT_NEAR(kept()[2].value, 0.082, 0.001);
  ASSERT_TRUE(click(in_panel("measure_circle")));
  for (const double a : {0.3, 1.4, 2.6})
    ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.041 * std::cos(a), 0.07, 0.041 * std::sin(a))));
  ASSERT_EQ(kept().size(), 4u);
  EXPECT_NEAR(kept()[3].value, 0.082, 0.002);
  ASSERT_TRUE(click(in_panel("measure_angle")));
  for (const Vec3d& p : {Vec3d(-0.02, 0.05, 0.0358), Vec3d(0.0, 0.05, 0.041), Vec3d(0, 0.1, 0.041)})
    ASSERT_NO_FATAL_FAILURE(click_at(p));
  ASSERT_EQ(kept().size(), 5u);
  EXPECT_NEAR(kept()[4].value, 1.5708, 0.03);
  ASSERT_TRUE(click(in_panel("measure_plane")));
  ASSERT_NO_FATAL_FAILURE(click_at(Vec3d(0.0, 0.08, 0.041)));
  ASSERT_EQ(kept().size(), 6u);
  EXPECT_LT(kept()[5].value, 0.002);
  keep_picture(window, "inspection-measurements");
  auto* list = qobject_cast<QTreeWidget*>(in_panel("measurements"));
  ASSERT_NE(list, nullptr);
  ASSERT_EQ(list->topLevelItemCount(), 6);
  const QImage all = view.screenshot();
  list->setCurrentItem(list->topLevelItem(0));
  ASSERT_TRUE(click(in_panel("measure_remove")));
  EXPECT_EQ(kept().size(), 5u);
  EXPECT_NE(view.screenshot(), all);
  window.explorer().measurements().export_csv(folder.filePath("measured.csv"));
  ASSERT_TRUE(wait_idle(window));
  const QByteArray table = content(folder.filePath("measured.csv"));
  EXPECT_EQ(table.count('\n'), 6);
  EXPECT_TRUE(table.contains("\n1,distance,wide,")) << table.toStdString();
  ASSERT_TRUE(click(in_panel("measure_clear")));
  EXPECT_TRUE(kept().empty());
}

TEST_F(Inspection, CutsACappedSectionInMillimetresAndDrawsIt) {
  const QImage whole = view.screenshot();
  view.look(StandardView::kCorner);
  ASSERT_TRUE(click(in_panel("section_on")));
  set_length("section_place", 50.0);
  ASSERT_TRUE(wait_for([&] {
    const auto& made = window.explorer().section().section();
    return made && std::abs(made->offset_m + 0.05) < 1e-9;
  }));
  ASSERT_TRUE(wait_idle(window));
  const auto& made = window.explorer().section().section();
  ASSERT_EQ(made->contours.size(), 1u);
  EXPECT_NEAR(made->area_m2, 3.14159 * 0.041 * 0.041, 3e-5);
  EXPECT_EQ(made->open, 0u);
  // From above one looks at the cap.
  view.look(StandardView::kTop);
  ASSERT_TRUE(wait_for([&] { return view.settled(); }));
  const QColor middle =
      view.screenshot().pixelColor(view.rect().center() * view.devicePixelRatioF());
  EXPECT_GT(middle.red(), middle.blue() + 60);
  view.look(StandardView::kCorner);
  ASSERT_TRUE(wait_for([&] { return view.settled(); }));
  EXPECT_NE(view.screenshot(), whole);
  keep_picture(window, "inspection-section");
  window.explorer().section().export_drawing(folder.filePath("cut.dxf"));
  window.explorer().section().export_drawing(folder.filePath("cut.svg"));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(content(folder.filePath("cut.dxf")).contains("\nPOLYLINE\n"));
  EXPECT_TRUE(content(folder.filePath("cut.svg")).contains("<path d=\"M"));
  ASSERT_TRUE(click(in_panel("section_on")));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_FALSE(window.explorer().section().section().has_value());
  EXPECT_FALSE(store.can_redo());
  EXPECT_EQ(store.history().size(), 2);
}

TEST_F(Inspection, AlignsToAReferenceInOneStepAndSaysTheResidual) {
  TriangleMesh mesh = *builtin_object("letter-a");
  open("letter", mesh);
  Pose away = Pose::Identity();
  away.rotate(Eigen::AngleAxisd(0.05, Vec3d(1, 2, 0).normalized()));
  away.pretranslate(Vec3d(0.002, 0.001, -0.001));
  open("moved", transformed(mesh, away));
  auto* reference = qobject_cast<QComboBox*>(in_panel("deviation_reference"));
  ASSERT_NE(reference, nullptr);
  reference->setCurrentText("letter");
  const int steps = store.history().size();
  ASSERT_TRUE(click(in_panel("deviation_align")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(shown_error(), "");
  EXPECT_EQ(store.history().size(), steps + 1);
  const auto& back = store.models().back().data->mesh.vertices;
  double farthest = 0.0;
  for (std::size_t i = 0; i < back.size(); ++i)
    farthest = std::max(farthest, double((back[i] - mesh.vertices[i]).norm()));
  EXPECT_LT(farthest, 1e-4);
  auto* figures = qobject_cast<QLabel*>(in_panel("deviation_figures"));
  EXPECT_TRUE(figures->text().startsWith("moved to letter: Moved "))
      << figures->text().toStdString();
  EXPECT_TRUE(figures->text().contains("Rms of all points"));
  keep_picture(window, "inspection-aligned");
  store.undo();
  EXPECT_GT((store.models().back().data->mesh.vertices[0] - mesh.vertices[0]).norm(), 1e-4);
}

}  // namespace
}  // namespace turnscan::studio
