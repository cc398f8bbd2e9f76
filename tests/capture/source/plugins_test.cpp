#include <gtest/gtest.h>

#include <turnscan/capture/source/plugins.hpp>

#include "tests/capture/taking.hpp"

namespace turnscan {
namespace {

using testing::opened;
using testing::run;
using testing::Taken;
using testing::Variable;

/// The tests' own drivers are the only ones.
struct Plugins : ::testing::Test {
  const Variable folders{"TURNSCAN_PLUGINS", TURNSCAN_TEST_PLUGINS};
};

TEST_F(Plugins, ADriverDescribesItsSensor) {
  const auto source = opened("counter:counting");
  ASSERT_TRUE(source);
  const SourceInfo& info = source->info();
  EXPECT_EQ(info.driver, "counter");
  EXPECT_EQ(info.identities, std::vector<std::string>{"counter-counter-A-1"});
  EXPECT_EQ(info.header.sensors[0].model, "counter");
  EXPECT_EQ(info.header.sensors[0].intrinsics.width, 4);
  EXPECT_EQ(info.header.sensors[0].depth_unit_m, 1e-3);
  EXPECT_EQ(info.frame_count, 6u);
  EXPECT_FALSE(info.live);
}

TEST_F(Plugins, FramesComeAsTheyAreAndNoPixelIsOutsideACrop) {
  const auto source = opened("counter:counting");
  const Taken taken = run(*source);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Frame& frame = taken.frames[i];
    EXPECT_EQ(frame.depth.pixels[0], kNoReturn);
    EXPECT_EQ(frame.depth.pixels[1], kNoReturn);
    EXPECT_EQ(frame.depth.pixels[2], 1001 + i);
    EXPECT_EQ(frame.color.at(3, 2).g, i + 1);
    EXPECT_NEAR(frame.info.time_s, double(i + 1) / 100.0, 1e-12);
  }
}

TEST_F(Plugins, DepthInMetresIsRoundedToTheRecordingsStep) {
  const auto source = opened("counter:counting?metres=1");
  EXPECT_EQ(source->info().header.sensors[0].depth_unit_m, 1e-4);
  const Taken taken = run(*source);
  ASSERT_EQ(taken.frames.size(), 6u);
  const auto& pixels = taken.frames[0].depth.pixels;
  EXPECT_EQ(pixels[0], kNoReturn);  // negative
  EXPECT_EQ(pixels[1], kNoReturn);  // beyond what 16 bits hold
  EXPECT_EQ(pixels[2], kNoReturn);  // not a number
  EXPECT_EQ(pixels[3], 5000);
}

TEST_F(Plugins, AGapInTheSensorsCountIsALostFrame) {
  const auto source = opened("counter:gaps");
  const Taken taken = run(*source);
  ASSERT_EQ(taken.frames.size(), 11u);
  for (std::uint32_t i = 0; i < 11; ++i) {
    EXPECT_EQ(taken.frames[i].info.index, i);
    EXPECT_EQ(taken.frames[i].info.status == FrameStatus::kDropped, i % 2 == 1);
  }
  EXPECT_EQ(source->statistics().dropped_by_sensor, 5u);
}

TEST_F(Plugins, WhatTheDriverSaysIsTheError) {
  const std::vector<std::tuple<std::string, ErrorCode, std::string>> cases{
      {"counter:busy", ErrorCode::kDeviceBusy, "counter: it is in use"},
      {"counter:denied", ErrorCode::kNoPermission, "counter: not for you"},
      {"counter:none", ErrorCode::kNotFound, "counter: nothing is here"},
      {"counter:mute", ErrorCode::kLibrary, "counter: the driver failed without saying why"},
      {"counter:blind", ErrorCode::kLibrary, "no usable camera"},
      {"counter:counting?meters=1", ErrorCode::kInvalidOption, "it has queue, metres"},
      {"outdated:", ErrorCode::kLibrary, "version 999"},
      {"nameless:", ErrorCode::kLibrary, "no function turnscan_plugin_entry"},
      {"misnamed:", ErrorCode::kLibrary, "calls itself another"},
      {"needy:", ErrorCode::kLibrary, "its library libturnscan_absent.so is not installed"},
      {"nothing:", ErrorCode::kNotFound, "use one of virtual:, replay:, counter:"}};
  for (const auto& [uri, code, text] : cases) {
    const auto source = open_source(uri, {});
    ASSERT_FALSE(source) << uri;
    EXPECT_EQ(source.error().code, code) << source.error().text();
    EXPECT_NE(source.error().message.find(text), std::string::npos) << source.error().text();
    EXPECT_EQ(source.error().message.find('\n'), std::string::npos);
  }
}

TEST_F(Plugins, AnUnpluggedDeviceIsLostAfterItsFrames) {
  const auto source = opened("counter:unplugged");
  const Taken taken = run(*source);
  EXPECT_EQ(taken.frames.size(), 3u);
  ASSERT_TRUE(taken.error);
  EXPECT_EQ(taken.error->code, ErrorCode::kDeviceLost);
  EXPECT_EQ(taken.error->message, "counter: it went away; check the cable");
}

TEST_F(Plugins, AreListedWithTheirDevicesOrTheirFault) {
  const auto drivers = list_drivers();
  ASSERT_EQ(drivers.size(), 5u);
  EXPECT_EQ(drivers[0].name, "counter");
  EXPECT_EQ(drivers[0].error, "");
  ASSERT_EQ(drivers[0].devices.size(), 2u);
  EXPECT_EQ(drivers[0].devices[1].uri, "counter:gaps");
  EXPECT_EQ(drivers[0].parameters.at(0).name, "metres");
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_NE(drivers[i].error, "");
    EXPECT_TRUE(drivers[i].devices.empty());
  }
}

TEST_F(Plugins, OnlyTheFoldersOfTheVariableAreLookedAt) {
  EXPECT_EQ(plugin_folders(), std::vector<std::filesystem::path>{TURNSCAN_TEST_PLUGINS});
  const Variable two("TURNSCAN_PLUGINS", "/nowhere::" TURNSCAN_TEST_PLUGINS);
  EXPECT_EQ(plugin_folders().size(), 2u);
  EXPECT_TRUE(open_source("counter:", {}));
}

}  // namespace
}  // namespace turnscan
