#include <gtest/gtest.h>

#include <numbers>
#include <thread>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/turntable/table_frame.hpp>

#include "tests/capture/taking.hpp"
#include "tests/recording/sequences.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using Kind = Delivery::Kind;
using testing::opened;
using testing::run;
using testing::take_all;
using testing::Taken;
using testing::TempFolder;

// A cylinder, small and quick to render.
const std::string kVirtual = "virtual:cylinder?sensor=kinect-v1&distance=1.5m";

/// A recording of four frames, the third of them lost.
std::filesystem::path small_recording(const TempFolder& folder) {
  std::vector<Frame> frames;
  for (std::uint32_t i = 0; i < 4; ++i) {
    frames.push_back(testing::depth_frame(i));
    if (i == 2) frames.back().info.status = FrameStatus::kDropped;
  }
  const testing::CountingFrames sequence(testing::small_header(), std::move(frames));
  EXPECT_TRUE(write_recording(folder / "rec", sequence, {}));
  return folder / "rec";
}

TEST(FrameSource, VirtualFramesAreTheSimulatorsAndEndWhereTheyShould) {
  const auto source = opened(kVirtual + "&frames=5&angles=1");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().frame_count, 5u);
  EXPECT_FALSE(source->info().live);
  const Taken taken = run(*source);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 5u);
  for (std::uint32_t i = 0; i < 5; ++i) {
    const Frame& frame = taken.frames[i];
    EXPECT_EQ(frame.info.index, i);
    EXPECT_NEAR(frame.info.time_s, i / 30.0, 1e-12);
    EXPECT_NEAR(frame.info.angle_rad.value(), i * 2.0 * std::numbers::pi / 5, 1e-9);
    EXPECT_EQ(frame.depth.width, source->info().header.sensors[0].intrinsics.width);
  }
  EXPECT_EQ(source->statistics().delivered, 5u);
  EXPECT_EQ(source->statistics().dropped(), 0u);
}

/// Height above the platter of what a frame of the second row's middle shows: the object's top, or
/// 0.
double top_of(const Frame& frame, const SourceInfo& info) {
  const SensorInfo& sensor = info.header.sensors[0];
  const auto points = points_of(frame, sensor, RayTable(sensor.intrinsics));
  const Pose T_table_sensor = *table_from_sensor(*info.header.turntable);
  double top = 0.0;
  for (const Vec3f& p : points->cloud.points)
    top = std::max(top, (T_table_sensor * p.cast<double>()).y());
  return top;
}

