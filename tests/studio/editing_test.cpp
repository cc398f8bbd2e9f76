// Editing in the Model Explorer: selections on the screen, edits of one step each, the history.

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QMouseEvent>
#include <QSpinBox>
#include <QTest>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/editing/edit_panel.hpp"
#include "explorer/explorer.hpp"
#include "explorer/loading.hpp"
#include "explorer/model_list.hpp"
#include "tests/geometry/shapes.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

/// Two balls beside each other in one mesh, seen from the front.
class Editing : public ::testing::Test, FirstStart {
 protected:
  Editing() : store(window.explorer().store()), view(window.mode().view()) {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
    TriangleMesh mesh = test::sphere(0.03, 5, Vec3d(-0.04, 0.05, 0));
    each = mesh.triangles.size();
    test::append(mesh, test::sphere(0.03, 5, Vec3d(0.04, 0.05, 0)));
    const QString path = folder.filePath("balls.ply");
    EXPECT_TRUE(write_mesh(path.toStdString(), mesh));
    window.open(path);
    EXPECT_TRUE(wait_idle(window));
    view.look(StandardView::kFront);
    EXPECT_TRUE(wait_for([&] { return view.settled(); }));
  }
  QWidget* in_panel(const QString& name) { return named(window.explorer(), name); }
  QPoint at(double x, double y) {
    return view.project(Vec3d(x, y, 0.0)).value_or(QPointF()).toPoint();
  }
  /// Drags through places of the plane z = 0, metres.
  void drag(const std::vector<std::pair<double, double>>& way,
            Qt::KeyboardModifiers keys = Qt::NoModifier) {
    QWidget* canvas = view.childAt(view.rect().center());
    QTest::mousePress(canvas, Qt::LeftButton, keys, at(way[0].first, way[0].second));
    for (const auto& [x, y] : way) {
      QMouseEvent move(QEvent::MouseMove, at(x, y), Qt::NoButton, Qt::LeftButton, keys);
      QApplication::sendEvent(canvas, &move);
    }
    QTest::mouseRelease(canvas, Qt::LeftButton, keys, at(way.back().first, way.back().second));
    ASSERT_TRUE(wait_idle(window));
  }
  void press(const QString& name) {
    ASSERT_TRUE(click(in_panel(name))) << name.toStdString();
    ASSERT_TRUE(wait_idle(window));
  }
  std::size_t selected() { return window.explorer().edits().selected(); }
  const TriangleMesh& mesh() { return store.models().front().data->mesh; }
  std::string shown_error() {
    std::string out;
    for (const QLabel* label : window.explorer().findChildren<QLabel*>("error"))
      if (label->isVisible()) out += label->text().toStdString();
    return out;
  }

  ScansFolder folder;
  MainWindow window;
  ModelStore& store;
  SceneView& view;
  std::size_t each = 0;
};

TEST_F(Editing, SmallPiecesAreSelectedAndTheirDeletionLeavesTheRest) {
  press("select_small");
  EXPECT_NE(shown_error().find("there are none"), std::string::npos) << shown_error();
  TriangleMesh crumbs = mesh();
  for (int i = 0; i < 3; ++i)
    test::append(crumbs, test::sphere(0.002, 1, Vec3d(0.02 * i - 0.02, 0.12, 0)));
  store.set_data(1, mesh_model(crumbs, "a test"), "crumbs");
  press("select_small");
  EXPECT_EQ(selected(), crumbs.triangles.size() - 2 * each);
  press("edit_delete");
  EXPECT_EQ(mesh().triangles.size(), 2 * each);
}

TEST_F(Editing, AHiddenModelSaysSoWhenSomebodySelectsOnTheScreen) {
  store.set_visible(1, false);
  press("select_rectangle");
  drag({{-0.08, 0.09}, {-0.005, 0.01}});
  EXPECT_EQ(selected(), 0u);
  EXPECT_NE(shown_error().find("is hidden"), std::string::npos) << shown_error();
}

