// tests/consumer compares the api with the command line; here are its own promises.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <turnscan/turnscan.hpp>

namespace turnscan {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;

const Options kCoarse{{"voxel-size", "8mm"}};

const SimulatedScan& cylinder() {
  static const SimulatedScan scan = *simulate("builtin:cylinder", {{"frames", "16"}});
  return scan;
}

TEST(Options, ThatDoNotExistAreRefusedWithTheirName) {
  const Options wrong{{"voxel-sise", "1mm"}};
  for (const Error& error :
       {reconstruct(cylinder().frames(), wrong).error(),
        calibrate(cylinder().frames(), wrong).error(), simulate("builtin:cylinder", wrong).error(),
        evaluate(cylinder().truth(), cylinder().truth(), wrong).error(),
        plan_rig({"builtin:cylinder"}, wrong).error(), open_frames(".", wrong).error()}) {
    EXPECT_EQ(error.code, ErrorCode::kInvalidOption);
    EXPECT_THAT(error.message, HasSubstr("voxel-sise"));
  }
}

TEST(Options, TheLastValueOfANameApplies) {
  const auto a =
      evaluate(cylinder().truth(), cylinder().truth(), {{"samples", "300"}, {"samples", "700"}});
  ASSERT_TRUE(a) << a.error().text();
  EXPECT_EQ(a->accuracy.count, 700u);
}

TEST(Options, ThatMayBeRepeatedAllCount) {
  const auto scan =
      simulate("builtin:cylinder",
               {{"frames", "2"}, {"scanner", "kinect-v2"}, {"scanner", "kinect-v2,azimuth=90deg"}});
  ASSERT_TRUE(scan) << scan.error().text();
  EXPECT_EQ(scan->frames().header().sensors.size(), 2u);
  EXPECT_THAT(simulate_options(), Contains(Field(&OptionDescription::repeatable, true)));
}

TEST(Options, DescribeThemselvesWithDefaultsThatCanBeGiven) {
  Options defaults;
  for (const OptionDescription& option : evaluate_options())
    defaults.emplace_back(option.name, option.default_value);
  EXPECT_GT(defaults.size(), 5u);
  EXPECT_TRUE(evaluate(cylinder().truth(), cylinder().truth(), defaults));
}

TEST(Stream, GivesTheMeshOfAllFramesAtOnce) {
  const FrameSequence& frames = cylinder().frames();
  auto stream = Stream::create(frames.header(), kCoarse);
  ASSERT_TRUE(stream) << stream.error().text();
  for (std::size_t i = 0; i < frames.frames().size(); ++i)
    ASSERT_TRUE(stream->add(*frames.read(i)));
  const auto streamed = stream->finish();
  ASSERT_TRUE(streamed) << streamed.error().text();
  const auto whole = reconstruct(frames, kCoarse);
  ASSERT_TRUE(whole) << whole.error().text();
  EXPECT_EQ(streamed->objects().front().mesh.vertices, whole->objects().front().mesh.vertices);
  EXPECT_EQ(streamed->objects().front().mesh.triangles, whole->objects().front().mesh.triangles);
}

TEST(Stream, IsWrittenWithReportAndPage) {
  const FrameSequence& frames = cylinder().frames();
  auto stream = Stream::create(frames.header(), kCoarse);
  for (std::size_t i = 0; i < frames.frames().size(); ++i)
    ASSERT_TRUE(stream->add(*frames.read(i)));
  const auto scan = stream->finish();
  ASSERT_TRUE(scan) << scan.error().text();
  const std::string stem = testing::TempDir() + "api_stream";
  const auto files =
      scan->write({.mesh = stem + ".stl", .report = stem + ".json", .page = stem + ".html"});
  ASSERT_TRUE(files) << files.error().text();
  EXPECT_EQ(files->size(), 3u);
  for (const std::string& file : *files) {
    EXPECT_GT(std::filesystem::file_size(file), 100u) << file;
    std::filesystem::remove(file);
  }
}

TEST(SimulatedScan, EvaluatesItsReconstruction) {
  const auto scan = reconstruct(cylinder().frames(), kCoarse);
  ASSERT_TRUE(scan) << scan.error().text();
  const auto figures = cylinder().evaluate(scan->objects().front().mesh, {{"samples", "2000"}});
  ASSERT_TRUE(figures) << figures.error().text();
  EXPECT_LT(figures->accuracy.median, 2e-3);
  EXPECT_LT(figures->seen_area_m2, figures->reference_area_m2) << "nobody sees the base";
}

TEST(SimulatedScan, OfTheEmptyTableHasNoTruth) {
  const auto scan = simulate("builtin:empty", {{"frames", "2"}});
  ASSERT_TRUE(scan) << scan.error().text();
  EXPECT_EQ(scan->passes(), 0u);
  EXPECT_THROW(scan->truth(), std::out_of_range);
  EXPECT_EQ(scan->evaluate(cylinder().truth()).error().code, ErrorCode::kTooFewPoints);
}

TEST(Reconstruct, OfNothingIsRefused) {
  EXPECT_EQ(reconstruct(std::vector<NamedFrames>{}).error().code, ErrorCode::kInvalidOption);
}

TEST(Calibrate, TakesOneWayAlone) {
  const auto both = calibrate(cylinder().frames(), {{"detect", "true"}, {"from-motion", "true"}});
  EXPECT_EQ(both.error().code, ErrorCode::kInvalidOption);
  const auto detected = calibrate(cylinder().frames(), {{"detect", "true"}});
  ASSERT_TRUE(detected) << detected.error().text();
  EXPECT_EQ(detected->method, CalibrationMethod::kDetected);
}

TEST(Calibrate, RefusesWhatWouldDoNothing) {
  for (const Options& options :
       {Options{{"depth-also", "elsewhere"}}, {{"gauge-ball", "50mm"}}, {{"depth-bias", "true"}}}) {
    const auto made = calibrate(cylinder().frames(), options);
    ASSERT_FALSE(made) << options.front().first;
    EXPECT_EQ(made.error().code, ErrorCode::kInvalidOption) << options.front().first;
  }
}

TEST(Batch, WithoutItsProgramIsNotFound) {
  Batch batch;
  batch.inputs = {"nowhere"};
  batch.program = "there-is-no-such-program";
  EXPECT_EQ(run_batch(batch, "nowhere-either").error().code, ErrorCode::kNotFound);
}

TEST(OpenFrames, SaysWhatIsThere) {
  EXPECT_EQ(open_frames("nowhere").error().code, ErrorCode::kNotFound);
  const std::filesystem::path folder = testing::TempDir() + "api_recording";
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(cylinder().record(folder));
  const auto opened = open_frames(folder);
  ASSERT_TRUE(opened) << opened.error().text();
  EXPECT_TRUE(opened->complete);
  EXPECT_FALSE(opened->imported);
  EXPECT_EQ(opened->frames->frames().size(), 16u);
  EXPECT_EQ(open_frames(folder, {{"depth-unit", "1mm"}}).error().code, ErrorCode::kInvalidOption);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace turnscan