TEST(FrameSource, AVirtualObjectIsLaidAnotherWay) {
  const auto source = opened(kVirtual + "&calibration=true&noise=none&frames=8");
  ASSERT_TRUE(source);
  ASSERT_TRUE(source->info().lays_object);
  const Taken upright = run(*source);
  ASSERT_EQ(upright.frames.size(), 8u);
  EXPECT_NEAR(top_of(upright.frames[0], source->info()), 0.16, 0.003);
  // By 90 degrees to the side, about the line of sight.
  const Eigen::Matrix3d aside =
      Eigen::AngleAxisd(std::numbers::pi / 2, Vec3d::UnitZ()).toRotationMatrix();
  EXPECT_EQ(source->lay_object(aside, 77.0).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(source->lay_object(aside, upright.frames[2].info.time_s));
  const Taken lying = run(*source);
  ASSERT_EQ(lying.frames.size(), 8u);
  EXPECT_GT(lying.frames[0].info.time_s, upright.frames.back().info.time_s);
  // On its side, or nearly: the sensor looks down a little.
  EXPECT_NEAR(top_of(lying.frames[0], source->info()), 0.08, 0.04);
  EXPECT_NE(lying.frames[0].depth.pixels, upright.frames[0].depth.pixels);
  // And from how it lay first, not from how it lies now.
  ASSERT_TRUE(source->lay_object(Eigen::Matrix3d::Identity(), upright.frames[0].info.time_s));
  EXPECT_NEAR(top_of(run(*source).frames[0], source->info()), 0.16, 0.003);
}

TEST(FrameSource, ARecordedObjectStaysAsItLies) {
  const TempFolder folder;
  const auto source = opened("replay:" + small_recording(folder).string());
  EXPECT_FALSE(source->info().lays_object);
  EXPECT_EQ(source->lay_object(Eigen::Matrix3d::Identity(), 0.0).error().code,
            ErrorCode::kUnsupported);
}

TEST(FrameSource, AVirtualSensorKnowsNothingOfTheTableUnlessTold) {
  const auto blind = opened(kVirtual);
  EXPECT_FALSE(blind->info().header.turntable);
  EXPECT_FALSE(blind->info().frame_count);
  EXPECT_EQ(blind->info().identities, std::vector<std::string>{"virtual-kinect-v1-0"});
  const auto knowing = opened(kVirtual + "&calibration=true");
  EXPECT_TRUE(knowing->info().header.turntable);
}

TEST(FrameSource, TheSameUriGivesTheSameFrames) {
  const std::string uri = kVirtual + "&frames=40&turns=0.1&seed=3&queue=2";
  const Taken a = run(*opened(uri)), b = run(*opened(uri));
  ASSERT_EQ(a.frames.size(), 40u);
  ASSERT_EQ(b.frames.size(), 40u);
  for (std::size_t i = 0; i < 40; ++i)
    EXPECT_EQ(a.frames[i].depth.pixels, b.frames[i].depth.pixels);
}

TEST(FrameSource, GoesOnWhereItWasStoppedAndGivesWhatWaited) {
  const auto source = opened(kVirtual + "&frames=12&queue=3");
  ASSERT_TRUE(source->start());
  std::vector<std::uint32_t> indices;
  indices.push_back(source->next(20.0, {})->frame.info.index);
  source->stop();
  for (const Frame& frame : take_all(*source).frames) indices.push_back(frame.info.index);
  EXPECT_LT(indices.size(), 12u);
  for (const Frame& frame : run(*source).frames) indices.push_back(frame.info.index);
  ASSERT_EQ(indices.size(), 12u);
  for (std::uint32_t i = 0; i < 12; ++i) EXPECT_EQ(indices[i], i);
}

TEST(FrameSource, TheObjectMayBePutOnTheTableLater) {
  const auto source = opened(kVirtual + "&frames=4&noise=none&appears=0.05s");
  const auto frames = run(*source).frames;
  const auto empty = run(*opened("virtual:empty?sensor=kinect-v1&distance=1.5m&frames=4&noise=none&"
                                 "aim-height=80mm"))
                         .frames;
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0].depth.pixels, empty[0].depth.pixels);
  EXPECT_EQ(frames[1].depth.pixels, empty[1].depth.pixels);
  EXPECT_NE(frames[2].depth.pixels, empty[2].depth.pixels);
}

TEST(FrameSource, ALiveSourceDropsWhatNobodyTakesAndSaysWhere) {
  const auto source = opened(kVirtual + "&frames=30&fps=300&realtime=1&prepared=1&queue=4");
  EXPECT_TRUE(source->info().live);
  ASSERT_TRUE(source->start());
  // All are due after a tenth of a second; the queue is closed when the last has come.
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const Taken taken = take_all(*source);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 30u);
  std::size_t lost = 0;
  for (std::uint32_t i = 0; i < 30; ++i) {
    EXPECT_EQ(taken.frames[i].info.index, i);
    lost += taken.frames[i].info.status == FrameStatus::kDropped ? 1 : 0;
  }
  EXPECT_GE(lost, 20u);
  EXPECT_EQ(source->statistics().dropped(), lost);
  EXPECT_LE(source->statistics().most_waiting, 4u);
}

TEST(FrameSource, CancellingEndsAWaitAtOnce) {
  const auto source = opened(kVirtual + "&frames=5&fault=stall@0s+3600s&realtime=1");
  ASSERT_TRUE(source->start());
  EXPECT_EQ(source->next(0.01, {})->kind, Kind::kNothing);
  const RunContext context;
  std::thread canceller([&] { context.cancel(); });
  const auto delivery = source->next(3600.0, context);
  canceller.join();
  ASSERT_FALSE(delivery);
  EXPECT_EQ(delivery.error().code, ErrorCode::kCancelled);
  // It is not broken by that.
  EXPECT_EQ(source->next(0.01, {})->kind, Kind::kNothing);
}

TEST(FrameSource, ALostDeviceIsAnErrorAfterTheFramesThatCame) {
  const auto source = opened(kVirtual + "&fault=lost@100ms&prepared=1");
  const Taken taken = run(*source);
  EXPECT_EQ(taken.frames.size(), 3u);
  ASSERT_TRUE(taken.error);
  EXPECT_EQ(taken.error->code, ErrorCode::kDeviceLost);
  EXPECT_EQ(source->next(0.0, {}).error().code, ErrorCode::kDeviceLost);
  source->stop();
  EXPECT_EQ(source->start().error().code, ErrorCode::kDeviceLost);
}

