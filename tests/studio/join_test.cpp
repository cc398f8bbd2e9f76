// A pass whose shape does not tell how it lay is joined by places that are clicked on both meshes.

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>

#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "explorer/passes/pass_meshes.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

TEST(PassPoses, AreWrittenAsTheCommandLineReadsThem) {
  for (int i = 0; i < 40; ++i) {
    // Turns of 90 degrees, of which Euler's angles are not the only ones, too.
    const double turn = i < 8 ? i * 0.25 * kTurn : 0.37 * i;
    const Vec3d axis = i < 8 ? Vec3d::UnitY().eval() : Vec3d(1, i, -3).normalized();
    PassPose pose;
    pose.pass = std::uint32_t(i);
    pose.T_first_table =
        Eigen::Translation3d(0.01 * i, -0.16, 1e-5 * i) * Eigen::AngleAxisd(turn, axis);
    const auto read = parse_pass_pose(pass_pose_text(pose));
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_EQ(read->pass, pose.pass);
    EXPECT_TRUE(read->T_first_table.isApprox(pose.T_first_table, 1e-5)) << pass_pose_text(pose);
  }
}

/// A drum in two passes, upright and on its head.
class Joining : public ::testing::Test, FirstStart {
 protected:
  Joining() : store(window.explorer().store()), view(window.explorer().view()) {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
    EXPECT_EQ(run_command_line({"simulate", "builtin:cylinder", "--frames", "16", "--next-pass",
                                "tip=180deg", "--out", folder.filePath("drum")}),
              0);
    window.open(folder.filePath("drum"));
    EXPECT_TRUE(wait_idle(window));
    press("Reconstruct");
  }
  void press(const QString& text) {
    ASSERT_TRUE(click(button_with(window.explorer(), text))) << text.toStdString();
    ASSERT_TRUE(wait_idle(window));
  }
  std::string shown_error() {
    std::string out;
    for (const QLabel* label : window.explorer().findChildren<QLabel*>("error"))
      if (label->isVisible()) out += label->text().toStdString();
    return out;
  }
  std::string said() {
    return static_cast<QLabel*>(named(window.explorer(), "join_text"))->text().toStdString();
  }
  const ModelData& data(std::size_t i) { return *store.models()[i].data; }
  /// On the drum's side; from the front, from above.
  Vec3d place(double degrees, double height) {
    const Box box = bounds(data(1).mesh.vertices);
    const double a = degrees * kRadiansPerDegree, r = box.max.x();
    return {r * std::sin(a), height * box.max.y(), r * std::cos(a)};
  }
  void click_on(const std::vector<Vec3d>& places, int pane) {
    ASSERT_TRUE(wait_for([&] { return view.settled(); }));
    for (const Vec3d& p : places) {
      const QPoint at = (*view.project(p) + QPointF(0.5 * pane * view.width(), 0.0)).toPoint();
      QTest::mouseClick(view.childAt(at), Qt::LeftButton, {}, at);
    }
  }
  /// The left from the front, the right, which the motion brings onto it, from the back.
  void click_pairs(const std::vector<Vec3d>& places, const Pose& T_left_right) {
    view.look(StandardView::kFront);
    click_on(places, 0);
    view.look(StandardView::kBack);
    std::vector<Vec3d> others;
    for (const Vec3d& p : places) others.push_back(T_left_right.inverse() * p);
    click_on(others, 1);
  }
  /// As it was tipped, and shifted along its axis.
  Pose tipped(double shift_m = 0.0) {
    const double height = bounds(data(1).mesh.vertices).max.y();
    return Eigen::Translation3d(0.0, height + shift_m, 0.0) *
           Eigen::AngleAxisd(0.5 * kTurn, Vec3d::UnitX());
  }

  ScansFolder folder;
  MainWindow window;
  ModelStore& store;
  SceneView& view;
};