TEST_F(Editing, RectangleShowsWhatIsVisibleOrThroughBeforeItIsDeleted) {
  const QImage plain = view.screenshot();
  press("select_rectangle");
  // Around the left ball.
  drag({{-0.08, 0.09}, {-0.005, 0.01}});
  const std::size_t front = selected();
  EXPECT_GT(front, each * 3 / 10);
  EXPECT_LT(front, each * 6 / 10);
  EXPECT_EQ(mesh().triangles.size(), 2 * each) << "a selection changes nothing";
  EXPECT_NE(view.screenshot(), plain);
  keep_picture(window, "editing-rectangle");
  ASSERT_TRUE(click(in_panel("select_through")));
  drag({{-0.08, 0.09}, {-0.005, 0.01}});
  EXPECT_EQ(selected(), each);
  const int steps = store.history().size();
  QTest::keyClick(&window, Qt::Key_Delete);
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(store.models().size(), 1u) << "the part, not the model";
  EXPECT_EQ(mesh().triangles.size(), each);
  EXPECT_GT(bounds(mesh().vertices).min.x(), 0.0);
  EXPECT_EQ(store.history().size(), steps + 1);
  EXPECT_EQ(selected(), 0u);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(mesh().triangles.size(), 2 * each);
  EXPECT_EQ(selected(), each) << "as it was before";
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(selected(), front) << "each selection is a step, too";
}

TEST_F(Editing, SelectionsAreAddedSubtractedInvertedGrownAndFollowed) {
  ASSERT_TRUE(click(in_panel("select_through")));
  press("select_lasso");
  drag({{-0.08, 0.09}, {-0.08, 0.01}, {-0.04, 0.01}, {-0.04, 0.09}});  // the left half of the left
  const std::size_t half = selected();
  EXPECT_NEAR(double(half), 0.5 * double(each), 0.05 * double(each));
  drag({{0.0, 0.09}, {0.0, 0.01}, {0.08, 0.01}, {0.08, 0.09}}, Qt::ShiftModifier);
  EXPECT_EQ(selected(), half + each);
  drag({{0.0, 0.09}, {0.0, 0.01}, {0.08, 0.01}, {0.08, 0.09}}, Qt::ControlModifier);
  EXPECT_EQ(selected(), half);
  qobject_cast<QComboBox*>(in_panel("select_how"))->setCurrentIndex(1);  // add
  drag({{0.0, 0.09}, {0.0, 0.01}, {0.08, 0.01}, {0.08, 0.09}});
  EXPECT_EQ(selected(), half + each);
  press("select_invert");
  EXPECT_EQ(selected(), each - half);
  press("select_grow");
  const std::size_t more = selected();
  EXPECT_GT(more, each - half);
  EXPECT_LT(more, each - half + 1200);
  press("select_shrink");
  EXPECT_LT(selected(), more);
  press("select_connected");
  EXPECT_EQ(selected(), each);
  press("select_none");
  EXPECT_EQ(selected(), 0u);
  press("select_all");
  EXPECT_EQ(selected(), 2 * each);
}

TEST_F(Editing, TheBrushPaintsOnTheNearSideOnly) {
  press("select_brush");
  drag({{-0.06, 0.05}, {-0.02, 0.05}});
  const std::size_t stroke = selected();
  EXPECT_GT(stroke, 100u);
  const auto& chosen = window.explorer().edits().selection();
  for (std::size_t t = 0; t < chosen.size(); ++t) {
    if (chosen[t] == 0) continue;
    ASSERT_GT(mesh().vertices[mesh().triangles[t][0]].z(), -0.012f) << t;
  }
  keep_picture(window, "editing-brush");
  qobject_cast<QSpinBox*>(in_panel("brush_radius"))->setValue(40);
  drag({{-0.06, 0.05}, {-0.02, 0.05}});
  EXPECT_GT(selected(), 2 * stroke);
}

