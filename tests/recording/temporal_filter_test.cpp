#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/recording/summary.hpp>
#include <turnscan/recording/temporal_filter.hpp>

namespace turnscan {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 48;

/// A wall at 0.8 m, before which something turns in the middle third: frames with noise of sigma
/// steps, smoothed over time with a share of the new frame as a device does.
class SmoothedFrames : public FrameSequence {
 public:
  SmoothedFrames(std::size_t count, double share, double sigma, bool wall = true)
      : share_(share), sigma_(sigma), wall_(wall) {
    header_.sensors.resize(1);
    CameraIntrinsics& camera = header_.sensors[0].intrinsics;
    camera.width = kWidth;
    camera.height = kHeight;
    camera.fx = camera.fy = 60.0;
    camera.cx = kWidth / 2.0;
    camera.cy = kHeight / 2.0;
    for (std::size_t i = 0; i < count; ++i) {
      infos_.emplace_back();
      infos_.back().index = std::uint32_t(i);
      infos_.back().time_s = double(i) / 30.0;
    }
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  std::vector<FrameInfo>& infos() { return infos_; }

  Result<Frame> read(std::size_t position) const override {
    Frame frame;
    frame.info = infos_[position];
    frame.depth = DepthImage(kWidth, kHeight);
    for (std::size_t p = 0; p < frame.depth.pixels.size(); ++p) {
      const double value = smoothed(position, p);
      frame.depth.pixels[p] = value > 0.0 ? std::uint16_t(value + 0.5) : kNoReturn;
    }
    return frame;
  }

 private:
  /// The last 24 frames are enough: what is older has faded.
  double smoothed(std::size_t position, std::size_t pixel) const {
    const std::size_t first = position >= 24 && share_ < 1.0 ? position - 24 : 0;
    double value = raw(share_ < 1.0 ? first : position, pixel);
    for (std::size_t i = first + 1; share_ < 1.0 && i <= position; ++i)
      value += share_ * (raw(i, pixel) - value);
    return value;
  }

  double raw(std::size_t frame, std::size_t pixel) const {
    const double noise = sigma_ * standard_normal(hash_key(7, frame, pixel));
    const int column = int(pixel) % kWidth;
    if (column < kWidth / 3 || column >= 2 * kWidth / 3) return wall_ ? 8000.0 + noise : 0.0;
    return 6000.0 + 300.0 * std::sin(double(frame) / 20.0 + column / 9.0) + noise;
  }

  SequenceHeader header_;
  std::vector<FrameInfo> infos_;
  double share_, sigma_;
  bool wall_;
};

std::optional<double> correlation_of(const FrameSequence& sequence) {
  const auto result = temporal_correlation(sequence, 0, RunContext());
  EXPECT_TRUE(result);
  return result ? *result : std::nullopt;
}

TEST(TemporalFilter, FindsTheShareOfARecursiveFilter) {
  for (const double share : {0.7, 0.4, 0.2}) {
    const auto r = correlation_of(SmoothedFrames(300, share, 20.0));
    ASSERT_TRUE(r) << share;
    EXPECT_NEAR(*r, 1.0 - share, 0.06) << share;
  }
}

TEST(TemporalFilter, IndependentFramesHaveNone) {
  for (const double sigma : {1.0, 20.0}) {
    const auto r = correlation_of(SmoothedFrames(300, 1.0, sigma));
    ASSERT_TRUE(r);
    EXPECT_LT(*r, 0.06);
  }
}

TEST(TemporalFilter, TellsNothingWhereTooLittleTells) {
  EXPECT_FALSE(correlation_of(SmoothedFrames(200, 0.4, 20.0)));        // too few frames
  EXPECT_FALSE(correlation_of(SmoothedFrames(300, 0.4, 0.1)));         // nothing but rounding
  EXPECT_FALSE(correlation_of(SmoothedFrames(300, 1.0, 5.0, false)));  // nothing stands still
  SmoothedFrames moved(300, 0.4, 20.0);
  for (FrameInfo& info : moved.infos()) info.T_table_sensor = Pose::Identity();
  EXPECT_FALSE(correlation_of(moved));
}

TEST(TemporalFilter, IsSaidBySummariesOnlyWhereItIsThere) {
  const auto smoothed = summarize(SmoothedFrames(300, 0.4, 20.0), RunContext());
  ASSERT_TRUE(smoothed);
  EXPECT_THAT(smoothed->notes, Contains(HasSubstr("smooths depth over time")));
  const auto plain = summarize(SmoothedFrames(300, 1.0, 20.0), RunContext());
  ASSERT_TRUE(plain);
  EXPECT_THAT(plain->notes, ::testing::Not(Contains(HasSubstr("smooths depth over time"))));
}

TEST(TemporalFilter, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  const SmoothedFrames frames(300, 0.5, 20.0);
  set_thread_count(1);
  const auto one = correlation_of(frames);
  set_thread_count(0);
  EXPECT_EQ(one, correlation_of(frames));
  const RunContext context;
  context.cancel();
  const auto cancelled = temporal_correlation(frames, 0, context);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
