// How long the window's thread is busy at a stretch: while a sensor delivers and is recorded, and
// with large textures. Figures for the record, printed; only what does not depend on how busy the
// machine is is asserted.
//   TURNSCAN_LIVE_SECONDS=20     how long it records
//   TURNSCAN_TEXTURE_PIXELS=4096 the side of the texture

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QSpinBox>
#include <QTest>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "scanner/record_panel.hpp"
#include "scanner/scanner.hpp"
#include "tests/geometry/shapes.hpp"
#include "view/picture_halves.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

int stated(const char* variable, int otherwise) {
  const int value = qEnvironmentVariableIntValue(variable);
  return value > 0 ? value : otherwise;
}

class Stalls : public ::testing::Test, FirstStart {
 protected:
  Stalls() { show_window(window, {1366, 768}); }
  void note(const char* what) {
    std::printf("%s: longest stall %.0f ms, %.0f ms of it processor time of the thread\n", what,
                watch.longest_ms(), watch.longest_cpu_ms());
    std::fflush(stdout);
    watch.reset();
  }

  ScansFolder folder;
  MainWindow window;
  StallWatch watch;
};

TEST_F(Stalls, ASensorOf30FramesASecondIsRecordedWhileTheSurfaceGrows) {
  window.show_mode("scanner");
  ScannerMode& mode = window.scanner();
  mode.recording().set_folder(folder.filePath("recording"));
  // 512 x 424, rendered before, so that only what a real sensor costs is counted.
  mode.set_device(
      "virtual:doll?sensor=kinect-v2&calibration=true&prepared=240&frames=24000&turns=100"
      "&realtime=1");
  const int seconds = stated("TURNSCAN_LIVE_SECONDS", 4);
  ASSERT_TRUE(type(named(mode, "option:seconds"), "600"));
  for (QCheckBox* box : mode.findChildren<QCheckBox*>())
    if (box->text() == "Make the mesh when it is done") box->setChecked(false);
  ASSERT_TRUE(type(named(mode, "option:speed"), "45"));  // a turn in 240 frames of 30 a second
  watch.reset();
  ASSERT_TRUE(click(button_with(mode, "Play")));
  QWidget* record = named(mode, "record");
  ASSERT_TRUE(wait_for([&] { return record->isEnabled(); }, 180.0));
  run_for(500);
  note("opening the sensor");
  run_for(1000);
  note("playing");
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] { return mode.is_recording(); }));
  run_for(1000 * (seconds - 1));
  note("recording");
  const LiveUpdates updates = mode.updates();
  // A busy machine may need longer for its first surface.
  EXPECT_TRUE(
      wait_for([&] { return mode.updates().coverages > 0 && mode.updates().surfaces > 0; }));
  ASSERT_TRUE(click(record));
  ASSERT_TRUE(wait_for([&] { return !mode.is_recording(); }));
  const auto recording = Recording::open(folder.filePath("recording").toStdString());
  ASSERT_TRUE(recording.has_value());
  std::size_t dropped = 0;
  for (const FrameInfo& info : recording->frames())
    dropped += info.status == FrameStatus::kDropped ? 1 : 0;
  std::printf(
      "%zu frames, %zu dropped; updates a second: %.1f pictures, %.1f of the coverage, %.1f "
      "surfaces\n",
      recording->frames().size(), dropped, double(updates.pictures) / (seconds - 1),
      double(updates.coverages) / (seconds - 1), double(updates.surfaces) / (seconds - 1));
}

/// A ball whose picture is as wide as it is high, with squares of many colours.
TriangleMesh painted_ball(int pixels) {
  TriangleMesh mesh = test::sphere(0.05, 6);
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(pixels, pixels, Rgb{});
  for (int y = 0; y < pixels; ++y)
    for (int x = 0; x < pixels; ++x)
      texture->image.at(x, y) = {std::uint8_t(x * 7), std::uint8_t(y * 5), std::uint8_t(x ^ y)};
  for (const auto& triangle : mesh.triangles) {
    std::array<Eigen::Vector2f, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f p = mesh.vertices[triangle[k]].normalized();
      corners[k] = {0.5f + std::atan2(p.z(), p.x()) / (2.0f * std::numbers::pi_v<float>),
                    0.5f - std::asin(p.y()) / std::numbers::pi_v<float>};
    }
    texture->corners.push_back(corners);
  }
  mesh.texture = std::move(texture);
  return mesh;
}