TEST(FrameSource, WrongFramesAreRefusedAndTooManyOfThemAreAnError) {
  const auto few = opened(kVirtual +
                          "&frames=9&fault=size@100ms,backwards@200ms,gap@230ms&"
                          "prepared=1");
  const Taken taken = run(*few);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_EQ(taken.frames[i].info.status == FrameStatus::kDropped, i == 3 || i == 6 || i == 7)
        << i;
  EXPECT_EQ(few->statistics().refused, 2u);
  EXPECT_EQ(few->statistics().dropped_by_sensor, 1u);

  const auto many = opened(kVirtual + "&fault=size@100ms+100s&prepared=1");
  const Taken failed = run(*many);
  ASSERT_TRUE(failed.error);
  EXPECT_EQ(failed.error->code, ErrorCode::kFormat);
  EXPECT_NE(failed.error->message.find("1 x 1"), std::string::npos);
  EXPECT_EQ(failed.frames.size(), 3u + FrameSource::kMaxRefused - 1u);
}

TEST(FrameSource, OpeningFailsByTypeAndInOneSentence) {
  const std::vector<std::pair<std::string, ErrorCode>> cases{
      {"doll", ErrorCode::kInvalidOption},
      {"telepathy:", ErrorCode::kNotFound},
      {"virtual:", ErrorCode::kInvalidOption},
      {"virtual:elephant", ErrorCode::kNotFound},
      {"virtual:cylinder?sensor=crystal-ball", ErrorCode::kNotFound},
      {"virtual:cylinder?sead=1", ErrorCode::kInvalidOption},
      {"virtual:cylinder?seed=-1", ErrorCode::kInvalidOption},
      {"virtual:cylinder?queue=0", ErrorCode::kInvalidOption},
      {"virtual:cylinder?fault=flood", ErrorCode::kInvalidOption},
      {"virtual:cylinder?fault=lost", ErrorCode::kInvalidOption},
      {"virtual:cylinder?fault=stall@2", ErrorCode::kInvalidOption},
      {"virtual:cylinder?fault=missing", ErrorCode::kNotFound},
      {"virtual:cylinder?fault=busy", ErrorCode::kDeviceBusy},
      {"virtual:cylinder?fault=denied", ErrorCode::kNoPermission},
      {"virtual:./nothing.stl", ErrorCode::kNotFound},
      {"replay:", ErrorCode::kInvalidOption},
      {"replay:nowhere", ErrorCode::kNotFound},
      {"replay:nowhere?speed=0", ErrorCode::kInvalidOption}};
  for (const auto& [uri, code] : cases) {
    const auto source = open_source(uri, {});
    ASSERT_FALSE(source) << uri;
    EXPECT_EQ(source.error().code, code) << uri << ": " << source.error().text();
    EXPECT_EQ(source.error().text().find('\n'), std::string::npos);
  }
}

TEST(FrameSource, ReplayGivesTheFramesOfTheRecordingAndMarksTheLostOnes) {
  const TempFolder folder;
  const auto source = opened("replay:" + small_recording(folder).string() + "?speed=max");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().frame_count, 4u);
  EXPECT_NEAR(source->info().fps, 30.0, 1e-9);
  const Taken taken = run(*source);
  ASSERT_EQ(taken.frames.size(), 4u);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Frame& frame = taken.frames[i];
    EXPECT_EQ(frame.info.status == FrameStatus::kDropped, i == 2);
    EXPECT_NEAR(frame.info.time_s, i / 30.0, 1e-12);
    EXPECT_NEAR(frame.info.angle_rad.value(), i * 0.1, 1e-9);
    if (i != 2) {
      EXPECT_EQ(frame.depth.pixels, testing::depth_frame(i).depth.pixels);
    }
  }
}

TEST(FrameSource, ReplayCanGoRoundWithTimeAndTableGoingOn) {
  const TempFolder folder;
  const auto source = opened("replay:" + small_recording(folder).string() + "?speed=1000&loop=1");
  EXPECT_TRUE(source->info().live);
  ASSERT_TRUE(source->start());
  for (std::uint32_t i = 0; i < 10; ++i) {
    const FrameInfo info = source->next(20.0, {})->frame.info;
    EXPECT_NEAR(info.time_s, i / 30.0, 1e-9);
    EXPECT_NEAR(*info.angle_rad, i * 0.1, 1e-9);
  }
}

}  // namespace
}  // namespace turnscan
