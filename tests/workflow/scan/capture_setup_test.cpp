#include <gtest/gtest.h>

#include <turnscan/workflow/scan/capture_setup.hpp>

namespace turnscan {
namespace {

TEST(CaptureSetup, SettingsNameEveryDevice) {
  SourceInfo source;
  source.settings["exposure"] = "auto";
  source.identities = {"kinect2:1", "kinect2:2"};
  const CaptureSettings settings = settings_of(source);
  EXPECT_EQ(
      settings,
      (CaptureSettings{{"exposure", "auto"}, {"device", "kinect2:1"}, {"device_1", "kinect2:2"}}));
}

TEST(CaptureSetup, AMotorHasASpeedUnlessOneIsGiven) {
  SequenceHeader header;
  header.turntable.emplace();
  CaptureOptions options;
  settle_speed(false, options, header);
  EXPECT_FALSE(options.speed_rad_s || header.turntable->speed_rad_s);
  settle_speed(true, options, header);
  EXPECT_EQ(options.speed_rad_s, kMotorSpeed_rad_s);
  EXPECT_EQ(header.turntable->speed_rad_s, kMotorSpeed_rad_s);
  options.speed_rad_s = -0.5;
  settle_speed(true, options, header);
  EXPECT_EQ(header.turntable->speed_rad_s, -0.5);
}

TEST(CaptureSetup, OpensAVirtualDeviceAndKnowsItsPlace) {
  CaptureSetup setup;
  setup.devices = {"virtual:cylinder"};
  const auto source = setup.open(RunContext());
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_EQ(setup.header.sensors.size(), 1u);
  EXPECT_FALSE(setup.header.source.empty());
  EXPECT_EQ(*setup.open_motor(RunContext()) ? 1 : 0, 0) << "no port is given";
}

TEST(CaptureSetup, AnUnknownDeviceFails) {
  CaptureSetup setup;
  setup.devices = {"nothing:at-all"};
  EXPECT_FALSE(setup.open(RunContext()));
}

}  // namespace
}  // namespace turnscan
