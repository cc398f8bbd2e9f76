#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/workflow/calibration/disturbed_motion.hpp>

#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan::workflow {
namespace {

constexpr int kFrames = 72;
constexpr std::size_t kMovedAt = 24;

/// The letter A on its platter, displaced by x_m.
testing::Rig turning_rig(double x_m) {
  testing::RigOptions o = testing::near_rig(kFrames, 1.4);
  o.objects = {place(*builtin_object("letter-a"), x_m, 0.0, 0.6)};
  return testing::Rig(o);
}

/// The object moves before a frame.
SequenceView moving(const testing::Rig& before, const testing::Rig& after, std::size_t at) {
  SequenceView out(before);
  out.set_map([&after, at](Frame frame, std::size_t i) -> Result<Frame> {
    if (i < at) return frame;
    return after.read(i);
  });
  return out;
}

double line_error(const Calibration& found, const TurntableInfo& truth) {
  const Vec3d middle = truth.center_m + 0.06 * truth.axis;
  const Vec3d off = found.table.center_m - middle;
  return off.cross(found.table.axis.normalized()).norm();
}

TEST(SettleDisturbances, FindsTheAxisFromTheLongestTimeInWhichNothingMoved) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig before = turning_rig(0.0), after = turning_rig(0.008);
  const SequenceView recording = moving(before, after, kMovedAt);
  auto found = calibrate_from_motion(recording, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const double misled = line_error(*found, before.truth());
  EXPECT_GT(misled, 0.001);
  const auto placement = settle_disturbances(recording, {}, {}, *found, nullptr, {});
  ASSERT_TRUE(placement) << placement.error().text();
  ASSERT_FALSE(placement->disturbances.empty());
  EXPECT_EQ(placement->disturbances.front().kind, DisturbanceKind::kObject);
  EXPECT_LT(line_error(*found, before.truth()), 0.0004);
  EXPECT_LT(line_error(*found, before.truth()), 3.5 * found->center_sigma_m);
  ASSERT_EQ(found->angles_rad.size(), std::size_t(kFrames));
  for (std::size_t i = 0; i < found->angles_rad.size(); ++i)
    EXPECT_NEAR(found->angles_rad[i], before.true_angle(i), 0.5 * kRadiansPerDegree) << i;
}

TEST(SettleDisturbances, NamesTheSlipThatTheAnglesFollow) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = testing::near_rig(kFrames, 1.4);
  o.objects = {*builtin_object("letter-a")};
  const double at = (kMovedAt - 0.5) / o.fps;
  o.angle = [even = o.angle, at](double t) {
    return even(t) + (t < at ? 0.0 : 12.0 * kRadiansPerDegree);
  };
  const testing::Rig recording(o);
  auto found = calibrate_from_motion(recording, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const auto placement = settle_disturbances(recording, {}, {}, *found, nullptr, {});
  ASSERT_TRUE(placement) << placement.error().text();
  ASSERT_EQ(placement->disturbances.size(), 1u);
  const Disturbance& slip = placement->disturbances.front();
  EXPECT_EQ(slip.kind, DisturbanceKind::kSlip);
  EXPECT_EQ(slip.first_frame, kMovedAt);
  EXPECT_TRUE(slip.text.starts_with("the table slipped ahead by 12")) << slip.text;
}

TEST(SettleDisturbances, WidensTheDeviationsWhereTooLittleRemains) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig before = turning_rig(0.0), after = turning_rig(0.008);
  const SequenceView all = moving(before, after, 20);
  std::vector<std::size_t> half(34);
  for (std::size_t i = 0; i < half.size(); ++i) half[i] = i;
  SequenceView recording(all, half);
  auto found = calibrate_from_motion(recording, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const double stated_m = found->center_sigma_m;
  const auto placement = settle_disturbances(recording, {}, {}, *found, nullptr, {});
  ASSERT_TRUE(placement) << placement.error().text();
  ASSERT_FALSE(placement->disturbances.empty());
  EXPECT_GT(found->center_sigma_m, stated_m + 0.001);
  EXPECT_LT(line_error(*found, before.truth()), 3.5 * found->center_sigma_m);
}

TEST(SettleDisturbances, LeavesTheCalibrationOfAnUndisturbedRecordingAlone) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig = turning_rig(0.0);
  auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const Calibration before = *found;
  const auto placement = settle_disturbances(rig, {}, {}, *found, nullptr, {});
  ASSERT_TRUE(placement) << placement.error().text();
  EXPECT_TRUE(placement->disturbances.empty());
  EXPECT_EQ(found->table.center_m, before.table.center_m);
  EXPECT_EQ(found->center_sigma_m, before.center_sigma_m);
}

}  // namespace
}  // namespace turnscan::workflow
