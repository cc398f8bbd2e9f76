#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/checks/turning_sense.hpp>

#include "tests/support/rig.hpp"

namespace turnscan {
namespace {

constexpr int kSenseFrames = 24;

testing::Rig rig_of(const char* object) {
  testing::RigOptions o = testing::near_rig(kSenseFrames, 1.0);
  o.objects = {*builtin_object(object)};
  return testing::Rig(o);
}

SequenceView on_stated_table(const testing::Rig& rig, double speed_sign) {
  SequenceView out(rig);
  SequenceHeader header = rig.header();
  header.turntable = rig.truth();
  header.turntable->speed_rad_s = speed_sign * kTurn / kSenseFrames;
  out.set_header(std::move(header));
  return out;
}

TEST(MeasureTurningSense, KnowsAnglesOfTheWrongSign) {
  const testing::Rig rig = rig_of("letter-a");
  for (const double sign : {1.0, -1.0}) {
    const auto sense = measure_turning_sense(on_stated_table(rig, sign), {});
    ASSERT_TRUE(sense && *sense);
    EXPECT_EQ((*sense)->reversed(), sign < 0.0);
  }
}

TEST(MeasureTurningSense, OfWhatLooksTheSameFromAllSidesIsTheRecorded) {
  const testing::Rig rig = rig_of("cylinder");
  for (const double sign : {1.0, -1.0}) {
    const auto sense = measure_turning_sense(on_stated_table(rig, sign), {});
    ASSERT_TRUE(sense);
    EXPECT_FALSE(*sense && (*sense)->reversed());
  }
}

TEST(MeasureTurningSense, NeedsATurntableAndAngles) {
  const testing::Rig rig = rig_of("letter-a");
  EXPECT_EQ(measure_turning_sense(rig, {}).error().code, ErrorCode::kMissingData);
}

}  // namespace
}  // namespace turnscan
