#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/motion/initial_guess.hpp>

#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

/// What a search from a guess so many times too high makes of a scan, as a multiple of its true
/// speed. The axis that it is told is 5 mm off.
std::optional<double> found_from(const std::string& object, double turns, double factor) {
  testing::RigOptions options = testing::near_rig(60, turns);
  options.objects = {place(*builtin_object(object), 0.0, 0.0, 0.6)};
  const testing::Rig rig(options);
  const auto data = motion::load_motion(rig, {}, {});
  EXPECT_TRUE(data.has_value());
  if (!data) return std::nullopt;
  motion::MotionState state;
  state.axis = rig.truth().axis;
  state.center = rig.truth().center_m + Vec3d(0.005, 0.0, 0.0);
  const double speed = turns * kTurn / 60.0;
  const auto found =
      motion::recurrence_speed(*data, motion::recurrence_costs(*data), state, factor * speed);
  return found ? std::optional(*found / speed) : std::nullopt;
}

TEST(RecurrenceSpeed, IsThatAtWhichTheSameViewComesBackWhateverTheAxis) {
  if (testing::kSanitized) GTEST_SKIP() << "others run the same code";
  for (const double turns : {1.5, -1.5}) {
    const auto found = found_from("doll", turns, 0.6);
    ASSERT_TRUE(found) << turns;
    EXPECT_NEAR(*found, 1.0, 0.02) << turns;
  }
}

TEST(RecurrenceSpeed, IsUnknownWhereNoViewComesBack) {
  if (testing::kSanitized) GTEST_SKIP() << "others run the same code";
  EXPECT_FALSE(found_from("scorpion", 0.7, 0.6));
  EXPECT_FALSE(found_from("cylinder", 1.5, 0.6)) << "all views are the same";
}

TEST(RecurrenceSpeed, IsNotTwiceTheSpeedOfAnObjectThatLooksAlikeFromTwoSides) {
  if (testing::kSanitized) GTEST_SKIP() << "others run the same code";
  EXPECT_FALSE(found_from("letter-a", 0.8, 1.0)) << "only half a turn comes back";
}

}  // namespace
}  // namespace turnscan
