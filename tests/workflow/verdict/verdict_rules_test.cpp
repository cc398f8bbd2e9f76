#include <gtest/gtest.h>

#include <numbers>
#include <optional>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>
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
  EXPECT_NEAR(all->widest_gap_rad, 10.0 * kRadiansPerDegree, 1e-6);
  EXPECT_NEAR(some->widest_gap_rad, 180.0 * kRadiansPerDegree, 1e-6);
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
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
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
  ScanKnowledge known;
  known.choice = &choice;
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "mesh")->level, Level::kBad);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "disturbance"), nullptr);
  choice.disturbances.emplace_back().text = "the object moved";
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "disturbance")->level, Level::kBad);
  choice.poses.resize(1);
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "disturbance")->level, Level::kGood);
}

TEST(JudgeObjects, CallWhatCannotBeBadAndWhatMayBeAMirrorImageFair) {
  Reconstruction run;
  run.objects.emplace_back().mesh.vertices.resize(3, Vec3f::Zero());
  CalibrationChoice choice;
  ScanKnowledge known;
  known.choice = &choice;
  known.findings = {{Plausibility::kDoubtful, "nothing changes", ""}};
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "plausibility"), nullptr);
  choice.may_be_mirrored = true;
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "plausibility")->level, Level::kFair);
  known.findings.push_back({Plausibility::kImplausible, "times go back", ""});
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "plausibility")->level, Level::kBad);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "plausibility")->text, "Times go back.");
}

/// An upright square sheet.
Reconstruction sheet() {
  Reconstruction run;
  ObjectResult& object = run.objects.emplace_back();
  object.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  object.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  object.evidence.assign(2, Evidence::kMeasured);
  object.quality.assign(4, VertexQuality{1e-4f, 20, 3});
  return run;
}

TEST(JudgeObjects, GoByWhatFramesCouldSee) {
  Reconstruction run = sheet();
  ScanKnowledge known;
  known.seen = {{{0, 1, 2, 3}, {1, 1, 1, 1}}};
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "invented")->level, Level::kGood);
  known.seen[0].seen = {1, 1, 1, 0};  // a sixth of the area
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "invented")->level, Level::kFair);
  known.seen[0].seen = {1, 1, 0, 0};
  run.objects[0].quality[3].expected_error_m = 0.1f;  // which no frame could see
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "invented")->level, Level::kBad);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "error")->level, Level::kGood);
}

FrameResidual residual(std::uint32_t frame, double off_m) {
  FrameResidual out;
  out.frame = frame;
  out.time_s = 0.1 * frame;
  out.shift_m.x() = off_m;
  out.spread_m = 0.0005;
  return out;
}

TEST(JudgeObjects, ExpectAWrongAxisToMoveWhatStandsUprightAndNotWhatLiesFlat) {
  Reconstruction run = sheet();
  CalibrationChoice choice;
  choice.calibration.emplace();
  choice.calibration->axis_sigma_rad = 0.0;
  choice.calibration->center_sigma_m = 0.001;
  ScanKnowledge known;
  known.choice = &choice;
  judge_objects(run, known);
  EXPECT_NEAR(run.objects[0].quality[0].expected_error_m, std::hypot(0.001 / std::sqrt(2.0), 1e-4),
              1e-6);
  run = sheet();
  for (Vec3f& p : run.objects[0].mesh.vertices) std::swap(p.y(), p.z());
  judge_objects(run, known);
  EXPECT_NEAR(run.objects[0].quality[0].expected_error_m, 1e-4, 1e-6);
}

TEST(JudgeObjects, DoNotCallAScanBadForDroppedFramesAlone) {
  Reconstruction run = sheet();
  run.frames = 30, run.dropped_frames = 30;
  judge_objects(run, {});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "frames")->level, Level::kGood);
  run.dropped_frames = 31;
  judge_objects(run, {});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "frames")->level, Level::kFair);
}

