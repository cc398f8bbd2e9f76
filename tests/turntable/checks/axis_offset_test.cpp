#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/checks/axis_offset.hpp>
#include <turnscan/turntable/checks/closure.hpp>

#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

constexpr double kFrames = 60, kTurns = 1.1;

/// The letter over 1.1 turns, with the true turntable.
SequenceView letter_on(const testing::Rig& rig) {
  SequenceView out(rig);
  SequenceHeader header = rig.header();
  header.turntable = rig.truth();
  header.turntable->speed_rad_s = kTurns * kTurn / kFrames;
  out.set_header(std::move(header));
  return out;
}

testing::Rig turning_rig(std::uint64_t seed = 1) {
  testing::RigOptions o = testing::near_rig(int(kFrames), kTurns);
  o.seed = seed;
  o.objects = {*builtin_object("letter-a")};
  return testing::Rig(o);
}

void move_table(SequenceView& sequence, double shift_m, double tilt_rad) {
  SequenceHeader header = sequence.header();
  header.turntable->center_m.x() += shift_m;
  header.turntable->axis = Eigen::AngleAxisd(tilt_rad, Vec3d::UnitZ()) * header.turntable->axis;
  sequence.set_header(std::move(header));
}

TEST(MeasureAxisOffset, DoesNotTakeForThePlatterWhatNothingStandsOn) {
  const testing::Rig rig = turning_rig();
  DetectedPlatter clutter;
  clutter.axis = rig.truth().axis;
  clutter.center_m = rig.truth().center_m + Vec3d(0.5, 0.0, 0.0);
  clutter.radius_m = 0.1;
  PlatterMemory memory{true, clutter};
  const auto offset = measure_axis_offset(letter_on(rig), {}, &memory);
  ASSERT_TRUE(offset && *offset);
  EXPECT_FALSE((*offset)->significant());
  EXPECT_FALSE(memory.platter);
}

TEST(MeasureAxisOffset, IsSmallWhereTheRecordingIsRight) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const testing::Rig rig = turning_rig(seed);
    const auto offset = measure_axis_offset(letter_on(rig), {});
    ASSERT_TRUE(offset && *offset);
    EXPECT_FALSE((*offset)->significant());
    EXPECT_LT((*offset)->shift_m, 0.0005);
    EXPECT_LT((*offset)->tilt_rad, 0.2 * kRadiansPerDegree);
  }
}

TEST(MeasureAxisOffset, HasErrorsAsLargeAsItsDeviationsSay) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  double tilt = 0.0, shift = 0.0;
  constexpr int kRigs = testing::repetitions(10, 3);
  for (std::uint64_t seed = 11; seed < 11 + kRigs; ++seed) {
    const testing::Rig rig = turning_rig(seed);
    const auto offset = measure_axis_offset(letter_on(rig), {});
    ASSERT_TRUE(offset && *offset);
    tilt += std::pow((*offset)->tilt_rad / (*offset)->tilt_sigma_rad, 2) / kRigs;
    shift += std::pow((*offset)->shift_m / (*offset)->shift_sigma_m, 2) / kRigs;
  }
  if (kRigs < 10) return;
  // The rms of ten rigs' errors over their deviations.
  EXPECT_GT(std::sqrt(tilt), 0.5);
  EXPECT_LT(std::sqrt(tilt), 2.0);
  EXPECT_GT(std::sqrt(shift), 0.5);
  EXPECT_LT(std::sqrt(shift), 2.0);
}

TEST(MeasureAxisOffset, ShowsATableThatWasMovedThoughItsTurnCloses) {
  const testing::Rig rig = turning_rig();
  SequenceView sequence = letter_on(rig);
  move_table(sequence, 0.005, kRadiansPerDegree);
  const auto closure = measure_closure(sequence, {});
  ASSERT_TRUE(closure && *closure);
  EXPECT_FALSE((*closure)->significant());
  const auto offset = measure_axis_offset(sequence, {});
  ASSERT_TRUE(offset && *offset);
  EXPECT_TRUE((*offset)->significant());
  EXPECT_NEAR((*offset)->tilt_rad, kRadiansPerDegree, 0.2 * kRadiansPerDegree);
  EXPECT_NEAR((*offset)->shift_m, 0.005, 0.002);  // measured beside the object, above the platter
}

