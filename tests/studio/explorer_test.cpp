#include "explorer/explorer.hpp"

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/model_list.hpp"
#include "explorer/verdict_panel.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Explorer : public ::testing::Test, FirstStart {
 protected:
  Explorer() {
    show_window(window, {1440, 900});
    window.show_mode("explorer");
  }
  QString path(const QString& name) const { return folder.filePath(name); }
  QWidget* in_panel(const QString& name) { return named(window.explorer(), name); }

  ScansFolder folder;
  MainWindow window;
};

/// A small recording of the letter A.
QString record_letter(const ScansFolder& folder) {
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
  auto* method = qobject_cast<QComboBox*>(in_panel("option:method"));
  ASSERT_NE(method, nullptr);
  method->setCurrentText("poisson");
  ASSERT_TRUE(click(in_panel("run:candidates")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(window.explorer().store().models().size(), 2u);
  window.explorer().save_as(2, path("candidates.ply"));
  window.explorer().list().select(1);
  ASSERT_TRUE(click(button_with(window.explorer(), "Reconstruct")));
  ASSERT_TRUE(wait_idle(window));
  ASSERT_EQ(window.explorer().store().models().size(), 3u);
  window.explorer().save_as(3, path("mesh.ply"));
  ASSERT_TRUE(wait_idle(window));
  keep_picture(window, "explorer-mesh");
  EXPECT_GT(busyness(window.mode().view().screenshot()), 0.005);
  ASSERT_EQ(run_command_line({"reconstruct", recording, "-o", path("cli.ply"), "--voxel-size",
                              "3mm", "--method", "poisson", "--save-stage",
                              "candidates=" + path("cli-candidates.ply")}),
            0);
  EXPECT_TRUE(content(path("mesh.ply")) == content(path("cli.ply")));
  EXPECT_TRUE(content(path("candidates.ply")) == content(path("cli-candidates.ply")));
  for (int i = 0; i < 20 && window.explorer().store().can_undo(); ++i)
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(window.explorer().store().models().empty());
}

TEST_F(Explorer, ShowsTheVerdictOfTheCommandLineAndExportsItsReport) {
  const QString recording = record_letter(folder);
  window.open(recording);
  ASSERT_TRUE(wait_idle(window));
  ASSERT_TRUE(click(button_with(window.explorer(), "Reconstruct")));
  ASSERT_TRUE(wait_idle(window));
  QByteArray told;
  ASSERT_EQ(run_command_line({"reconstruct", recording, "-o", path("cli.ply")}, &told), 0);
  const QStringList lines = window.explorer().verdict().text().split('\n');
  ASSERT_GT(lines.size(), 3);
  EXPECT_TRUE(told.contains("Verdict: " + lines[0].section(' ', -1).toUtf8()))
      << told.toStdString();
  for (const QString& sentence : lines.mid(1))
    EXPECT_TRUE(QString::fromUtf8(told).contains(sentence)) << sentence.toStdString();
  auto* colors = qobject_cast<QComboBox*>(in_panel("verdict_colors"));
  ASSERT_NE(colors, nullptr);
  ASSERT_EQ(colors->count(), 4);  // own, expected error, seen by, invented
  const QImage own = window.mode().view().screenshot();
  std::vector<QImage> shown = {own};
  for (int i = 1; i < colors->count(); ++i) {
    colors->setCurrentIndex(i);
    ASSERT_TRUE(wait_idle(window));
    keep_picture(window, "verdict-" + colors->currentData().toString());
    shown.push_back(window.mode().view().screenshot());
    for (std::size_t j = 0; j + 1 < shown.size(); ++j) EXPECT_NE(shown[j], shown.back()) << i << j;
  }
  colors->setCurrentIndex(0);
  ASSERT_TRUE(wait_idle(window));
  EXPECT_EQ(window.mode().view().screenshot(), own);
  window.explorer().export_report(2, path("letter.html"));
  ASSERT_TRUE(wait_idle(window));
  const QByteArray page = content(path("letter.html"));
  EXPECT_TRUE(page.startsWith("<!doctype html>"));
  EXPECT_TRUE(page.contains(lines[1].toHtmlEscaped().toUtf8()));
  window.explorer().list().select(1);  // the recording: nothing is known of a mesh
  EXPECT_FALSE(button_with(window.explorer(), "Export report…")->isEnabled());
  window.explorer().export_report(2, "/proc/letter.html");
  ASSERT_TRUE(wait_idle(window));
  EXPECT_FALSE(QFile::exists("/proc/letter.html"));
}

/// A bumpy ball of n points.
PointCloud ball_of(std::size_t n) {
  PointCloud cloud;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  cloud.points.reserve(n);
  while (cloud.size() < n) {
    const Vec3f p(unit(random), unit(random), unit(random));
    const float length = p.norm();
    if (length > 1.0f || length < 0.1f) continue;
    cloud.points.push_back((0.1f + 0.004f * std::sin(40.0f * p.x() / length)) * p / length);
  }
  return cloud;
}

void turn_by_dragging(QWidget* canvas, const QPoint& from) {
  QTest::mousePress(canvas, Qt::LeftButton, {}, from);
  for (int i = 1; i <= 40; ++i) {
    QMouseEvent move(QEvent::MouseMove, from + QPoint(4 * i, i), Qt::NoButton, Qt::LeftButton, {});
    QApplication::sendEvent(canvas, &move);
    run_for(15);
  }
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, from + QPoint(160, 40));
}

TEST_F(Explorer, TurnsAndFiltersALargeCloudWithoutFreezing) {
  // As many as the suite can wait for, and more than are drawn while the view turns.
  const char* wanted = std::getenv("TURNSCAN_STUDIO_POINTS");
  const std::size_t n = wanted ? std::size_t(std::atol(wanted)) : 400000;
  ASSERT_TRUE(write_cloud(path("large.ply").toStdString(), ball_of(n)));
  ASSERT_TRUE(wait_idle(window));  // the window itself has opened
  StallWatch watch;
  std::string figures;
  const auto note = [&](const char* what) {
    char text[96];
    std::snprintf(text, sizeof text, ", %s %.0f (%.0f)", what, watch.longest_ms(),
                  watch.longest_cpu_ms());
    figures += text;
    watch.reset();
  };
  window.open(path("large.ply"));
  ASSERT_TRUE(wait_for([&] { return !window.jobs().busy(); }, 300));
  note("loading");
  SceneView& view = window.mode().view();
  ASSERT_TRUE(wait_for([&] { return view.settled(); }, 300));
  note("then at rest");
  QWidget* canvas = view.childAt(view.rect().center());
  ASSERT_NE(canvas, nullptr);
  const QPoint from = canvas->rect().center();
  watch.reset();
  turn_by_dragging(canvas, from);
  note("moving");
  EXPECT_LE(view.points_while_moving(), 200000u);
  ASSERT_TRUE(wait_for([&] { return view.settled(); }, 300));
  note("then at rest");
  ASSERT_TRUE(click(in_panel("run:outliers")));
  ASSERT_TRUE(wait_idle(window, 300));
  EXPECT_EQ(window.explorer().store().models().size(), 2u);
  note("filtering");
  // Figures for the record; no time is asserted, for the machine may be busy.
  std::printf("%zu points, longest stalls in ms (of it processor time of the thread)%s\n", n,
              figures.c_str());
  keep_picture(window, "explorer-cloud");
}

/// Two cylinders, the second a little wider along x, seen from the front.
class TwoCylinders : public Explorer {
 protected:
  TwoCylinders() : store(window.explorer().store()), view(window.mode().view()) {
    TriangleMesh mesh = *builtin_object("cylinder");
    EXPECT_TRUE(write_mesh(path("cylinder.ply").toStdString(), mesh));
    for (Vec3f& p : mesh.vertices) p.x() *= 1.01f;
    EXPECT_TRUE(write_mesh(path("wide.ply").toStdString(), mesh));
    window.open(path("cylinder.ply"));
    window.open(path("wide.ply"));
    EXPECT_TRUE(wait_idle(window));
    EXPECT_EQ(store.models().size(), 2u);
    view.look(StandardView::kFront);
    EXPECT_TRUE(wait_for([&] { return view.settled(); }));
  }

  /// To the bytes of the command line.
  void compare_distances() {
    ASSERT_TRUE(click(button_with(window.explorer(), "Distances")));
    ASSERT_TRUE(wait_idle(window));
    ASSERT_EQ(store.models().size(), 3u);
    keep_picture(window, "explorer-distances");
    ASSERT_EQ(run_command_line({"evaluate", path("wide.ply"), "--reference", path("cylinder.ply"),
                                "--error-map", path("cli.ply")}),
              0);
    window.explorer().save_as(3, path("studio.ply"));
    ASSERT_TRUE(wait_idle(window));
    EXPECT_TRUE(content(path("studio.ply")) == content(path("cli.ply")));
  }

  void compare_side_by_side() {
    ASSERT_TRUE(click(button_with(window.explorer(), "Side by side")));
    ASSERT_TRUE(wait_for([&] { return view.settled(); }));
    keep_picture(window, "explorer-side-by-side");
    ASSERT_TRUE(click(button_with(window.explorer(), "Side by side")));
  }

  ModelStore& store;
  SceneView& view;
};

TEST_F(TwoCylinders, AreComparedAndAllIsUndone) {
  ASSERT_NO_FATAL_FAILURE(compare_distances());
  ASSERT_NO_FATAL_FAILURE(compare_side_by_side());
  for (int i = 0; i < 40 && store.can_undo(); ++i)
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(store.models().empty());
  for (int i = 0; i < 40 && store.can_redo(); ++i)
    QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(store.models().size(), 3u);
}

TEST_F(Explorer, SaysWhatIsWrongWithAFileInTheWordsOfTheCommandLine) {
  QFile file(path("broken.ply"));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("ply\nformat ascii 1.0\nelement vertex 5\nend_header\n");
  file.close();
  window.open(path("broken.ply"));
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(window.explorer().store().models().empty());
  bool shown = false;
  for (const QLabel* label : window.explorer().findChildren<QLabel*>("error"))
    shown = shown || (label->isVisible() && label->text().contains("broken.ply"));
  EXPECT_TRUE(shown);
}

}  // namespace
}  // namespace turnscan::studio