TEST_F(Editing, FillsSmoothsReducesAndCutsInOneStepEach) {
  ASSERT_TRUE(click(in_panel("select_through")));
  press("select_rectangle");
  drag({{-0.07, 0.09}, {-0.01, 0.07}});  // the top of the left ball
  press("edit_delete");
  EXPECT_FALSE(check_mesh(mesh()).closed);
  const int steps = store.history().size();
  press("edit_fill");
  EXPECT_TRUE(check_mesh(mesh()).watertight()) << shown_error();
  EXPECT_EQ(store.history().size(), steps + 1);
  press("edit_fill");
  EXPECT_NE(shown_error().find("the mesh has none"), std::string::npos);
  EXPECT_EQ(store.history().size(), steps + 1) << "nothing was done";
  press("edit_smooth");
  EXPECT_EQ(store.history().size(), steps + 2);
  qobject_cast<QSpinBox*>(in_panel("reduce_triangles"))->setValue(4000);
  press("edit_reduce");
  EXPECT_LE(mesh().triangles.size(), 4000u);
  EXPECT_GT(mesh().triangles.size(), 3500u);
  EXPECT_EQ(store.history().size(), steps + 3);
  press("cut_on");
  qobject_cast<QDoubleSpinBox*>(in_panel("cut_place"))->setValue(50.0);
  ASSERT_TRUE(wait_idle(window));
  keep_picture(window, "editing-cut");
  press("plane_cut");
  EXPECT_EQ(store.history().size(), steps + 4);
  EXPECT_NEAR(bounds(mesh().vertices).min.y(), 0.05, 1e-6);
  EXPECT_TRUE(check_mesh(mesh()).watertight()) << "the cut is closed";
  // Each by one Ctrl+Z, and all at once by the history.
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_LT(bounds(mesh().vertices).min.y(), 0.03);
  EXPECT_LE(mesh().triangles.size(), 4000u);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_GT(mesh().triangles.size(), 10000u);
}

TEST_F(Editing, TheHistoryLeadsToEachStateAndBack) {
  press("select_all");
  press("edit_smooth");
  qobject_cast<QSpinBox*>(in_panel("reduce_triangles"))->setValue(4000);
  press("edit_reduce");
  auto* list = qobject_cast<QListWidget*>(in_panel("history"));
  ASSERT_NE(list, nullptr);
  ASSERT_EQ(list->count(), 5);  // start, open, select, smooth, reduce
  EXPECT_EQ(list->currentRow(), 4);
  EXPECT_EQ(list->item(4)->text(), "reduce");
  ASSERT_TRUE(click(list));
  keep_picture(window, "editing-history");
  const auto go = [&](int row) {
    list->scrollToItem(list->item(row));
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {},
                      list->visualItemRect(list->item(row)).center());
    ASSERT_TRUE(wait_for([&] { return int(store.place_in_history()) == row; }));
    EXPECT_EQ(list->currentRow(), row);
  };
  go(1);
  EXPECT_EQ(mesh().triangles.size(), 2 * each);
  go(0);
  EXPECT_TRUE(store.models().empty());
  go(2);
  EXPECT_EQ(selected(), 2 * each) << "what was selected is again";
  go(4);
  EXPECT_LE(mesh().triangles.size(), 4000u);
  EXPECT_EQ(list->count(), 5);
}

TEST_F(Editing, PointsOfACloudAreSelectedAndDeleted) {
  PointCloud cloud;
  cloud.points = test::sphere(0.03, 5, Vec3d(0.0, 0.05, 0.0)).vertices;
  ASSERT_TRUE(write_cloud(folder.filePath("cloud.ply").toStdString(), cloud));
  window.open(folder.filePath("cloud.ply"));
  ASSERT_TRUE(wait_idle(window));
  press("select_rectangle");
  drag({{-0.05, 0.05}, {0.05, 0.01}});
  const std::size_t some = selected();
  EXPECT_GT(some, cloud.size() / 8);
  EXPECT_LT(some, cloud.size() / 2);
  press("edit_delete");
  EXPECT_EQ(store.models().back().data->cloud.size(), cloud.size() - some);
  EXPECT_FALSE(in_panel("edit_smooth")->isEnabled());
}

}  // namespace
}  // namespace turnscan::studio
