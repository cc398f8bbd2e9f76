// How the window looks: sizes, themes, and pictures of the view against kept ones.

#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QPushButton>
#include <QScrollArea>
#include <QTabWidget>
#include <QTest>
#include <cmath>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/model_list.hpp"
#include "scanner/scanner.hpp"
#include "simulator/simulator.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "widgets/section.hpp"
#include "widgets/theme.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Layout : public ::testing::Test, FirstStart {
 protected:
  Layout() {
    window.resize(1440, 900);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
  }
  bool settled() {
    return wait_for([&] { return !window.jobs().busy() && window.mode().view().settled(); });
  }

  ScansFolder folder;
  MainWindow window;
};

/// Buttons and texts of the panel that have less room than they need, by name.
std::string cramped(QWidget& mode) {
  std::string found;
  for (const QWidget* each : mode.findChildren<QWidget*>()) {
    const auto* button = qobject_cast<const QAbstractButton*>(each);
    if (!button || !button->isVisible() || button->text().isEmpty()) continue;
    const QFontMetrics metrics = button->fontMetrics();
    if (button->width() < metrics.horizontalAdvance(button->text()) + 8 ||
        button->height() < metrics.height())
      found += button->text().toStdString() + "; ";
  }
  return found;
}

/// What most people want next in a mode.
QWidget* main_action(MainWindow& window, const std::string& mode) {
  if (mode == "scanner") return named(window.scanner(), "record");
  return button_with(window.mode(), mode == "explorer" ? "Reconstruct" : "Scan");
}

TEST_F(Layout, EveryModeIsUsableOnASmallScreenAndOnALargeOne) {
  // In pixels of the window's own: with two of the screen to one, 4K is half as many.
  const std::vector<QSize> sizes = window.devicePixelRatioF() > 1.0
                                       ? std::vector<QSize>{{1920, 1080}}
                                       : std::vector<QSize>{{1366, 768}, {3840, 2160}};
  for (const QSize size : sizes) {
    window.resize(size);
    for (const char* name : {"scanner", "explorer", "simulator"}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(size.width()));
      window.show_mode(name);
      for (Section* section : window.mode().findChildren<Section*>()) section->set_open(true);
      ASSERT_TRUE(settled());
      ASSERT_TRUE(wait_for([&] { return window.simulator().ready() && settled(); }));
      EXPECT_EQ(window.size(), size);
      // The Explorer has its tree beside the view, too.
      const int percent = std::string(name) == "explorer" ? 55 : 60;
      EXPECT_GT(window.mode().view().width(), size.width() * percent / 100);
      auto* tabs = window.mode().findChild<QTabWidget*>();
      for (int tab = 0; tab < (tabs ? tabs->count() : 1); ++tab) {
        if (tabs) tabs->setCurrentIndex(tab);
        ASSERT_TRUE(settled());
        EXPECT_EQ(cramped(window.mode()), "") << tab;
        EXPECT_FALSE(main_action(window, name)->visibleRegion().isEmpty());
        for (const QScrollArea* area : window.mode().findChildren<QScrollArea*>()) {
          // Its scroll bar comes with the next event.
          const auto fits = [&] { return area->widget()->width() <= area->viewport()->width(); };
          EXPECT_TRUE(!area->isVisible() || wait_for(fits, 5.0)) << tab;
        }
        keep_picture(window, QString("layout-%1-%2-x%3-%4")
                                 .arg(name)
                                 .arg(size.width())
                                 .arg(window.devicePixelRatioF())
                                 .arg(tab));
      }
    }
  }
}

TEST_F(Layout, TextsThatGrowAndShrinkGetTheRoomThatTheyNeed) {
  window.resize(1366, 768);
  const QString file = folder.filePath("letter.ply");  // a mesh, of which there may be texts
  ASSERT_TRUE(write_mesh(file.toStdString(), *builtin_object("letter-a")));
  window.open(file);
  ASSERT_TRUE(settled());
  for (const char* name : {"advice", "verdict_first"}) {
    auto* label = static_cast<ParagraphLabel*>(named(window.explorer(), name));
    QWidget* below = label;  // the part of the panel that it is in
    while (below->parentWidget() && below->parentWidget()->objectName() != "panel_body")
      below = below->parentWidget();
    std::vector<int> heights;
    for (const int lines : {3, 9, 4, 12, 2}) {
      label->show_text(QString("a line of words that is as long as it is. ").repeated(lines));
      // At once: not even one picture is drawn with texts over each other.
      EXPECT_EQ(crowded(window.explorer()), "") << name << " " << lines;
      heights.push_back(below->height() - label->height());
    }
    EXPECT_EQ(heights, std::vector<int>(heights.size(), heights[0])) << name;
    // While another mode is shown, too.
    window.show_mode("simulator");
    label->show_text(QString("a line of words that is as long as it is. ").repeated(20));
    run_for(20);
    window.show_mode("explorer");
    EXPECT_EQ(crowded(window.explorer()), "") << name;
  }
}

TEST_F(Layout, TheDarkThemeReachesEveryMode) {
  window.settings().set_dark(true);
  for (const char* name : {"scanner", "explorer", "simulator"}) {
    window.show_mode(name);
    ASSERT_TRUE(wait_for([&] { return window.simulator().ready() && settled(); }));
    keep_picture(window, QString("dark-%1").arg(name));
    const QImage all = window.grab().toImage().scaled(64, 40).convertToFormat(QImage::Format_RGB32);
    double sum = 0.0;
    for (int y = 0; y < all.height(); ++y)
      for (int x = 0; x < all.width(); ++x) sum += qGray(all.pixel(x, y));
    EXPECT_LT(sum / (all.width() * all.height()), 90.0) << name;
  }
  window.settings().set_dark(false);
}

TEST_F(Layout, TheViewsLookLikeTheKeptPictures) {
  const QString file = folder.filePath("letter.ply");
  ASSERT_TRUE(write_mesh(file.toStdString(), *builtin_object("letter-a")));
  window.open(file);
  ASSERT_TRUE(settled());
  SceneView& view = window.mode().view();
  view.look(StandardView::kCorner);
  ASSERT_TRUE(settled());
  EXPECT_LT(difference_from_kept(view.screenshot(), "explorer-letter"), 0.04);
  // The other side is another picture: the comparison sees it.
  view.look(StandardView::kTop);
  ASSERT_TRUE(settled());
  EXPECT_GT(difference_from_kept(view.screenshot(), "explorer-letter"), 0.04);
  window.show_mode("simulator");
  window.simulator().set_object("builtin:letter-a");
  window.simulator().add_scanner("gocator");
  window.simulator().set_folder(folder.filePath("scan"));
  ASSERT_TRUE(wait_for([&] { return window.simulator().ready(); }));
  ASSERT_TRUE(settled());
  SceneView& rig = window.mode().view();
  rig.look(StandardView::kCorner);
  ASSERT_TRUE(settled());
  EXPECT_LT(difference_from_kept(rig.screenshot(), "simulator-rig"), 0.04);
}

}  // namespace
}  // namespace turnscan::studio
