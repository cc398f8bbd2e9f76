#include <gtest/gtest.h>

#include <ctime>
#include <numbers>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/checks/check.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr double kSpeed = 1.2 * 2.0 * kPi / 48.0;

/// A recording of the letter over 1.2 turns that says what is true, if the table turns evenly.
testing::MemorySequence recording(double drift_m = 0.0, testing::AngleLaw law = {}) {
  testing::RigOptions o = testing::near_rig(48, 1.2);
  o.objects = {*builtin_object("letter-a")};
  if (law) o.angle = std::move(law);
  const testing::Rig rig(o);
  testing::MemorySequence out;
  out.header_value = rig.header();
  out.header_value.turntable = rig.truth();
  out.header_value.turntable->speed_rad_s = kSpeed;
  for (std::size_t i = 0; i < 48; ++i) {
    Frame frame = *rig.read(i);
    for (std::uint16_t& z : frame.depth.pixels)
      if (z != 0) z = std::uint16_t(z + drift_m * 1e4 * double(i) / 47.0);
    out.add(std::move(frame));
  }
  return out;
}

std::vector<Finding> findings_of(const testing::MemorySequence& sequence) {
  auto findings = check_recording(sequence, {}, {});
  EXPECT_TRUE(findings) << findings.error().text();
  return findings ? *findings : std::vector<Finding>();
}

bool wrong(const std::vector<Finding>& findings, const std::string& what) {
  for (const Finding& f : findings)
    if (f.text.rfind(what, 0) == 0) return f.rating == Rating::kWrong;
  ADD_FAILURE() << what << " was not looked at";
  return false;
}

TEST(CheckRecording, FindsNothingWrongWithTheTruth) {
  for (const Finding& f : findings_of(recording())) EXPECT_EQ(f.rating, Rating::kGood) << f.text;
}

TEST(CheckRecording, SaysWhenTheDirectionIsMirrored) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  auto sequence = recording();
  *sequence.header_value.turntable->speed_rad_s *= -1.0;
  EXPECT_TRUE(wrong(findings_of(sequence), "Direction"));
}

TEST(CheckRecording, SaysWhenTheSpeedIsNotTheStatedOne) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  auto sequence = recording();
  *sequence.header_value.turntable->speed_rad_s *= 1.02;
  const auto findings = findings_of(sequence);
  EXPECT_TRUE(wrong(findings, "Speed"));
  EXPECT_TRUE(wrong(findings, "Closure"));
}

TEST(CheckRecording, SaysWhenTheTurntableIsElsewhere) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  auto sequence = recording();
  sequence.header_value.turntable->center_m.x() += 0.004;
  EXPECT_TRUE(wrong(findings_of(sequence), "Place"));
}

TEST(CheckRecording, SaysWhenTheSensorWarmsUp) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  EXPECT_TRUE(wrong(findings_of(recording(0.004)), "Warm-up"));
}

TEST(CheckRecording, SaysWhenTheTableStopsForAWhile) {
  // From 20 s to 26 s it stands.
  const auto stops = [](double t) { return kSpeed * (t < 20.0 ? t : std::max(20.0, t - 6.0)); };
  const auto findings = findings_of(recording(0.0, stops));
  EXPECT_TRUE(wrong(findings, "Motor"));
  EXPECT_NE(findings.back().text.find("slowed down or stopped"), std::string::npos)
      << findings.back().text;
}

TEST(CheckRecording, SaysWhenTheObjectSlips) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  // At 24 s it jumps ahead by three frames' worth.
  const auto slips = [](double t) { return kSpeed * (t + (t > 24.0 ? 3.0 : 0.0)); };
  const auto findings = findings_of(recording(0.0, slips));
  EXPECT_TRUE(wrong(findings, "Motor"));
  EXPECT_NE(findings.back().text.find("slipped ahead by about 2"), std::string::npos)
      << findings.back().text;
}

TEST(MeasureClosure, NeedsATurntableAndAWholeTurn) {
  auto sequence = recording();
  EXPECT_TRUE(measure_closure(sequence, {})->has_value());
  sequence.infos.resize(20);
  EXPECT_FALSE(measure_closure(sequence, {})->has_value());
  sequence.header_value.turntable.reset();
  EXPECT_EQ(measure_closure(sequence, {}).error().code, ErrorCode::kMissingData);
}

TEST(MeasureClosure, LooksAtManyFramesInTimeThatGrowsWithTheirNumber) {
  if (testing::kSanitized) GTEST_SKIP() << "it takes time";
  auto sequence = recording();
  const FrameInfo one = sequence.infos.front();
  sequence.infos.assign(400000, one);
  for (std::size_t i = 0; i < sequence.infos.size(); ++i) {
    sequence.infos[i].index = std::uint32_t(i);
    sequence.infos[i].angle_rad = 1e-9 * double(i);  // no two are a turn apart
  }
  const std::clock_t begin = std::clock();
  EXPECT_FALSE(measure_closure(sequence, {})->has_value());
  EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 10.0);
}

TEST(MeasureClosure, WhatNoiseAloneShowsCondemnsNoCalibration) {
  ClosureError closure{.shift_m = 0.0027, .noise_m = 0.0024, .pairs = 2};
  EXPECT_FALSE(closure.significant());
  closure.noise_m = 0.0005;
  EXPECT_TRUE(closure.significant());
  closure = {.turn_rad = 0.02, .shift_m = 0.0, .noise_m = 0.0024, .pairs = 2};
  EXPECT_TRUE(closure.significant());
}

TEST(MeasureClosure, PairsThatDisagreeAmongEachOtherCondemnNoCalibration) {
  ClosureError closure{.turn_rad = 0.056, .shift_m = 0.0009, .noise_m = 0.0013, .pairs = 2};
  EXPECT_TRUE(closure.significant());
  closure.turn_sigma_rad = 0.038;
  EXPECT_FALSE(closure.significant());
  closure = {.turn_rad = 0.0, .shift_m = 0.0022, .noise_m = 0.0006, .pairs = 6};
  EXPECT_TRUE(closure.significant());
  closure.excess_sigma_m2 = 3e-6;
  EXPECT_FALSE(closure.significant());
}

TEST(MeasureClosure, SaysHowFarChanceMovesItsPairs) {
  const auto closure = measure_closure(recording(), {});
  ASSERT_TRUE(closure && *closure);
  EXPECT_GT((*closure)->turn_sigma_rad, 0.0);
  EXPECT_GT((*closure)->excess_sigma_m2, 0.0);
  EXPECT_LT(std::abs((*closure)->turn_rad), 4.0 * (*closure)->turn_sigma_rad);
}

TEST(MeasureClosure, SaysWhenTheNoiseWasNotMeasured) {
  ClosureError closure{.shift_m = 0.0027, .noise_m = 0.0024, .pairs = 2};
  EXPECT_EQ(closure.noise_text(), "noise alone makes 2.40 mm");
  closure.noise_m = 0.0;
  EXPECT_NE(closure.noise_text().find("is not known"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
