#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/workflow/scan/live_surface.hpp>

#include "tests/support/rig.hpp"

namespace turnscan {
namespace {

using namespace std::chrono_literals;

constexpr int kFrames = 40;

testing::Rig ball_rig() {
  testing::RigOptions o = testing::near_rig(kFrames, 1.0);
  o.objects = {place(*builtin_object("ball"), 0.0, 0.0, 0.0)};
  return testing::Rig(o);
}

LiveMotion true_motion(const testing::Rig& rig) {
  return {rig.truth(), kTurn / kFrames, rig.frames().front().time_s};
}

/// The newest mesh of that many frames; an empty one after a minute.
TriangleMesh mesh_of(LiveSurface& surface, std::size_t frames) {
  for (int i = 0; i < 6000; ++i) {
    if (auto update = surface.take(); update && update->frames == frames)
      return std::move(update->mesh);
    std::this_thread::sleep_for(10ms);
  }
  return {};
}

/// Of the distances of the vertices above the platter to the ball's surface.
double median_error_m(const TriangleMesh& mesh, const TriangleMesh& ball) {
  Box box;
  for (const Vec3f& p : ball.vertices) box.add(p.cast<double>());
  const Vec3d center = box.center();
  const double radius = 0.5 * box.size().y();
  std::vector<double> errors;
  for (const Vec3f& p : mesh.vertices) {
    const double distance = (p.cast<double>() - center).norm();
    if (double(p.y()) > 0.5 * radius) errors.push_back(std::abs(distance - radius));
  }
  if (errors.empty()) return 1.0;
  std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

TEST(LiveSurface, HasTheShapeOfTheObjectThoughTheMotionIsFoundLate) {
  const testing::Rig rig = ball_rig();
  const TriangleMesh ball = place(*builtin_object("ball"), 0.0, 0.0, 0.0);
  LiveSurface surface(rig.header());
  for (std::size_t i = 0; i < rig.frames().size(); ++i) surface.add(*rig.read(i));
  EXPECT_FALSE(surface.take());  // nothing says yet where the frames belong
  EXPECT_EQ(surface.frames().size(), rig.frames().size());
  LiveMotion wrong = true_motion(rig);
  wrong.speed_rad_s = 0.5 * *wrong.speed_rad_s;
  surface.set_motion(wrong);
  surface.set_motion(true_motion(rig));  // found once more, better
  const TriangleMesh mesh = mesh_of(surface, rig.frames().size());
  ASSERT_FALSE(mesh.empty());
  EXPECT_LT(median_error_m(mesh, ball), 0.002);
}

TEST(LiveSurface, KeepsABoundedNumberOfFramesSpreadOverTheWholeTime) {
  const testing::Rig rig = ball_rig();
  LiveSurface surface(rig.header());
  Frame frame = *rig.read(0);
  constexpr int kMany = 5 * int(LiveSurface::kMaxFrames);
  for (int i = 0; i < kMany; ++i) {
    frame.info.index = std::uint32_t(i);
    surface.add(frame);
  }
  const auto kept = surface.frames();
  ASSERT_GT(kept.size(), LiveSurface::kMaxFrames / 2);
  ASSERT_LE(kept.size(), LiveSurface::kMaxFrames);
  const std::uint32_t step = kept[1]->info.index - kept[0]->info.index;
  for (std::size_t i = 1; i < kept.size(); ++i)
    EXPECT_EQ(kept[i]->info.index - kept[i - 1]->info.index, step);
  EXPECT_GT(kept.back()->info.index + step, std::uint32_t(kMany - 1));
}

TEST(LiveSurface, KeepsFramesWhileItRestsAndMakesNoMesh) {
  const testing::Rig rig = ball_rig();
  LiveSurface surface(rig.header());
  surface.rest(true);
  surface.set_motion(true_motion(rig));
  for (std::size_t i = 0; i < rig.frames().size(); ++i) surface.add(*rig.read(i));
  std::this_thread::sleep_for(1s);
  EXPECT_FALSE(surface.take());
  surface.rest(false);
  EXPECT_FALSE(mesh_of(surface, rig.frames().size()).empty());
}

TEST(LiveSurface, EndsAtOnceWhileFramesWait) {
  const testing::Rig rig = ball_rig();
  const auto surface = std::make_unique<LiveSurface>(rig.header());
  for (std::size_t i = 0; i < rig.frames().size(); ++i) surface->add(*rig.read(i));
  surface->set_motion(true_motion(rig));
  // The destructor joins: a thread that went on waiting would hang the test.
}

TEST(LiveMotion, TakesTheKnownTableAndTheShownSpeed) {
  TurntableInfo known;
  known.axis = Vec3d::UnitZ();
  Calibration shown;
  shown.table.axis = -Vec3d::UnitZ();
  shown.table.speed_rad_s = 0.2;
  shown.start_s = 3.0;
  const auto motion = live_motion(&known, &shown, {}, false, 1.0);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->table.axis, known.axis);
  EXPECT_EQ(motion->speed_rad_s, -0.2);  // about the other end of the axis
  FrameInfo info;
  info.time_s = 2.0;
  EXPECT_EQ(motion->turned_rad(info), 0.0);  // it stood still then
  info.time_s = 5.0;
  EXPECT_NEAR(*motion->turned_rad(info), -0.4, 1e-12);
  info.angle_rad = 1.5;
  EXPECT_EQ(motion->turned_rad(info), 1.5);
}

TEST(LiveMotion, IsFoundOnceByFramesAndAnewByEachEstimate) {
  SequenceHeader header;
  header.turntable = TurntableInfo();
  FrameInfo info;
  info.time_s = 7.0;
  EXPECT_FALSE(LiveMotionFinder(header, std::nullopt).take(info));  // nothing says how it turns
  LiveMotionFinder finder(header, 0.2);
  info.status = FrameStatus::kDropped;
  EXPECT_FALSE(finder.take(info));
  info.status = FrameStatus::kOk;
  const auto motion = finder.take(info);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->speed_rad_s, 0.2);
  EXPECT_EQ(motion->start_s, 7.0);
  EXPECT_FALSE(finder.take(info));
  auto shown = std::make_shared<Calibration>();
  shown->table.speed_rad_s = 0.3;
  EXPECT_EQ(finder.take(shown)->speed_rad_s, 0.3);
  EXPECT_FALSE(finder.take(shown));
}

TEST(LiveMotion, IsNotThereWhereTheTableIsKnownBadlyOrNothingSaysHowItTurns) {
  Calibration shown;
  shown.table.speed_rad_s = 0.2;
  shown.center_sigma_m = 0.001;
  shown.axis_sigma_rad = 0.001;
  EXPECT_TRUE(live_motion(nullptr, &shown, {}, false, 0.0));
  shown.center_sigma_m = 0.02;
  EXPECT_FALSE(live_motion(nullptr, &shown, {}, false, 0.0));
  EXPECT_FALSE(live_motion(nullptr, nullptr, 0.2, true, 0.0));
  const TurntableInfo known;
  EXPECT_FALSE(live_motion(&known, nullptr, {}, false, 0.0));
  EXPECT_TRUE(live_motion(&known, nullptr, {}, true, 0.0));
  EXPECT_TRUE(live_motion(&known, nullptr, 0.2, false, 0.0));
}

}  // namespace
}  // namespace turnscan
