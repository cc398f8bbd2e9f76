#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/recording/filled_depth.hpp>

namespace turnscan {
namespace {

constexpr int kColumns = 160, kRows = 60;
constexpr double kFocal = 200.0, kBaseline = 0.05, kNear_m = 0.4,
                 kFar_m = 1.0;  // a strip of 15 pixels

enum class Fill { kNone, kFar, kNear, kRamp };

/// A board that is farther right in each frame, before a wall. The other eye is on the right, so
/// that it does not see what lies just left of the board.
class Boards : public FrameSequence {
 public:
  explicit Boards(Fill fill, bool wall = true) : fill_(fill), wall_(wall) {
    header_.sensors.resize(1);
    CameraIntrinsics& camera = header_.sensors[0].intrinsics;
    camera.width = kColumns;
    camera.height = kRows;
    camera.fx = camera.fy = kFocal;
    camera.cx = kColumns / 2.0;
    camera.cy = kRows / 2.0;
    infos_.resize(20);
    for (std::size_t i = 0; i < infos_.size(); ++i) infos_[i].index = std::uint32_t(i);
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }
  std::vector<FrameInfo>& infos() { return infos_; }

  Result<Frame> read(std::size_t position) const override {
    Frame frame;
    frame.info = infos_[position];
    frame.depth = DepthImage(kColumns, kRows);
    for (int y = 0; y < kRows; ++y)
      for (int x = 0; x < kColumns; ++x) {
        const double z = depth(x, 50 + int(position));
        const double noise = 2.0 * standard_normal(hash_key(3, position, y * kColumns + x));
        if (z > 0.0) frame.depth.at(x, y) = std::uint16_t(1e4 * z + noise);
      }
    return frame;
  }

 private:
  /// Metres; 0 is no return.
  double depth(int x, int left) const {
    if (x >= left && x < left + 40) return kNear_m;
    const double far = wall_ ? kFar_m : 0.0;
    const int strip = int(kFocal * kBaseline * (1.0 / kNear_m - 1.0 / kFar_m));
    if (x < left - strip || x >= left) return far;
    const double part = double(x - left + strip) / strip;
    switch (fill_) {
      case Fill::kFar:
        return far;
      case Fill::kNear:
        return kNear_m;
      case Fill::kRamp:
        return kFar_m + part * (kNear_m - kFar_m);
      case Fill::kNone:
        break;
    }
    return 0.0;
  }

  SequenceHeader header_;
  std::vector<FrameInfo> infos_;
  Fill fill_;
  bool wall_;
};

std::optional<double> share_of(const FrameSequence& sequence) {
  const auto result = filled_share(sequence, 0, kBaseline, RunContext());
  EXPECT_TRUE(result);
  return result ? *result : std::nullopt;
}

TEST(FilledDepth, MeasuredDepthHasGapsWhereOneEyeSeesNothing) {
  const auto share = share_of(Boards(Fill::kNone));
  ASSERT_TRUE(share);
  EXPECT_LT(*share, 0.02);
}

TEST(FilledDepth, IsToldHoweverItWasFilled) {
  for (const Fill fill : {Fill::kFar, Fill::kNear, Fill::kRamp}) {
    const auto share = share_of(Boards(fill));
    ASSERT_TRUE(share) << int(fill);
    EXPECT_GT(*share, 0.95) << int(fill);
  }
}

TEST(FilledDepth, TellsNothingWhereTooLittleTells) {
  EXPECT_FALSE(share_of(Boards(Fill::kNone, false))) << "nothing behind the board";
  Boards dropped(Fill::kFar);
  for (FrameInfo& info : dropped.infos()) info.status = FrameStatus::kDropped;
  EXPECT_FALSE(share_of(dropped));
  const auto no_baseline = filled_share(Boards(Fill::kFar), 0, 0.0, RunContext());
  ASSERT_TRUE(no_baseline);
  EXPECT_FALSE(*no_baseline);
}

TEST(FilledDepth, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  const Boards boards(Fill::kRamp);
  const auto all = share_of(boards);
  set_thread_count(1);
  EXPECT_EQ(share_of(boards), all);
  set_thread_count(0);
  const RunContext context;
  context.cancel();
  const auto cancelled = filled_share(boards, 0, kBaseline, context);
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
