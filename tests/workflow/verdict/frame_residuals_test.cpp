#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>
#include <turnscan/workflow/verdict/frame_agreement.hpp>
#include <turnscan/workflow/verdict/seen_surface.hpp>

#include "tests/support/memory_sequence.hpp"

namespace turnscan {
namespace {

constexpr int kFrames = 20;

/// Frames of an object with their true poses, over one turn and a bit.
struct TrueScan {
  testing::MemorySequence frames;
  ObjectResult object;
};

TrueScan true_scan(const char* object = "builtin:cylinder") {
  SceneDescription scene;
  scene.object = object;
  scene.motion.frames = kFrames;
  scene.motion.turns = 1.2;
  scene.measure.noise = "gaussian:0.5mm";
  const auto simulation = prepare_simulation(scene, {});
  const VirtualScan& scan = simulation->scan.pass(0);
  TrueScan out;
  out.frames.header_value = scan.header();
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    Frame frame = *scan.read(i);
    frame.info.T_table_sensor = scan.T_table_sensor(i);
    out.frames.add(frame);
  }
  out.object.mesh = scan.objects().front();
  return out;
}

std::vector<FrameResidual> residuals_of(const TrueScan& scan) {
  const auto found = frame_residuals(scan.object, {{&scan.frames}}, 0.0005, {});
  EXPECT_TRUE(found);
  return *found;
}

void move(FrameInfo& info, const Vec3d& by_m) { info.T_table_sensor->pretranslate(by_m); }

TEST(FrameResiduals, AreSmallWhereTheFramesStandAsTheyStood) {
  const auto found = residuals_of(true_scan());
  ASSERT_EQ(found.size(), std::size_t(kFrames));
  for (const FrameResidual& r : found) {
    EXPECT_LT(r.off_m(), 0.00025) << r.frame;
    EXPECT_NEAR(r.spread_m, 0.0004, 0.00015) << r.frame << ", along slanted normals less";
    EXPECT_NEAR(r.outward_m, 0.0, 0.0002) << r.frame;
  }
  const FrameAgreement agreement = frame_agreement(found);
  EXPECT_TRUE(agreement.apart.empty());
  ASSERT_TRUE(agreement.neighbours_m && agreement.turn_apart_m)
      << "it turned by more than one turn";
  EXPECT_LT(*agreement.turn_apart_m, 0.0005);
  EXPECT_FALSE(agreement.sensors_m || agreement.passes_m) << "there is but one";
}

TEST(FrameResiduals, TellWhichFramesLieElsewhereAndHowFar) {
  TrueScan scan = true_scan();
  for (const std::size_t i : {5u, 6u, 7u}) move(scan.frames.infos[i], Vec3d(0.0, 0.0, 0.003));
  const auto found = residuals_of(scan);
  EXPECT_NEAR(found.at(6).shift_m.z(), 0.003, 0.0006);
  const FrameAgreement agreement = frame_agreement(found);
  ASSERT_EQ(agreement.apart.size(), 1u);
  EXPECT_EQ(agreement.apart[0].first, 5u);
  EXPECT_EQ(agreement.apart[0].last, 7u);
  EXPECT_NEAR(agreement.apart[0].off_m, 0.003, 0.001);
  EXPECT_EQ(frames_apart_text(agreement, found).rfind("frames 5 to 7 at ", 0), 0u)
      << frames_apart_text(agreement, found);
}

TEST(FrameResiduals, TellATurnAboutTheAxisByTheShape) {
  TrueScan scan = true_scan("builtin:letter-a");
  Pose& T = *scan.frames.infos[0].T_table_sensor;
  T = rotation_about_y(2.0 * kRadiansPerDegree) * T;
  const FrameResidual found = residuals_of(scan).at(0);
  EXPECT_GT(std::abs(found.turn_m), 0.0005);
}

TEST(FrameResiduals, CompareOnlyWhatWasMeasured) {
  TrueScan scan = true_scan();
  scan.object.evidence.assign(scan.object.mesh.triangles.size(), Evidence::kInvented);
  EXPECT_TRUE(residuals_of(scan).empty());
}

TEST(FrameResiduals, StopWhenTheyAreCancelled) {
  const TrueScan scan = true_scan();
  RunContext cancelled;
  cancelled.cancel();
  const auto found = frame_residuals(scan.object, {{&scan.frames}}, 0.0005, cancelled);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

/// Residuals of a scan of many frames of which only the shift is known.
std::vector<FrameResidual> shifted(const std::vector<double>& x_m, std::uint32_t sensors) {
  std::vector<FrameResidual> out(x_m.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].frame = std::uint32_t(i);
    out[i].sensor = std::uint32_t(i) % sensors;
    out[i].shift_m.x() = x_m[i];
  }
  return out;
}

TEST(FrameAgreement, ComparesSensors) {
  const auto agreement = frame_agreement(shifted({0.0, 0.002, 0.0, 0.002, 0.0, 0.002}, 2));
  ASSERT_TRUE(agreement.sensors_m && agreement.neighbours_m);
  EXPECT_NEAR(*agreement.sensors_m, 0.002, 1e-9);
  EXPECT_NEAR(*agreement.neighbours_m, 0.0, 1e-9) << "neighbours are of one sensor";
  EXPECT_FALSE(agreement.turn_apart_m);
}

TEST(FrameAgreement, OfNothingKnowsNothing) { EXPECT_EQ(frame_agreement({}).frames, 0u); }

TEST(SeenVertices, AreThoseThatTheFramesLookAt) {
  TrueScan scan = true_scan("builtin:letter-a");
  const auto all = seen_vertices(scan.object.mesh, {{&scan.frames}}, {});
  ASSERT_TRUE(all);
  // Of a third of the turn.
  for (std::size_t i = kFrames / 3; i < std::size_t(kFrames); ++i)
    scan.frames.infos[i].status = FrameStatus::kDropped;
  const auto some = seen_vertices(scan.object.mesh, {{&scan.frames}}, {});
  ASSERT_TRUE(some);
  const auto count = [](const SeenVertices& s) {
    return std::count(s.seen.begin(), s.seen.end(), 1);
  };
  EXPECT_GT(count(*all), 0.75 * double(all->vertices.size()));
  EXPECT_LT(count(*some), 0.75 * double(count(*all)));
  EXPECT_GT(count(*some), 0);
}

}  // namespace
}  // namespace turnscan