TEST_F(Joining, ThreePairsSayWhereAPassLies) {
  ASSERT_EQ(store.models().size(), 3u) << shown_error();
  EXPECT_NE(shown_error().find("was not joined"), std::string::npos);
  EXPECT_NE(shown_error().find("Join by points"), std::string::npos);
  press("Pick pairs");
  EXPECT_NE(said().find("Pair 1"), std::string::npos) << said();
  click_pairs({place(-30, 0.25), place(0, 0.5), place(30, 0.75)}, tipped());
  EXPECT_NE(said().find("Pair 4"), std::string::npos) << said();
  EXPECT_NE(shown_error().find("straight line"), std::string::npos) << shown_error();
  EXPECT_FALSE(named(window.explorer(), "join_run")->isEnabled());
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(click(named(window.explorer(), "join_undo")));
  EXPECT_FALSE(named(window.explorer(), "join_undo")->isEnabled());

  click_pairs({place(-40, 0.2), place(40, 0.3), place(5, 0.85)}, tipped());
  EXPECT_NE(said().find("3 pairs, which fit within"), std::string::npos) << said();
  keep_picture(window, "explorer-pairs");
  press("Join");
  ASSERT_EQ(store.models().size(), 4u) << shown_error();
  EXPECT_FALSE(store.models()[1].visible);
  EXPECT_FALSE(store.models()[2].visible);
  const ModelData& joined = data(3);
  ASSERT_NE(joined.passes, nullptr);
  EXPECT_EQ(joined.passes->T_mesh_table.size(), 2u);
  // About the axis it is as exact as the clicks are: the shape leaves that open.
  const Pose off = tipped().inverse() * joined.passes->T_mesh_table.at(1);
  EXPECT_LT(off.translation().norm(), 1e-3);
  EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 3.0 * kRadiansPerDegree);
  EXPECT_TRUE(joined.report.contains("--pass-pose 1=")) << joined.report.toStdString();
  EXPECT_TRUE(check_mesh(joined.mesh).watertight());
  EXPECT_NEAR(bounds(joined.mesh.vertices).max.y(), bounds(data(1).mesh.vertices).max.y(), 5e-4);
  keep_picture(window, "explorer-pairs-joined");

  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(store.models().size(), 3u);
  EXPECT_TRUE(store.models()[1].visible && store.models()[2].visible);
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_EQ(store.models().size(), 4u);
  window.explorer().list().select(store.models()[3].id);
  press("Each pass by itself");
  ASSERT_EQ(store.models().size(), 4u) << shown_error();
  EXPECT_FALSE(store.models()[3].visible);
  for (const std::size_t pass : {0u, 1u}) {  // in the place of those before
    EXPECT_TRUE(store.models()[1 + pass].visible);
    ASSERT_NE(data(1 + pass).passes, nullptr);
    EXPECT_EQ(data(1 + pass).passes->T_mesh_table.begin()->first, pass);
  }
}

TEST_F(Joining, PairsThatTheSurfacesContradictJoinNothing) {
  ASSERT_EQ(store.models().size(), 3u) << shown_error();
  press("Pick pairs");
  click_pairs({place(-40, 0.2), place(40, 0.25), place(5, 0.6)}, tipped(-0.045));
  press("Join");
  EXPECT_EQ(store.models().size(), 3u);
  EXPECT_TRUE(store.models()[1].visible && store.models()[2].visible) << "kept beside each other";
  EXPECT_NE(shown_error().find("was not joined: as it was placed"), std::string::npos)
      << shown_error();
}

TEST_F(Joining, AnEditedMeshIsNoPassAnyMore) {
  ASSERT_EQ(store.models().size(), 3u) << shown_error();
  press("Pick pairs");
  click_pairs({place(-40, 0.2), place(40, 0.3), place(5, 0.85)}, tipped());
  EXPECT_TRUE(named(window.explorer(), "join_run")->isEnabled());
  window.explorer().list().select(store.models()[1].id);
  ASSERT_TRUE(click(named(window.explorer(), "edit_smooth")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(data(1).passes, nullptr);
  EXPECT_FALSE(named(window.explorer(), "join_run")->isEnabled());
  EXPECT_FALSE(named(window.explorer(), "join_pick")->isEnabled());
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(named(window.explorer(), "join_pick")->isEnabled());
}

}  // namespace
}  // namespace turnscan::studio
