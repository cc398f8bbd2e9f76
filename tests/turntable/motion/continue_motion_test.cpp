#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/motion/continue_motion.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

constexpr std::size_t kFrames = 40, kFirst = 34;

/// 1.05 turns of the doll that slow down a little at the end, and may slip; a calibration of the
/// first frames that is right but for 1 degree by which all angles are off, which nobody can see.
struct Scan {
  explicit Scan(double slip_deg = 0.0) {
    testing::RigOptions o;
    o.shrink = 2;
    o.noise_m = 0.001;
    o.distance_m = 0.6;
    o.frames = int(kFrames);
    o.fps = double(kFrames) / 30.0;
    static const TriangleMesh doll = *builtin_object("doll");
    o.objects = {doll};
    const double speed = 1.05 * 2.0 * std::numbers::pi / 30.0;
    o.angle = [speed, slip_deg](double t) {
      const double slip = t > 27.5 ? slip_deg / kDegreesPerRadian : 0.0;
      return speed * (t < 25.0 ? t : t - 0.02 * (t - 25.0)) - slip;
    };
    const testing::Rig rig(o);
    sequence.header_value = rig.header();
    for (std::size_t i = 0; i < kFrames; ++i) {
      sequence.add(*rig.read(i));
      truth.push_back(rig.true_angle(i));
    }
    first.table = rig.truth();
    for (std::size_t i = 0; i < kFirst; ++i) {
      first.angles_rad.push_back(truth[i] + 1.0 / kDegreesPerRadian);
      first.angle_sigma_rad.push_back(0.0);
    }
  }
  testing::MemorySequence sequence;
  std::vector<double> truth;
  Calibration first;
};

const Scan& scan() {
  static const Scan one;
  return one;
}

TEST(ContinueMotion, LaterFramesGetAnglesByWhichTheyFitTheFirst) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const auto found = continue_motion(scan().sequence, scan().first, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const Calibration& c = found->calibration;
  ASSERT_EQ(c.angles_rad.size(), kFrames);
  ASSERT_EQ(c.angle_sigma_rad.size(), kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double error_deg = (c.angles_rad[i] - scan().truth[i]) * kDegreesPerRadian - 1.0;
    EXPECT_LT(std::abs(error_deg), i < kFirst ? 1e-9 : 0.4) << i;
  }
  EXPECT_EQ(c.table.axis, scan().first.table.axis);
  EXPECT_EQ(c.table.center_m, scan().first.table.center_m);
  EXPECT_NEAR(found->noise_m, 0.001, 0.0003);
}

TEST(ContinueMotion, ASlipAfterTheFirstFramesIsFollowed) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const Scan slipped(2.0);
  const auto found = continue_motion(slipped.sequence, slipped.first, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  for (std::size_t i = 38; i < kFrames; ++i) {
    const double error_deg =
        (found->calibration.angles_rad[i] - slipped.truth[i]) * kDegreesPerRadian - 1.0;
    EXPECT_LT(std::abs(error_deg), 0.6) << i;
  }
}

TEST(ContinueMotion, DroppedFramesLieBetweenTheirNeighbours) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::MemorySequence gaps = scan().sequence;
  gaps.infos[36].status = FrameStatus::kDropped;
  const auto found = continue_motion(gaps, scan().first, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const auto& angles = found->calibration.angles_rad;
  EXPECT_NEAR(angles[36], 0.5 * (angles[35] + angles[37]), 0.5 / kDegreesPerRadian);
}

TEST(ContinueMotion, WithoutAShapeTheLawOfTheMotorGoesOn) {
  Calibration first = scan().first;
  first.undetermined = {"angles"};
  const auto found = continue_motion(scan().sequence, first, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const auto& angles = found->calibration.angles_rad;
  EXPECT_NEAR(angles[39] - angles[38], angles[33] - angles[32], 1e-3);
}

TEST(ContinueMotion, GivesTheSameAnglesForAnyNumberOfThreads) {
  const auto many = continue_motion(scan().sequence, scan().first, {}, {});
  set_thread_count(1);
  const auto one = continue_motion(scan().sequence, scan().first, {}, {});
  set_thread_count(0);
  ASSERT_TRUE(many && one);
  EXPECT_EQ(many->calibration.angles_rad, one->calibration.angles_rad);
}

TEST(ContinueMotion, RefusesWhatItCannotContinue) {
  Calibration first = scan().first;
  first.angles_rad.resize(2);
  EXPECT_EQ(continue_motion(scan().sequence, first, {}, {}).error().code,
            ErrorCode::kInvalidOption);
  first.angles_rad.assign(kFrames, 0.0);
  EXPECT_EQ(continue_motion(scan().sequence, first, {}, {}).error().code,
            ErrorCode::kInvalidOption);
  testing::MemorySequence timeless = scan().sequence;
  for (FrameInfo& info : timeless.infos) info.time_s = std::nan("");
  EXPECT_EQ(continue_motion(timeless, scan().first, {}, {}).error().code,
            ErrorCode::kInvalidOption);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(continue_motion(scan().sequence, scan().first, {}, context).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
