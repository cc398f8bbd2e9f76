#include <gtest/gtest.h>

#include <atomic>
#include <charconv>
#include <numbers>
#include <tests/support/memory_sequence.hpp>
#include <thread>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/stream.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan {
namespace {

using turnscan::testing::MemorySequence;

constexpr double kBallRadius = 0.03;
const Vec3d kCenter(0.004, 0.034, -0.003);

/// Depth images, 80 x 60, of a ball on a foot that turns before a camera.
MemorySequence ball(std::uint32_t frames, std::uint32_t from = 0) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.intrinsics.width = 80, sensor.intrinsics.height = 60;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 160.0;
  sensor.intrinsics.cx = 39.5, sensor.intrinsics.cy = 29.5;
  const Vec3d eye(0, 0.2, -0.5), z = (kCenter - eye).normalized();
  const Vec3d x = z.cross(Vec3d::UnitY()).normalized();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = x;
  pose.linear().col(1) = z.cross(x);
  pose.linear().col(2) = z;
  pose.translation() = eye;
  sensor.T_table_sensor = pose;
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.radius_m = 0.1;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < frames; ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = 2.0 * std::numbers::pi * f / 64.0;
    const Pose view = rotation_about_y(-*frame.info.angle_rad) * pose;
    frame.depth = DepthImage(80, 60);
    for (int i = 0; i < 80 * 60; ++i) {
      const Vec3d d = view.linear() * sensor.intrinsics.ray(i % 80, i / 80);
      const Vec3d m = view.translation() - kCenter;
      const double a = d.squaredNorm(), b = m.dot(d);
      const double q = b * b - a * (m.squaredNorm() - kBallRadius * kBallRadius);
      double t = f >= from && q > 0.0 ? (-b - std::sqrt(q)) / a : 0.0;
      const double floor = -view.translation().y() / d.y();
      const Vec3d hit = view.translation() + floor * d;
      if (t == 0.0 && std::hypot(hit.x(), hit.z()) < 0.1) t = floor;
      if (t > 0.0) t += 0.0005 * standard_normal(hash_key(f, std::uint64_t(i), 3));
      frame.depth.pixels[std::size_t(i)] = std::uint16_t(std::lround(t * 1e4));
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

ReconstructOptions with(SurfaceMethod method) {
  ReconstructOptions options;
  options.surface.method = method;
  options.surface.poisson_depth = 5;
  return options;
}

/// Hands over the frames in calls of so many.
Result<Reconstruction> streamed(const MemorySequence& sequence, const ReconstructOptions& options,
                                std::size_t per_call,
                                const std::vector<PassPlacement>& passes = {}) {
  TURNSCAN_ASSIGN(auto stream, ReconstructionStream::create(sequence.header(), options, passes));
  const auto& all = sequence.data;
  for (std::size_t i = 0; i < all.size(); i += per_call) {
    const std::size_t end = std::min(all.size(), i + per_call);
    TURNSCAN_TRY(stream.add(
        std::vector<Frame>(all.begin() + std::ptrdiff_t(i), all.begin() + std::ptrdiff_t(end))));
  }
  return stream.finish({}, RunContext());
}

void expect_same(const Result<Reconstruction>& a, const Result<Reconstruction>& b) {
  ASSERT_TRUE(a) << a.error().text();
  ASSERT_TRUE(b) << b.error().text();
  ASSERT_EQ(a->objects.size(), b->objects.size());
  EXPECT_EQ(a->frames, b->frames);
  EXPECT_EQ(a->inside_crop, b->inside_crop);
  for (std::size_t i = 0; i < a->objects.size(); ++i) {
    EXPECT_EQ(a->objects[i].mesh.vertices, b->objects[i].mesh.vertices);
    EXPECT_EQ(a->objects[i].mesh.triangles, b->objects[i].mesh.triangles);
  }
}

TEST(ReconstructionStream, GivesTheBytesOfABatchHoweverTheFramesCome) {
  const MemorySequence sequence = ball(64);
  for (const SurfaceMethod method : {SurfaceMethod::kVolumetric, SurfaceMethod::kPoisson}) {
    const auto batch = reconstruct(sequence, with(method), {}, RunContext());
    for (const std::size_t per_call : {1u, 7u, 64u})
      expect_same(batch, streamed(sequence, with(method), per_call));
  }
}

TEST(ReconstructionStream, GivesTheSameBytesForAnyNumberOfThreads) {
  const MemorySequence sequence = ball(48);
  ReconstructOptions sub_voxels = with(SurfaceMethod::kPoisson);
  sub_voxels.candidates.method = CandidateMethod::kSubVoxel;
  for (const auto& options : {with(SurfaceMethod::kVolumetric), sub_voxels}) {
    set_thread_count(1);
    const auto one = streamed(sequence, options, 10);
    for (const int threads : {2, 8}) {
      set_thread_count(threads);
      expect_same(one, streamed(sequence, options, 10));
    }
    set_thread_count(0);
  }
}

TEST(ReconstructionStream, TheSecondFilterSeesAllPoints) {
  const MemorySequence sequence = ball(40);
  ReconstructOptions options = with(SurfaceMethod::kPoisson);
  const auto all = streamed(sequence, options, 10);
  options.merge.cloud_outliers = true;
  const auto filtered = streamed(sequence, options, 10);
  ASSERT_TRUE(all && filtered);
  EXPECT_LT(filtered->points, all->points);
  EXPECT_GT(filtered->points, all->points / 2);
  expect_same(filtered, streamed(sequence, options, 40));
}

TEST(ReconstructionStream, AGridLiesAlongWhatTheFirstFramesShow) {
  ReconstructOptions options = with(SurfaceMethod::kPoisson);
  options.voxels.grid = 40;
  const auto result = streamed(ball(64), options, 10);
  ASSERT_TRUE(result);
  const auto choice =
      std::find_if(result->choices.begin(), result->choices.end(),
                   [](const ResolvedParameter& c) { return c.option == "voxel-size"; });
  ASSERT_NE(choice, result->choices.end());
  double size = 0.0;
  const char* text = choice->value.c_str();
  ASSERT_EQ(std::from_chars(text, text + choice->value.size(), size).ec, std::errc());
  EXPECT_NEAR(size, 2e3 * (kBallRadius + 0.005) / 40, 0.15)
      << choice->value << " " << choice->reason;
}

TEST(ReconstructionStream, WaitsUntilSomethingStandsOnThePlatter) {
  const auto late = streamed(ball(120, 60), with(SurfaceMethod::kVolumetric), 8);
  ASSERT_TRUE(late) << late.error().text();
  EXPECT_EQ(late->objects.size(), 1u);
  EXPECT_EQ(late->frames, 120u);
}

TEST(ReconstructionStream, GoesOnWithoutAFrameThatDoesNotFit) {
  const MemorySequence sequence = ball(40);
  auto stream =
      ReconstructionStream::create(sequence.header(), with(SurfaceMethod::kVolumetric)).value();
  for (std::size_t i = 0; i < sequence.data.size(); ++i) {
    ASSERT_TRUE(stream.add({sequence.data[i]}));
    if (i != 5 && i != 38) continue;  // before and after the scale is known
    Frame wrong = sequence.data[i];
    wrong.depth = DepthImage(8, 8);
    EXPECT_EQ(stream.add({wrong}).error().code, ErrorCode::kFormat);
    wrong = sequence.data[i];
    wrong.info.sensor = 7;
    EXPECT_EQ(stream.add({wrong}).error().code, ErrorCode::kFormat);
  }
  expect_same(stream.finish({}, RunContext()),
              reconstruct(sequence, with(SurfaceMethod::kVolumetric), {}, RunContext()));
}

TEST(ReconstructionStream, EndsWithAnErrorWhenThereWasNothing) {
  const MemorySequence sequence = ball(1);
  auto stream = ReconstructionStream::create(sequence.header(), {}).value();
  EXPECT_EQ(stream.finish({}, RunContext()).error().code, ErrorCode::kTooFewPoints);
  auto empty = ReconstructionStream::create(sequence.header(), {}).value();
  for (const Frame& frame : ball(40, 100).data) ASSERT_TRUE(empty.add({frame}));
  EXPECT_EQ(empty.finish({}, RunContext()).error().code, ErrorCode::kTooFewPoints);
}

TEST(ReconstructionStream, StopsWhenCancelled) {
  const MemorySequence sequence = ball(4);
  auto stream = ReconstructionStream::create(sequence.header(), {}).value();
  RunContext context;
  context.cancel();
  EXPECT_EQ(stream.add(sequence.data, context).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(stream.finish({}, context).error().code, ErrorCode::kCancelled);
}

TEST(ReconstructionStream, ShowsTheGrowingSurfaceWhileFramesAreAdded) {
  const MemorySequence sequence = ball(96);
  auto stream =
      ReconstructionStream::create(sequence.header(), with(SurfaceMethod::kVolumetric)).value();
  EXPECT_TRUE(stream.preview()->empty());
  std::atomic<bool> done{false};
  std::size_t shown = 0;
  std::thread watcher([&] {
    while (!done) {
      const auto preview = stream.preview();
      ASSERT_TRUE(preview);
      if (preview->empty()) continue;
      ++shown;
      EXPECT_TRUE(check_mesh(*preview).watertight());
    }
  });
  for (const Frame& frame : sequence.data) ASSERT_TRUE(stream.add({frame}));
  const auto last = stream.preview();
  done = true;
  watcher.join();
  ASSERT_TRUE(last);
  const Box box = bounds(last->vertices);
  EXPECT_NEAR(box.max.y(), kCenter.y() + kBallRadius, 0.004);
  EXPECT_NEAR(box.size().x(), 2 * kBallRadius, 0.008);
  // Asking changes nothing.
  expect_same(stream.finish({}, RunContext()),
              reconstruct(sequence, with(SurfaceMethod::kVolumetric), {}, RunContext()));
}

TEST(ReconstructionStream, PointMethodsSayThatTheyHaveNoPreview) {
  const auto stream =
      ReconstructionStream::create(ball(1).header(), with(SurfaceMethod::kPoisson)).value();
  EXPECT_EQ(stream.preview().error().code, ErrorCode::kInvalidOption);
}

TEST(ReconstructionStream, PassesAreNotMixed) {
  MemorySequence sequence = ball(40);
  for (std::uint32_t f = 0; f < 40; ++f) sequence.data[f].info.pass = f / 30;
  ReconstructOptions options = with(SurfaceMethod::kVolumetric);
  const auto mixed = streamed(sequence, options, 7);
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, ErrorCode::kInvalidOption);
  EXPECT_NE(mixed.error().message.find("--pass"), std::string::npos) << mixed.error().message;
  options.merge.pass = 2;
  EXPECT_FALSE(streamed(sequence, options, 7));
  options.merge.pass = 0;
  const auto one = streamed(sequence, options, 7);
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_EQ(one->frames, 30u);
  options.merge.pass.reset();
  EXPECT_EQ(one->objects.at(0).mesh.vertices,
            streamed(ball(30), options, 30)->objects.at(0).mesh.vertices);
}

TEST(ReconstructionStream, PassesWithPosesOfTheirOwnComeTogether) {
  MemorySequence sequence = ball(40);
  FramePoser poser(sequence.header(), std::nullopt);
  for (std::uint32_t f = 0; f < 40; ++f) {
    FrameInfo& info = sequence.data[f].info;
    info.T_table_sensor = *poser(info);
    info.pass = f / 30;
  }
  const auto result = streamed(sequence, with(SurfaceMethod::kVolumetric), 40);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->frames, 40u);
}

/// The ball in two passes: in the second it stands on its head.
struct TwoPasses {
  MemorySequence frames = ball(128);
  std::vector<PassPlacement> placements;

