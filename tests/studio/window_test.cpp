// What the modes have in common: camera, settings, keys, files that are dropped.

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QMouseEvent>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <QUrl>
#include <QWheelEvent>
#include <atomic>
#include <chrono>
#include <set>
#include <thread>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/models.hpp"
#include "explorer/stage_panel.hpp"
#include "scanner/scanner.hpp"
#include "simulator/simulator.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Window : public ::testing::Test, FirstStart {
 protected:
  Window() : window(std::make_unique<MainWindow>()) {
    show_window(*window, {1100, 760});
    EXPECT_TRUE(write_mesh(mesh_file().toStdString(), *builtin_object("letter-a")));
  }
  QString mesh_file() const { return folder.filePath("letter.ply"); }
  void open_letter() {
    window->open(mesh_file());
    ASSERT_TRUE(wait_idle(*window));
  }
  SceneView& view() { return window->mode().view(); }
  QWidget* canvas() { return view().childAt(view().rect().center()); }
  void drag(Qt::MouseButton button, Qt::KeyboardModifiers keys, const QPoint& by) {
    const QPoint from = canvas()->rect().center();
    QTest::mousePress(canvas(), button, keys, from);
    QMouseEvent move(QEvent::MouseMove, from + by, Qt::NoButton, button, keys);
    QApplication::sendEvent(canvas(), &move);
    QTest::mouseRelease(canvas(), button, keys, from + by);
    EXPECT_TRUE(wait_for([&] { return view().settled(); }));
  }
  /// Where the top of the letter is seen.
  QPointF top() { return view().project(Vec3d(0.0, 0.22, 0.0)).value_or(QPointF()); }

  ScansFolder folder;
  std::unique_ptr<MainWindow> window;
};

