// What two models side by side, overlaid or by distance must not do.

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QWheelEvent>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/compare_panel.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "tests/geometry/shapes.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Compare : public ::testing::Test, FirstStart {
 protected:
  Compare() : store(window.explorer().store()), view(window.mode().view()) {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
    open_ball("large", 0.05);
    open_ball("small", 0.03);
  }
  void open_ball(const QString& name, double radius) {
    const QString path = folder.filePath(name + ".ply");
    EXPECT_TRUE(write_mesh(path.toStdString(), test::sphere(radius, 4)));
    window.open(path);
    EXPECT_TRUE(wait_idle(window));
  }
  QPushButton* way(const QString& text) { return button_with(window.explorer(), text); }
  QComboBox* choice(const QString& name) {
    return qobject_cast<QComboBox*>(named(window.explorer(), name));
  }

  ScansFolder folder;
  MainWindow window;
  ModelStore& store;
  SceneView& view;
};

TEST_F(Compare, TheOverlayEndsWhenAnotherModelComesAndThatIsSeen) {
  ASSERT_TRUE(click(way("Overlay")));
  EXPECT_EQ(window.explorer().comparison().way(), ComparePanel::kOverlay);
  store.set_visible(1, false);  // no new model
  EXPECT_EQ(window.explorer().comparison().way(), ComparePanel::kOverlay);
  open_ball("third", 0.08);
  EXPECT_EQ(window.explorer().comparison().way(), ComparePanel::kOff);
  EXPECT_FALSE(way("Overlay")->isChecked());
}

TEST_F(Compare, AMeshWithinAnotherIsSeenThroughIt) {
  ASSERT_TRUE(wait_idle(window));
  store.set_color(1, Qt::white, false);
  store.set_color(2, Qt::red, false);
  ASSERT_TRUE(wait_idle(window));
  const auto redness = [&] {
    const QColor c = view.screenshot().pixelColor(view.rect().center() * view.devicePixelRatioF());
    return c.red() - c.blue();
  };
  EXPECT_LT(redness(), 10) << "the large one covers it";
  ASSERT_TRUE(click(way("Overlay")));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_GT(redness(), 40);
  keep_picture(window, "compare-overlay");
}

TEST_F(Compare, FiguresNameTheirPair) {
  ASSERT_TRUE(click(way("Distances")));
  ASSERT_TRUE(wait_idle(window));
  const auto* figures = qobject_cast<QLabel*>(named(window.explorer(), "compare_figures"));
  ASSERT_NE(figures, nullptr);
  EXPECT_TRUE(figures->text().contains("small to large")) << figures->text().toStdString();
  // One step, which also brings back what was hidden.
  store.undo();
  EXPECT_EQ(store.models().size(), 2u);
  for (const Model& model : store.models()) EXPECT_TRUE(model.visible);
}

TEST_F(Compare, TheWheelScrollsThePanelAndChangesNothing) {
  ASSERT_TRUE(click(way("Overlay")));  // opens the fold
  for (const char* name : {"compare_reference", "compare_model", "deviation_reference",
                           "verdict_colors", "select_how", "cut_axis"}) {
    QComboBox* box = choice(name);
    ASSERT_NE(box, nullptr) << name;
    const int before = box->currentIndex();
    box->setFocus();
    for (const int turn : {-120, 120}) {
      QWheelEvent wheel(box->rect().center(), box->mapToGlobal(box->rect().center()), QPoint(),
                        QPoint(0, turn), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
      QApplication::sendEvent(box, &wheel);
      EXPECT_EQ(box->currentIndex(), before) << name;
    }
  }
}

TEST_F(Compare, OffersWhatCanBeComparedAndSaysWhatCannot) {
  ASSERT_EQ(run_command_line({"simulate", "builtin:letter-a", "-o", folder.filePath("scan"),
                              "--frames", "4", "--scanner", "kinect-v2"}),
            0);
  window.open(folder.filePath("scan"));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(store.models().size(), 3u);
  EXPECT_EQ(choice("compare_reference")->count(), 2);
  EXPECT_EQ(choice("compare_model")->count(), 2);
  PointCloud cloud;
  cloud.points = test::sphere(1.0, 3).vertices;
  ASSERT_TRUE(write_cloud(folder.filePath("cloud.ply").toStdString(), cloud));
  window.open(folder.filePath("cloud.ply"));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(choice("compare_model")->count(), 3);
  QComboBox* reference = choice("compare_reference");
  reference->setCurrentText("cloud");
  Q_EMIT reference->activated(reference->currentIndex());
  EXPECT_FALSE(way("Distances")->isEnabled());
  EXPECT_TRUE(way("Side by side")->isEnabled());
  const auto* note = qobject_cast<QLabel*>(named(window.explorer(), "compare_note"));
  ASSERT_NE(note, nullptr);
  EXPECT_TRUE(note->text().contains("choose one as the reference")) << note->text().toStdString();
  EXPECT_TRUE(note->text().contains("same unit")) << note->text().toStdString();
}

}  // namespace
}  // namespace turnscan::studio