TEST(JudgeObjects, SayWhichFramesDisagree) {
  Reconstruction run = sheet();
  ScanKnowledge known;
  known.residuals.resize(1);
  for (std::uint32_t i = 0; i < 40; ++i)
    known.residuals[0].push_back(residual(i, i == 20 || i == 21 || i == 30 ? 0.004 : 0.0001));
  judge_objects(run, known);
  const VerdictSentence* apart = sentence(*run.objects[0].verdict, "apart");
  ASSERT_NE(apart, nullptr);
  EXPECT_EQ(apart->level, Level::kFair);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "agreement")->level, Level::kFair);
  EXPECT_EQ(apart->text,
            "3 of 40 frames lie elsewhere than the rest: frames 20 to 21 at 2.0 to 2.1 s (4.0 mm), "
            "frame 30 at 3.0 s (4.0 mm).");
  known.residuals[0].resize(20);
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "apart"), nullptr);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "agreement")->level, Level::kGood);
}

TEST(JudgeObjects, LetFewFramesThatDisagreeBeOutvoted) {
  Reconstruction run = sheet();
  ScanKnowledge known;
  known.residuals.resize(1);
  for (std::uint32_t i = 0; i < 100; ++i)
    known.residuals[0].push_back(residual(i, i % 33 == 1 ? 0.004 : 0.0001));
  judge_objects(run, known);
  const VerdictSentence* apart = sentence(*run.objects[0].verdict, "apart");
  ASSERT_NE(apart, nullptr);
  EXPECT_EQ(apart->level, Level::kGood) << apart->text;
}

TEST(JudgeObjects, CallBadWhatManyFramesSeeElsewhere) {
  Reconstruction run = sheet();
  ScanKnowledge known;
  known.residuals.resize(1);
  for (std::uint32_t i = 0; i < 39; ++i)
    known.residuals[0].push_back(residual(i, i < 11 ? 0.004 : 0.0001));
  judge_objects(run, known);
  const VerdictSentence* apart = sentence(*run.objects[0].verdict, "apart");
  ASSERT_NE(apart, nullptr);
  EXPECT_EQ(apart->level, Level::kBad) << apart->text;
  EXPECT_EQ(run.objects[0].verdict->colour(), "red");
}

/// What is known of a turn that breaks off after turned_deg.
std::optional<TurnSeen> turn_of(double turned_deg) {
  std::vector<double> headings;
  for (double heading = 0.0; heading <= turned_deg; heading += 2.0) headings.push_back(heading);
  return turn_seen(looking_from(headings), {});
}

TEST(JudgeObjects, AdviseAWholeTurnOnlyWhereTheTurnIsNotGood) {
  Reconstruction run = sheet();
  ScanKnowledge known;
  for (double turned_deg = 100.0; turned_deg < 360.0; turned_deg += 20.0) {
    known.turn = turn_of(turned_deg);
    judge_objects(run, known);
    const Verdict& verdict = *run.objects[0].verdict;
    const VerdictSentence* help = sentence(verdict, "help");
    const bool advised = help != nullptr && help->text.find("whole turn") != std::string::npos;
    EXPECT_EQ(advised, sentence(verdict, "turn")->level != Level::kGood) << turned_deg;
  }
}

TEST(JudgeObjects, CallPrintableOnlyWhatFramesLookAtFromAllSides) {
  Reconstruction run = sheet();
  ObjectResult& object = run.objects[0];
  object.check.closed = object.check.manifold = true;
  object.check.oriented = object.check.outward = true;
  ScanKnowledge known;
  const auto said = [&](double turned_deg) {
    known.turn = turn_of(turned_deg);
    judge_objects(run, known);
    return sentence(*object.verdict, "mesh")->text;
  };
  EXPECT_EQ(said(358.0), "It is watertight and can be printed.");
  EXPECT_EQ(said(250.0), "It is watertight and can be printed.");
  EXPECT_EQ(sentence(*object.verdict, "turn")->level, Level::kGood);
  EXPECT_EQ(sentence(*object.verdict, "turn")->text,
            "The frames look from all sides, up to 110 degrees apart.");
  EXPECT_EQ(said(236.0).find("can be printed"), std::string::npos);
  EXPECT_EQ(sentence(*object.verdict, "turn")->level, Level::kFair);
  EXPECT_EQ(said(0.4 * 360.0).find("can be printed"), std::string::npos) << "nothing else is wrong";
  EXPECT_EQ(object.verdict->colour(), "amber");
}