TEST_F(Window, MouseAndKeysTurnMoveAndZoom) {
  open_letter();
  const auto front = [&] {
    QTest::keyClick(window.get(), Qt::Key_1);
    ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  };
  front();
  const QPointF seen = top();
  const double scale = view().metres_per_pixel();
  QTest::keyClick(window.get(), Qt::Key_5);
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  EXPECT_NE(top(), seen);
  front();
  EXPECT_NEAR(top().y(), seen.y(), 1.0);
  drag(Qt::LeftButton, Qt::NoModifier, {90, 40});
  EXPECT_NE(top(), seen);
  EXPECT_NEAR(view().metres_per_pixel(), scale, 1e-9);
  front();
  drag(Qt::MiddleButton, Qt::NoModifier, {50, 30});
  EXPECT_NEAR(top().x() - seen.x(), 50.0, 2.0);
  front();
  drag(Qt::LeftButton, Qt::ShiftModifier, {-40, 0});
  EXPECT_NEAR(top().x() - seen.x(), -40.0, 2.0);
  QWheelEvent wheel(canvas()->rect().center(), canvas()->mapToGlobal(canvas()->rect().center()),
                    QPoint(), QPoint(0, 240), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(canvas(), &wheel);
  EXPECT_LT(view().metres_per_pixel(), scale);
  QTest::keyClick(window.get(), Qt::Key_Home);
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  EXPECT_NEAR(view().metres_per_pixel(), scale, 1e-6);
  view().setFocus();
  QTest::keyClick(&view(), Qt::Key_Plus);
  EXPECT_LT(view().metres_per_pixel(), scale);
}

TEST_F(Window, SettingsAreThereAgainInTheNextRun) {
  for (const char* name : {"camera_speed", "point_size"}) {
    auto* slider = window->mode().findChild<QSlider*>(name);
    ASSERT_NE(slider, nullptr);
    QTest::keyClick(slider, Qt::Key_End);
  }
  QTest::keyClick(window.get(), Qt::Key_B);
  QTest::keyClick(window.get(), Qt::Key_D, Qt::ControlModifier | Qt::ShiftModifier);
  QTest::keyClick(window.get(), Qt::Key_F3);
  ASSERT_TRUE(wait_for([&] { return &window->mode() == &window->simulator(); }));
  window->close();
  window = std::make_unique<MainWindow>();
  const ViewSettings& settings = window->settings();
  EXPECT_DOUBLE_EQ(settings.camera_speed(), 10.0);
  EXPECT_DOUBLE_EQ(settings.point_size(), 12.0);
  EXPECT_TRUE(settings.boxes());
  EXPECT_TRUE(settings.dark());
  EXPECT_EQ(&window->mode(), &window->simulator());
  window->settings().set_dark(false);
}

TEST_F(Window, ABoundingBoxIsDrawnAndAPictureIsSaved) {
  open_letter();
  const QImage plain = view().screenshot();
  QTest::keyClick(window.get(), Qt::Key_B);
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  EXPECT_NE(view().screenshot(), plain);
  window->screenshot(folder.filePath("view.png"));
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_EQ(QImage(folder.filePath("view.png")).size(), view().size() * view().devicePixelRatioF());
}

TEST_F(Window, DroppedFilesAreOpenedAndRemembered) {
  QMimeData files;
  files.setUrls({QUrl::fromLocalFile(mesh_file())});
  QDragEnterEvent enter(QPoint(200, 300), Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop(QPointF(200, 300), Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(window.get(), &drop);
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_EQ(window->explorer().store().models().size(), 1u);
  window->close();
  window = std::make_unique<MainWindow>();
  window->show();
  QMenu* recent = nullptr;
  for (QMenu* menu : window->findChildren<QMenu*>())
    if (menu->title() == "Open r&ecent") recent = menu;
  ASSERT_NE(recent, nullptr);
  Q_EMIT recent->aboutToShow();
  ASSERT_EQ(recent->actions().size(), 1);
  EXPECT_EQ(recent->actions().front()->text(), "~/scans/letter.ply");
  recent->actions().front()->trigger();
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_EQ(window->explorer().store().models().size(), 1u);
}

TEST_F(Window, AJobOfUnknownLengthCountsItsSeconds) {
  std::atomic<bool> enough{false};
  window->jobs().start("wait", window.get(),
                       [&](const RunContext& context) -> Result<Finish> {
                         while (!enough && !context.cancelled())
                           std::this_thread::sleep_for(std::chrono::milliseconds(5));
                         return Finish();
                       },
                       {});
  const auto shown = [&] {
    for (const QLabel* label : window->findChildren<QLabel*>())
      if (label->isVisible() && label->text() == "2 s so far") return true;
    return false;
  };
  EXPECT_TRUE(wait_for(shown, 10.0));
  enough = true;
  ASSERT_TRUE(wait_idle(*window));
  EXPECT_FALSE(shown());
}

TEST_F(Window, TheFirstStartOffersWhatToDo) {
  ASSERT_TRUE(click(button_with(window->mode().view(), "Scan an object")));
  EXPECT_TRUE(wait_for([&] { return button_with(window->scanner(), "Stop") != nullptr; }))
      << "it plays";
  window->show_mode("explorer");
  ASSERT_TRUE(click(button_with(window->mode().view(), "Simulate a scan")));
  EXPECT_EQ(&window->mode(), &window->simulator());
  window->show_mode("explorer");
  open_letter();
  EXPECT_FALSE(button_with(window->mode().view(), "Simulate a scan")->isVisible());
}

TEST_F(Window, AMessageIsDismissedByItsCross) {
  window->open(folder.filePath("none.ply"));
  ASSERT_TRUE(wait_idle(*window));
  auto* error = window->explorer().stages().error();
  ASSERT_TRUE(error->isVisible());
  auto* cross = error->findChild<QToolButton*>("dismiss");
  ASSERT_TRUE(cross && cross->isVisible());
  QTest::mouseClick(cross, Qt::LeftButton);
  EXPECT_FALSE(error->isVisible());
}

/// What a widget looks like with the keys and without.
TEST_F(Window, EveryKindOfControlShowsItsFocus) {
  window->activateWindow();
  std::set<std::string> seen;
  std::vector<QWidget*> all;
  for (const char* name : {"explorer", "simulator"}) {
    window->show_mode(name);
    for (QWidget* each : window->mode().findChildren<QWidget*>()) all.push_back(each);
  }
  for (QWidget* each : all) {
    window->show_mode(window->simulator().isAncestorOf(each) ? "simulator" : "explorer");
    const std::string kind = each->metaObject()->className();
    if (!each->isVisible() || !each->isEnabled() || !(each->focusPolicy() & Qt::TabFocus)) continue;
    if (kind.find("Scroll") != std::string::npos) continue;
    if (!seen.insert(kind + each->objectName().section(':', 0, 0).toStdString()).second) continue;
    window->setFocus();
    run_for(20);
    const QImage before = each->grab().toImage();
    each->setFocus(Qt::TabFocusReason);
    run_for(20);
    EXPECT_NE(each->grab().toImage(), before) << kind << " " << each->objectName().toStdString();
  }
  EXPECT_GE(seen.size(), 5u);
}

}  // namespace
}  // namespace turnscan::studio