TEST(MeasureAxisOffset, SaysNothingOfABallWhichLiesAlikeAboutAnyAxis) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    testing::RigOptions o = testing::near_rig(int(kFrames), kTurns);
    o.seed = seed;
    o.platter = false;
    o.objects = {*builtin_object("ball")};
    const testing::Rig rig(o);
    const auto offset = measure_axis_offset(letter_on(rig), {});
    ASSERT_TRUE(offset) << offset.error().text();
    EXPECT_FALSE(*offset && (*offset)->significant()) << (*offset)->tilt_rad * kDegreesPerRadian;
  }
}

TEST(MeasureAxisOffset, SaysNothingOfALittleTurn) {
  const testing::Rig rig = turning_rig();
  const SequenceView all = letter_on(rig);
  const SequenceView begin(all, {0, 1, 2, 3, 4, 5});
  const auto offset = measure_axis_offset(begin, {});
  ASSERT_TRUE(offset);
  EXPECT_FALSE(offset->has_value());
}

TEST(MeasureAxisOffset, SaysNothingOfALineScannersProfiles) {
  const testing::Rig rig = turning_rig();
  SequenceView sequence = letter_on(rig);
  SequenceHeader header = sequence.header();
  header.sensors.front().kind = SensorKind::kPointScanner;
  sequence.set_header(header);
  const auto offset = measure_axis_offset(sequence, {});
  ASSERT_TRUE(offset);
  EXPECT_FALSE(offset->has_value());
}

TEST(MeasureAxisOffset, NeedsATurntableAndAngles) {
  const testing::Rig rig = turning_rig();
  EXPECT_EQ(measure_axis_offset(rig, {}).error().code, ErrorCode::kMissingData);
  SequenceView sequence = letter_on(rig);
  SequenceHeader header = sequence.header();
  header.turntable->speed_rad_s.reset();
  sequence.set_header(header);
  EXPECT_EQ(measure_axis_offset(sequence, {}).error().code, ErrorCode::kMissingData);
}

TEST(MeasureAxisOffset, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  const testing::Rig rig = turning_rig();
  const SequenceView sequence = letter_on(rig);
  std::vector<AxisOffset> found;
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    const auto offset = measure_axis_offset(sequence, {});
    set_thread_count(0);
    ASSERT_TRUE(offset && *offset);
    found.push_back(**offset);
    EXPECT_EQ(found.back().shift_m, found.front().shift_m);
    EXPECT_EQ(found.back().tilt_rad, found.front().tilt_rad);
  }
  const RunContext context;
  context.cancel();
  EXPECT_EQ(measure_axis_offset(sequence, context).error().code, ErrorCode::kCancelled);
}

TEST(AxisOffset, CountsOnlyWhereItShowsAndIsKnown) {
  TurntableInfo recorded, found;
  found.axis = Eigen::AngleAxisd(0.001, Vec3d::UnitZ()) * Vec3d::UnitY();
  found.center_m = Vec3d(0.002, 0.5, 0.0);  // the height along the axis does not matter
  const AxisOffset offset = axis_offset_between(recorded, found, 0.01, 0.0004);
  EXPECT_NEAR(offset.shift_m, 0.002, 1e-9);
  EXPECT_NEAR(offset.tilt_rad, 0.001, 1e-9);
  EXPECT_TRUE(offset.visible());
  EXPECT_TRUE(offset.significant());
  const AxisOffset vague = axis_offset_between(recorded, found, 0.01, 0.0006);
  EXPECT_TRUE(vague.visible());
  EXPECT_FALSE(vague.significant());
  found.center_m.x() = 0.0014;
  EXPECT_FALSE(axis_offset_between(recorded, found, 0.0, 0.0).visible());
}

}  // namespace
}  // namespace turnscan
