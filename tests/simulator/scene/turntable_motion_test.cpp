#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene/turntable_motion.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

constexpr double kTurn = 2.0 * test::kPi;

std::vector<PlatterState> states_of(const MotionOptions& o) {
  auto states = platter_states(o);
  EXPECT_TRUE(states) << (states ? "" : states.error().text());
  return *states;
}

void expect_refused(const MotionOptions& o, const std::string& says) {
  const auto states = platter_states(o);
  ASSERT_FALSE(states) << says;
  EXPECT_EQ(states.error().code, ErrorCode::kInvalidOption);
  EXPECT_NE(states.error().message.find(says), std::string::npos) << states.error().message;
}

/// Speed between frames i and i + 1.
double speed_at(const std::vector<PlatterState>& s, std::size_t i) {
  return (s[i + 1].angle_rad - s[i].angle_rad) / (s[i + 1].time_s - s[i].time_s);
}

TEST(TurntableMotion, SpreadsFramesOverTheTurnsLeavingTheLastOnesEndOut) {
  MotionOptions o;
  o.frames = 8;
  o.turns = -2.0;
  const auto s = states_of(o);
  ASSERT_EQ(s.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(s[i].angle_rad, -2.0 * kTurn * double(i) / 8.0, 1e-12);
    EXPECT_DOUBLE_EQ(s[i].time_s, double(i) / 30.0);
    EXPECT_DOUBLE_EQ(s[i].travel, double(i) / 7.0);
  }
}

TEST(TurntableMotion, IsNoFullTurnWhereFramesSpeedAndRateSaySo) {
  MotionOptions o;
  o.frames = 920;
  o.speed_rad_s = 10.4478 * kRadiansPerDegree;
  const auto s = states_of(o);
  EXPECT_NEAR(s.back().angle_rad / kRadiansPerDegree, 10.4478 * 919 / 30, 1e-9);
  EXPECT_NEAR(10.4478 * 920 / 30, 320.4, 0.01);
}

TEST(TurntableMotion, TakesAsManyFramesAsTheTurnsNeedAtASpeed) {
  MotionOptions o;
  EXPECT_EQ(states_of(o).size(), 920u);
  o.speed_rad_s = 12.0 * kRadiansPerDegree;
  EXPECT_EQ(states_of(o).size(), 900u);
  o.turns = 0.5;
  o.start_ramp_s = 2.0;
  o.stop_ramp_s = 1.0;
  o.start_delay_s = 1.0;
  const auto s = states_of(o);
  ASSERT_EQ(s.size(), 525u);
  // The end of the last frame is the end of the half turn.
  EXPECT_NEAR(s.back().angle_rad, 0.5 * kTurn, 0.001);
}

TEST(TurntableMotion, WaitsThenSpeedsUpAndSlowsDownEvenly) {
  MotionOptions o;
  o.frames = 300;
  o.start_delay_s = 1.0;
  o.start_ramp_s = 2.0;
  o.stop_ramp_s = 3.0;
  const auto s = states_of(o);
  for (std::size_t i = 0; i <= 30; ++i) EXPECT_EQ(s[i].angle_rad, 0.0);
  const double full = speed_at(s, 150);
  EXPECT_NEAR(full, kTurn / (10.0 - 1.0 - 1.0 - 1.5), 1e-9);
  EXPECT_NEAR(speed_at(s, 60), 0.5 * full, 0.02 * full);
  EXPECT_NEAR(speed_at(s, 255), 0.5 * full, 0.02 * full);
  EXPECT_NEAR(s.back().angle_rad, kTurn, 0.001);
}

TEST(TurntableMotion, HaltsAndSlipsWhenItIsAskedTo) {
  MotionOptions o;
  o.frames = 300;
  o.halt_at_s = 4.0;
  o.halt_s = 2.0;
  o.slip_at_s = 8.0;
  o.slip_rad = -0.1;
  const auto s = states_of(o);
  const double full = kTurn / (10.0 - 2.0);
  EXPECT_NEAR(speed_at(s, 60), full, 1e-9);
  for (std::size_t i = 120; i < 180; ++i) EXPECT_NEAR(s[i].angle_rad, 4.0 * full, 1e-9);
  EXPECT_NEAR(speed_at(s, 200), full, 1e-9);
  EXPECT_NEAR(s[240].angle_rad - s[239].angle_rad, full / 30.0 - 0.1, 1e-9);
  EXPECT_NEAR(s.back().angle_rad, kTurn - 0.1 - full / 30.0, 1e-9);
  // With a speed, the halt takes frames of its own.
  o.frames.reset();
  o.speed_rad_s = full;
  EXPECT_EQ(states_of(o).size(), 300u);
}

TEST(TurntableMotion, RipplesByTheShareAskedFor) {
  MotionOptions o;
  o.frames = 5000;
  o.ripple = 0.01;
  o.ripple_cycles = 4.0;
  const auto s = states_of(o);
  const double mean = kTurn * 30.0 / 5000.0;
  double low = 1e9, high = 0.0;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    low = std::min(low, speed_at(s, i) / mean);
    high = std::max(high, speed_at(s, i) / mean);
  }
  EXPECT_NEAR(low, 0.99, 1e-5);
  EXPECT_NEAR(high, 1.01, 1e-5);
  // Whole cycles in a turn leave the turn what it is.
  EXPECT_NEAR(s[2500].angle_rad, 0.5 * kTurn, 1e-9);
}

