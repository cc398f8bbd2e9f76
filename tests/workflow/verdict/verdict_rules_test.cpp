#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>
#include <turnscan/workflow/text/verdict_text.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

/// Frames that look at the table from headings in degrees.
testing::MemorySequence looking_from(const std::vector<double>& headings) {
  testing::MemorySequence out;
  out.header_value.sensors.resize(1);
  for (const double heading : headings) {
    Frame frame;
    Pose T = rotation_about_y(heading * kRadiansPerDegree);
    T.translation() = T.linear() * Vec3d(0.8, 0.3, 0.0);
    frame.info.T_table_sensor = T;
    out.add(frame);
  }
  return out;
}

TEST(TurnSeen, CountsTheHeadingsBesideWhichAFrameLooks) {
  std::vector<double> whole, half;
  for (int i = 0; i <= 36; ++i) whole.push_back(10.0 * i), half.push_back(5.0 * i);
  const auto all = turn_seen(looking_from(whole), {});
  ASSERT_TRUE(all);
  EXPECT_NEAR(all->share, 1.0, 1e-9);
  EXPECT_NEAR(all->turns, 1.0, 1e-6);
  const auto some = turn_seen(looking_from(half), {});
  ASSERT_TRUE(some);
  EXPECT_NEAR(some->share, (180.0 + 40.0) / 360.0, 1e-6);
  EXPECT_NEAR(some->turns, 0.5, 1e-6);
}

TEST(TurnSeen, IsNotKnownWhereNothingSaysWhereTheFramesWere) {
  testing::MemorySequence frames = looking_from({0.0, 90.0});
  for (FrameInfo& info : frames.infos) info.T_table_sensor.reset();
  EXPECT_FALSE(turn_seen(frames, {}));
}

ReconstructRun scan_of(double turns) {
  SceneDescription scene;
  scene.object = "builtin:cylinder";
  scene.motion.frames = 30;
  scene.motion.turns = turns;
  scene.measure.noise = "gaussian:0.5mm";
  const auto simulation = prepare_simulation(scene, {});
  auto run = run_reconstruction(simulation->scan, ReconstructRequest(), {});
  EXPECT_TRUE(run) << run.error().text();
  return std::move(*run);
}

const VerdictSentence* sentence(const Verdict& verdict, const std::string& topic) {
  for (const VerdictSentence& s : verdict.sentences)
    if (s.topic == topic) return &s;
  return nullptr;
}

TEST(JudgeObjects, CallsAWholeTurnOfASimpleObjectGreenAndAQuarterRed) {
  const ReconstructRun whole = scan_of(1.0), quarter = scan_of(0.25);
  const ObjectResult &good = whole.reconstruction.objects.at(0),
                     &bad = quarter.reconstruction.objects.at(0);
  ASSERT_TRUE(good.verdict && bad.verdict);
  EXPECT_EQ(good.verdict->colour(), "green") << verdict_text(*good.verdict);
  EXPECT_EQ(bad.verdict->colour(), "red") << verdict_text(*bad.verdict);
  EXPECT_TRUE(bad.check.watertight()) << "which is no promise";
  EXPECT_EQ(sentence(*bad.verdict, "mesh")->text.find("can be printed"), std::string::npos);
  EXPECT_NE(sentence(*good.verdict, "mesh")->text.find("can be printed"), std::string::npos);
  EXPECT_EQ(sentence(*bad.verdict, "invented")->level, Level::kBad);
  EXPECT_NEAR(sentence(*good.verdict, "turn")->value, 360.0, 1.0);
}

TEST(JudgeObjects, KnowsHowWellEveryVertexIsKnown) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const ReconstructRun run = scan_of(1.0);
  const ObjectResult& object = run.reconstruction.objects.at(0);
  ASSERT_EQ(object.quality.size(), object.mesh.vertices.size());
  for (std::size_t v = 0; v < object.quality.size(); ++v) {
    EXPECT_GT(object.quality[v].expected_error_m, 0.0f);
    EXPECT_LE(object.quality[v].frames, 30);
  }
}

TEST(JudgeObjects, CallsUncorrectedDisturbancesAndOpenMeshesBad) {
  Reconstruction run;
  run.objects.emplace_back().mesh.vertices.resize(3, Vec3f::Zero());
  CalibrationChoice choice;
  judge_objects(run, {std::nullopt, &choice});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "mesh")->level, Level::kBad);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "disturbance"), nullptr);
  choice.disturbances.emplace_back().text = "the object moved";
  judge_objects(run, {std::nullopt, &choice});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "disturbance")->level, Level::kBad);
  choice.poses.resize(1);
  judge_objects(run, {std::nullopt, &choice});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "disturbance")->level, Level::kGood);
}

TEST(VerdictText, SaysTheColourAndASentenceALine) {
  Verdict verdict;
  verdict.sentences = {{"turn", Level::kGood, "all sides", 360.0, "deg"},
                       {"error", Level::kFair, "0.4 mm", 0.4, "mm"}};
  EXPECT_EQ(verdict_text(verdict),
            "Verdict: AMBER\n  turn   good  all sides\n  error  fair  0.4 mm\n");
}

}  // namespace
}  // namespace turnscan