TEST(JudgeObjects, SayHowMuchASecondPassWouldShow) {
  Reconstruction run = sheet();
  ScanKnowledge known;
  NextPose pose;
  pose.tip_rad = 0.25 * kTurn;
  pose.towards_rad = 0.75 * kTurn;
  pose.shows_m2 = 0.31;
  known.next_pass.emplace();
  known.next_pass->poses = {pose};
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "help")->text,
            "A second pass would show 3100 cm2 more: lay it on its left side (turnscan scan "
            "--passes 2).");
  run.passes.resize(2);
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "help")->text,
            "Another pass would show 3100 cm2 more: lay it on its left side (turnscan scan "
            "--passes 3).");
}

TEST(JudgeObjects, AdviseToTurnSlowerWhereFewFramesSawItAndToStandNearerElse) {
  Reconstruction run = sheet();
  for (VertexQuality& q : run.objects[0].quality) q.expected_error_m = 0.001f;
  judge_objects(run, {});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "help")->text.rfind("Let the table turn", 0), 0u);
  for (VertexQuality& q : run.objects[0].quality) q.frames = 200;
  judge_objects(run, {});
  EXPECT_EQ(sentence(*run.objects[0].verdict, "help")->text.rfind("Move the sensor to half", 0),
            0u);
}

TEST(JudgeObjects, SayHowOldTheCalibrationIsAndWhatThePlatterSaysOfIt) {
  Reconstruction run = sheet();
  CalibrationChoice choice;
  ScanKnowledge known;
  known.choice = &choice;
  known.table_recorded = true;
  known.dates = {"2026-11-01T08:00:00Z", "2026-08-01T08:00:00Z"};
  judge_objects(run, known);
  const auto said = [&] { return *sentence(*run.objects[0].verdict, "calibration"); };
  EXPECT_EQ(
      said().text,
      "No platter was seen in it to check the calibration by. The calibration was made 3 months "
      "before this recording (2026-08-01).");
  EXPECT_EQ(said().level, Level::kGood);
  known.platter.emplace();
  known.platter->moved = true;
  known.platter->height_m = -0.001, known.platter->shift_m = 0.006, known.platter->tilt_rad = 0.01;
  judge_objects(run, known);
  EXPECT_EQ(said().level, Level::kFair);
  EXPECT_EQ(
      said().text.rfind("The platter in it lies 1.0 mm lower, 6.0 mm aside and tilted by 0.57 "
                        "deg against the calibration",
                        0),
      0u)
      << said().text;
  EXPECT_NEAR(run.objects[0].quality[0].expected_error_m,
              std::hypot(0.003, 0.005 * 0.5) / std::numbers::sqrt2, 1e-4)
      << "half of it may be the platter's, one of its two directions is towards the sensor";
}

TEST(JudgeObjects, CallACalibrationFairThatNeitherTheMotionNorAPlatterConfirms) {
  Reconstruction run = sheet();
  CalibrationChoice choice;
  choice.checks.axis_offset = AxisOffset{.shift_m = 0.002, .shift_sigma_m = 0.0008};
  ScanKnowledge known;
  known.choice = &choice;
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "calibration")->level, Level::kFair);
  known.platter.emplace();  // which lies where the calibration says
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "calibration")->level, Level::kGood);
  known.platter.reset();
  choice.checks.axis_offset->shift_m = 0.001;
  judge_objects(run, known);
  EXPECT_EQ(sentence(*run.objects[0].verdict, "calibration")->level, Level::kGood);
}

TEST(VerdictText, SaysTheColourAndASentenceALine) {
  Verdict verdict;
  verdict.sentences = {{"turn", Level::kGood, "all sides", 360.0, "deg"},
                       {"error", Level::kFair, "0.4 mm", 0.4, "mm"},
                       {"help", Level::kGood, "a second pass", 31.0, "cm2"}};
  EXPECT_EQ(verdict_text(verdict),
            "Verdict: AMBER\n  turn   good  all sides\n  error  fair  0.4 mm\n"
            "  help   note  a second pass\n"
            "docs/how-to/bad-scan.md lists causes and remedies.\n");
}

TEST(ReconstructionText, BeginsWithTheVerdict) {
  Reconstruction run = sheet();
  run.notes.emplace_back("a note");
  run.choices.push_back({"voxel-size", "1mm", "given"});
  judge_objects(run, {});
  const std::string text = reconstruction_text(run);
  EXPECT_EQ(text.rfind("Verdict: ", 0), 0u) << text;
  EXPECT_LT(text.find("Note: a note"), text.find("voxel-size")) << text;
}

}  // namespace
}  // namespace turnscan