  TwoPasses() {
    for (std::uint32_t f = 64; f < 128; ++f) frames.data[f].info.pass = 1;
    frames.infos.clear();
    for (const Frame& frame : frames.data) frames.infos.push_back(frame.info);
    PassPlacement placement;
    placement.turntable = frames.header().turntable;
    placement.name = "upright";
    placements.assign(2, placement);
    placements[1].name = "on its head";
    placements[1].T_object_table = Eigen::Translation3d(kCenter) *
                                   Eigen::AngleAxisd(std::numbers::pi, Vec3d::UnitZ()) *
                                   Eigen::Translation3d(-kCenter);
  }
};

TEST(ReconstructionStream, WhatTouchedThePlatterInOnePassIsMeasuredInAnother) {
  const TwoPasses two;
  for (const SurfaceMethod method : {SurfaceMethod::kVolumetric, SurfaceMethod::kPoisson}) {
    const auto alone = streamed(ball(64), with(method), 64);
    ASSERT_TRUE(alone) << alone.error().message;
    const double bottom = kCenter.y() - kBallRadius;
    EXPECT_GT(bounds(alone->objects.at(0).mesh.vertices).min.y(), bottom + 0.001);
    const auto fused = streamed(two.frames, with(method), 40, two.placements);
    ASSERT_TRUE(fused) << fused.error().message;
    ASSERT_EQ(fused->objects.size(), 1u);
    const ObjectResult& object = fused->objects[0];
    EXPECT_TRUE(object.check.watertight());
    EXPECT_LT(object.invented_area_m2, 0.5 * alone->objects[0].invented_area_m2);
    EXPECT_NEAR(bounds(object.mesh.vertices).min.y(), bottom, 0.001);
    for (const Vec3f& p : object.mesh.vertices)
      EXPECT_NEAR((p.cast<double>() - kCenter).norm(), kBallRadius, 0.0015);
    ASSERT_EQ(fused->passes.size(), 2u);
    EXPECT_EQ(fused->passes[1].name, "on its head");
    EXPECT_EQ(fused->passes[1].frames, 64u);
  }
}

TEST(ReconstructionStream, FusedPassesGiveTheSameBytesHoweverTheyCome) {
  const TwoPasses two;
  const ReconstructOptions options = with(SurfaceMethod::kVolumetric);
  set_thread_count(1);
  const auto whole = reconstruct(two.frames, options, {}, RunContext(), two.placements);
  set_thread_count(0);
  for (const std::size_t per_call : {1u, 50u, 128u})
    expect_same(whole, streamed(two.frames, options, per_call, two.placements));
}

TEST(ReconstructionStream, APassOfWhichOnlyAFewFramesAreThereIsFusedToo) {
  TwoPasses two;
  two.frames.data.resize(64 + 20);
  const auto fused = streamed(two.frames, with(SurfaceMethod::kVolumetric), 100, two.placements);
  ASSERT_TRUE(fused) << fused.error().message;
  EXPECT_EQ(fused->frames, 84u);
  EXPECT_EQ(fused->passes.at(1).frames, 20u);
}

TEST(ReconstructionStream, PassesThatLieAlikeEndFlatOnThePlatter) {
  TwoPasses two;
  two.placements[1].T_object_table = Pose::Identity();
  ReconstructOptions options = with(SurfaceMethod::kVolumetric);
  options.crop.margin_m = 0.02;
  const auto fused = streamed(two.frames, options, 64, two.placements);
  ASSERT_TRUE(fused) << fused.error().message;
  const ObjectResult& object = fused->objects.at(0);
  EXPECT_TRUE(object.check.watertight());
  EXPECT_NEAR(bounds(object.mesh.vertices).min.y(), 0.0, 0.0002);
  EXPECT_NE(std::count(object.evidence.begin(), object.evidence.end(), Evidence::kBase), 0);
}

TEST(ReconstructionStream, FramesOfAPassWithoutAPlaceAreRefused) {
  TwoPasses two;
  const auto options = with(SurfaceMethod::kVolumetric);
  EXPECT_FALSE(streamed(two.frames, options, 64, {two.placements[0]}));
  std::swap(two.frames.data[10], two.frames.data[100]);
  const auto mixed = streamed(two.frames, options, 64, two.placements);
  ASSERT_FALSE(mixed);
  EXPECT_EQ(mixed.error().code, ErrorCode::kFormat);
}

/// Upright profiles of a ball on the platter, as a line scanner gives them: no grid.
MemorySequence profiles(std::uint32_t count) {
  MemorySequence sequence;
  SensorInfo sensor;
  sensor.kind = SensorKind::kPointScanner;
  sensor.T_table_sensor = Pose::Identity();
  sensor.viewpoint = {Vec3d(0, kBallRadius, -0.5), false};
  sequence.header_value.sensors = {sensor};
  TurntableInfo table;
  table.radius_m = 0.1;
  sequence.header_value.turntable = table;
  for (std::uint32_t f = 0; f < count; ++f) {
    Frame frame;
    frame.info.index = f;
    frame.info.angle_rad = 2.0 * std::numbers::pi * f / count;
    for (int i = 1; i < 120; ++i) {
      const double a = std::numbers::pi * i / 120.0;
      frame.points.points.emplace_back(0.0f, float(kBallRadius * (1.0 - std::cos(a))),
                                       float(-kBallRadius * std::sin(a)));
    }
    sequence.add(std::move(frame));
  }
  return sequence;
}

TEST(ReconstructionStream, ProfilesOfALineScannerBecomeOneObjectByEitherMethod) {
  const MemorySequence sequence = profiles(48);  // 4 mm apart at the widest, points 0.8 mm
  for (const SurfaceMethod method : {SurfaceMethod::kPoisson, SurfaceMethod::kVolumetric}) {
    const auto result = streamed(sequence, with(method), 7);
    ASSERT_TRUE(result) << result.error().message;
    ASSERT_EQ(result->objects.size(), 1u);
    EXPECT_TRUE(result->objects[0].check.watertight());
    EXPECT_NEAR(bounds(result->objects[0].mesh.vertices).size().x(), 2 * kBallRadius, 0.004);
  }
  expect_same(streamed(sequence, with(SurfaceMethod::kVolumetric), 1),
              streamed(sequence, with(SurfaceMethod::kVolumetric), 64));
}

}  // namespace
}  // namespace turnscan