TEST(TurntableMotion, LeansItsAxisByTheWobbleAndNoMore) {
  MotionOptions o;
  EXPECT_TRUE(axis_wobble(o, 1.0).isIdentity(0.0));
  o.wobble_rad = 0.01;
  Vec3d mean = Vec3d::Zero();
  for (int i = 0; i < 360; ++i) {
    const Vec3d axis = axis_wobble(o, i * kRadiansPerDegree) * Vec3d::UnitY();
    EXPECT_NEAR(std::acos(axis.y()), 0.01, 1e-9);
    mean += axis / 360.0;
  }
  EXPECT_NEAR(std::hypot(mean.x(), mean.z()), 0.0, 1e-12);
}

TEST(TurntableMotion, RunsOutByTheRadiusAndNoMore) {
  MotionOptions o;
  EXPECT_EQ(axis_runout(o, 1.0), Vec3d::Zero());
  o.runout_m = 0.002;
  // A point of the platter itself: it goes round with it, counter-clockwise seen from above.
  const double quarter = 90.0 * kRadiansPerDegree;
  EXPECT_LT((axis_runout(o, 0.0) - Vec3d(0.002, 0, 0)).norm(), 1e-12);
  EXPECT_LT((axis_runout(o, quarter) - Vec3d(0, 0, -0.002)).norm(), 1e-12);
  o.runout_cycles = 2.0;
  EXPECT_LT((axis_runout(o, quarter) - Vec3d(-0.002, 0, 0)).norm(), 1e-12);
}

TEST(TurntableMotion, DropsTheShareOfFramesAskedForWithoutRhyme) {
  MotionOptions o;
  int lost = 0, both = 0;
  for (std::uint32_t i = 0; i < 10000; ++i) EXPECT_FALSE(frame_dropped(o, 1, i, 0));
  o.dropped = 0.1;
  for (std::uint32_t i = 0; i < 10000; ++i) {
    lost += frame_dropped(o, 1, i, 0) ? 1 : 0;
    both += frame_dropped(o, 1, i, 0) && frame_dropped(o, 1, i, 1) ? 1 : 0;
  }
  EXPECT_NEAR(lost / 1e4, 0.1, test::mean_bound(0.3, 10000));
  EXPECT_NEAR(both / 1e4, 0.01, test::mean_bound(0.1, 10000));
  o.dropped = 1.0;
  EXPECT_TRUE(frame_dropped(o, 1, 7, 0));
}

TEST(TurntableMotion, RefusesWhatCannotBe) {
  MotionOptions o;
  o.frames = 0;
  expect_refused(o, "frames = 0");
  o = {};
  o.fps = 0.0;
  expect_refused(o, "fps");
  o = {};
  o.ripple = 1.0;
  expect_refused(o, "ripple");
  o = {};
  o.dropped = 1.5;
  expect_refused(o, "dropped = 1.5");
  o = {};
  o.wobble_rad = std::nan("");
  expect_refused(o, "wobble");
  o = {};
  o.runout_m = 0.2;
  expect_refused(o, "runout = 200mm");
  o.runout_m = std::nan("");
  expect_refused(o, "runout");
  o = {};
  o.runout_cycles = -1.0;
  expect_refused(o, "runout-cycles = -1");
  o = {};
  o.frames = 30;
  o.start_ramp_s = 0.6;
  o.stop_ramp_s = 0.6;
  expect_refused(o, "take 1.2s together, but the recording only 1s");
  o = {};
  o.frames = 30;
  o.halt_s = 2.0;
  expect_refused(o, "take 2s together, but the recording only 1s");
  o = {};
  o.frames = 30;
  o.slip_rad = 0.1;
  o.slip_at_s = 1.5;
  expect_refused(o, "slip-at = 1.5s is not within the recording");
  o = {};
  o.frames = 60;
  o.halt_s = 0.5;
  o.halt_at_s = 1.8;
  expect_refused(o, "halt-at = 1.8s is not within the recording");
  o = {};
  o.frames = 30;
  o.start_delay_s = 1.0;
  expect_refused(o, "no time to turn");
  o = {};
  o.speed_rad_s = 0.0;
  expect_refused(o, "speed = 0");
  o.speed_rad_s = 1e-9;
  expect_refused(o, "give a number of frames");
}

TEST(TurntableMotion, SaysWhereThePlatterIsBetweenTheFramesToo) {
  MotionOptions o;
  o.frames = 90;
  o.ripple = 0.1;
  o.slip_at_s = 1.0;
  o.slip_rad = 0.2;
  const auto s = states_of(o);
  for (std::size_t i = 0; i < 90; ++i) {
    EXPECT_EQ(platter_state_at(o, s[i].time_s).angle_rad, s[i].angle_rad);
    EXPECT_NEAR(platter_state_at(o, s[i].time_s).travel, s[i].travel, 1e-12);
  }
  // Halfway, and before the first frame as fast as after it.
  const double half = platter_state_at(o, 0.5 / 30.0).angle_rad;
  EXPECT_NEAR(half, 0.5 * s[1].angle_rad, 2e-4);
  EXPECT_NEAR(platter_state_at(o, -0.5 / 30.0).angle_rad, -half, 1e-12);
  o.start_ramp_s = 0.5;
  EXPECT_EQ(platter_state_at(o, -0.5 / 30.0).angle_rad, 0.0);
}

TEST(TurntableMotion, MayStandStill) {
  MotionOptions o;
  o.frames = 5;
  o.turns = 0.0;
  for (const PlatterState& s : states_of(o)) EXPECT_EQ(s.angle_rad, 0.0);
  o.speed_rad_s = 0.0;
  for (const PlatterState& s : states_of(o)) EXPECT_EQ(s.angle_rad, 0.0);
}

}  // namespace
}  // namespace turnscan
