#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/taken_frames.hpp>
#include <turnscan/capture/source/clock_offset.hpp>
#include <turnscan/turntable/table_frame.hpp>

#include "tests/capture/taking.hpp"

namespace turnscan {
namespace {

using testing::Taken;

const std::string kOne = "virtual:letter-a?sensor=kinect-v2&noise=gaussian:1mm&elevation=17deg";
const std::string kTwo =
    "virtual:letter-a?sensor=kinect-v2&noise=gaussian:1mm&elevation=45deg&seed=2&serial=1";

std::unique_ptr<FrameSource> opened(const std::vector<std::string>& uris) {
  auto source = open_sources(uris, {});
  EXPECT_TRUE(source) << (source ? "" : source.error().text());
  return source ? std::move(*source) : nullptr;
}

TEST(ClockOffset, IsThatOfTheFastestFrame) {
  source::ClockOffset clock;
  EXPECT_EQ(clock.to_host_s(), 0.0);
  clock.add(1.0, 11.5);
  clock.add(2.0, 12.1);
  clock.add(3.0, 13.9);
  clock.add(std::nan(""), 14.0);
  EXPECT_DOUBLE_EQ(clock.to_host_s(), 10.1);
  EXPECT_EQ(clock.count(), 3u);
}

TEST(SeveralSources, AreInterleavedByTimeWhateverTheirClocksSay) {
  const auto source = opened({kOne + "&frames=30&turns=0.1&prepared=1",
                              kTwo + "&frames=45&turns=0.15&fps=45&clock=12.5s&prepared=1",
                              kOne + "&serial=7&frames=30&clock=-3s&prepared=1"});
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().header.sensors.size(), 3u);
  EXPECT_EQ(source->info().frame_count, 105u);
  const Taken taken = testing::run(*source);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 105u);
  std::array<std::size_t, 3> counts{};
  double last_s = -1.0;
  for (std::uint32_t i = 0; i < 105; ++i) {
    const FrameInfo& frame = taken.frames[i].info;
    EXPECT_EQ(frame.index, i);
    EXPECT_GE(frame.time_s, last_s);
    last_s = frame.time_s;
    // Each at its true time, to within the differences of the ways that frames go.
    const double period_s = frame.sensor == 1 ? 1.0 / 45.0 : 1.0 / 30.0;
    EXPECT_NEAR(frame.time_s, double(counts[frame.sensor]++) * period_s, 0.003);
  }
  EXPECT_EQ(counts, (std::array<std::size_t, 3>{30, 45, 30}));
  EXPECT_EQ(source->statistics().delivered, 105u);
}

TEST(SeveralSources, StandBeforeOneTableInOneHeadingOrTheirPlacesAreNotKnown) {
  const auto source =
      opened({kOne + "&frames=1&calibration=true&azimuth=20deg",
              kTwo + "&frames=1&calibration=true&azimuth=140deg", kOne + "&frames=1&serial=7"});
  ASSERT_TRUE(source);
  const auto& header = source->info().header;
  // Around the table, counter-clockwise seen from above, from the first one's side of -Z on.
  const auto azimuth = [&](std::size_t k) {
    const Vec3d p = sensor_pose(header, k).value().translation();
    return std::atan2(-p.x(), -p.z());
  };
  EXPECT_NEAR(azimuth(0), 0.0, 1e-9);
  EXPECT_NEAR(azimuth(1), 2.0 * std::numbers::pi / 3.0, 1e-9);
  EXPECT_FALSE(sensor_pose(header, 2));
}

TEST(SeveralSources, OneThatFallsSilentDoesNotHoldUpTheOthers) {
  const auto source =
      opened({kOne + "&realtime=1&frames=70&fps=100&turns=1&prepared=1",
              kTwo + "&realtime=1&frames=70&fps=100&turns=1&prepared=1&fault=stall@0.3s+3600s"});
  ASSERT_TRUE(source->start());
  std::array<std::size_t, 2> counts{};
  for (;;) {
    const auto delivery = source->next(1.0, {});
    ASSERT_TRUE(delivery);
    if (delivery->kind != Delivery::Kind::kFrame) break;
    ++counts[delivery->frame.info.sensor];
  }
  EXPECT_EQ(counts[0], 70u);
  EXPECT_LE(counts[1], 31u);
}

TEST(SeveralSources, AFailureOfOneIsAFailureOfAll) {
  const auto source = opened({kOne + "&prepared=1", kTwo + "&prepared=1&fault=lost@1s"});
  const Taken taken = testing::run(*source);
  ASSERT_TRUE(taken.error);
  EXPECT_EQ(taken.error->code, ErrorCode::kDeviceLost);
  EXPECT_GE(taken.frames.size(), 58u);
}

TEST(SeveralSources, RefuseWhatDoesNotGoTogether) {
  EXPECT_EQ(open_sources({}, {}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(open_sources({kOne, kOne}, {}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(open_sources({kOne, kTwo + "&realtime=1"}, {}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(open_sources({kOne, kTwo + "&fault=busy"}, {}).error().code, ErrorCode::kDeviceBusy);
  EXPECT_TRUE(open_sources({kOne}, {}));
}

}  // namespace
}  // namespace turnscan