TEST(PictureHalves, AreTheMeansOfWhatEachPixelStandsFor) {
  ColorImage picture(9, 4, Rgb{});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 9; ++x) picture.at(x, y) = {std::uint8_t(20 * x), std::uint8_t(40 * y), 77};
  const std::vector<ColorImage> halves = halves_of(picture);
  std::vector<std::pair<int, int>> sizes;
  for (const ColorImage& half : halves) sizes.emplace_back(half.width, half.height);
  EXPECT_EQ(sizes, (std::vector<std::pair<int, int>>{{4, 2}, {2, 1}, {1, 1}}));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(halves[0].at(x, y),
                (Rgb{std::uint8_t(40 * x + 10), std::uint8_t(80 * y + 20), 77}));
}

TEST_F(Stalls, ALargeTextureIsOpenedAndEdited) {
  const int pixels = stated("TURNSCAN_TEXTURE_PIXELS", 2048);
  const QString file = folder.filePath("ball.glb");
  ASSERT_TRUE(write_mesh(file.toStdString(), painted_ball(pixels)));
  window.show_mode("explorer");
  ASSERT_TRUE(wait_idle(window));
  watch.reset();
  window.open(file);
  ASSERT_TRUE(wait_idle(window));
  note("opening");
  EXPECT_GT(busyness(window.explorer().view().screenshot()), 0.02) << "the texture is seen";
  ASSERT_TRUE(click(named(window.explorer(), "select_all")));
  ASSERT_TRUE(wait_idle(window));
  watch.reset();
  ASSERT_TRUE(click(named(window.explorer(), "edit_smooth")));
  ASSERT_TRUE(wait_idle(window));
  note("smoothing");
  EXPECT_TRUE(has_texture(window.explorer().store().models().front().data->mesh));
  QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(wait_idle(window));
  note("undoing");
}

TEST_F(Stalls, VoxelsOf150CubedTurnAsCubes) {
  // A ball's surface, with as many voxels as a figure's.
  constexpr int kHalf = 75;
  PointCloud cloud;
  for (int x = -kHalf; x < kHalf; ++x)
    for (int y = -kHalf; y < kHalf; ++y)
      for (int z = -kHalf; z < kHalf; ++z) {
        const Vec3f p(float(x) + 0.5f, float(y) + 0.5f, float(z) + 0.5f);
        if (std::abs(p.norm() - 74.0f) > 0.65f) continue;
        cloud.points.push_back(0.002f * p);
        cloud.weights.push_back(float(100 + x));
      }
  const QString file = folder.filePath("voxels.ply");
  ASSERT_TRUE(write_cloud(file.toStdString(), cloud));
  window.resize(1280, 800);
  window.show_mode("explorer");
  window.open(file);
  ASSERT_TRUE(wait_idle(window));
  watch.reset();
  SceneView& view = window.mode().view();
  const QImage points = view.screenshot();
  qobject_cast<QCheckBox*>(named(window.explorer(), "voxel_cubes"))->setChecked(true);
  ASSERT_TRUE(wait_for([&] { return view.screenshot() != points; }));
  ASSERT_TRUE(wait_for([&] { return view.settled(); }));
  note("Cubes made");
  keep_picture(window, "voxels-150");
  constexpr int kFrames = 60;
  const CameraPlace first = view.camera();
  QElapsedTimer clock;
  clock.start();
  const std::clock_t busy = std::clock();
  for (int i = 0; i < kFrames; ++i) {
    CameraPlace place = first;
    place.position =
        first.focus + Eigen::AngleAxisd(0.1 * i, Vec3d::UnitY()) * (first.position - first.focus);
    view.set_camera(place);
    QApplication::processEvents();
  }
  std::printf("%zu voxels as cubes: %.1f frames a second, %.0f ms of processor time each\n",
              cloud.size(), 1e3 * kFrames / double(clock.elapsed()),
              1e3 * double(std::clock() - busy) / CLOCKS_PER_SEC / kFrames);
  auto* least = qobject_cast<QSpinBox*>(named(window.explorer(), "voxel_least"));
  clock.restart();
  const QImage before = view.screenshot();
  least->setValue(100);
  ASSERT_TRUE(wait_for([&] { return view.screenshot() != before; }));
  std::printf("after another threshold: shown in %lld ms\n", clock.elapsed());
}

}  // namespace
}  // namespace turnscan::studio
