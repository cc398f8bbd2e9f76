#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <turnscan/turntable/rotation.hpp>

#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

constexpr int kFrames = 60;
constexpr double kTurns = 1.1;

testing::RigOptions rig_options(const std::string& object, double x_m, std::uint64_t seed) {
  testing::RigOptions o = testing::near_rig(kFrames, kTurns);
  o.seed = seed;
  o.objects = {place(*builtin_object(object), x_m, 0.0, 0.6)};
  return o;
}

testing::Rig turning_rig(const std::string& object, double x_m = 0.0, std::uint64_t seed = 1) {
  return testing::Rig(rig_options(object, x_m, seed));
}

/// The frames with the true turntable, and a speed that is right but for a factor.
SequenceView calibrated(const testing::Rig& rig, double speed_factor = 1.0) {
  SequenceView out(rig);
  SequenceHeader header = rig.header();
  header.turntable = rig.truth();
  header.turntable->speed_rad_s = speed_factor * kTurns * kTurn / kFrames;
  out.set_header(std::move(header));
  return out;
}

/// From frame `at` on the frames of another rig.
SequenceView changing(const testing::Rig& before, const testing::Rig& after, std::size_t at) {
  SequenceView out = calibrated(before);
  out.set_map([&after, at](Frame frame, std::size_t i) -> Result<Frame> {
    if (i < at) return frame;
    return after.read(i);
  });
  return out;
}

std::vector<Pose> poses_of(const FrameSequence& sequence) {
  return frame_poses(sequence.header(), sequence.frames(), {})->T_table_sensor;
}

Placement found_in(const FrameSequence& sequence) {
  auto found = find_disturbances(sequence, poses_of(sequence), {});
  EXPECT_TRUE(found && *found) << (found ? "nothing seen" : found.error().text());
  return found && *found ? **found : Placement();
}

/// How far frames put a point beside the axis from where other poses put it.
double largest_error(const std::vector<Pose>& poses, const std::vector<Pose>& truth) {
  double out = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3d p(0.05, 0.08, 0.02);
    out = std::max(out, (poses[i] * (truth[i].inverse() * p) - p).norm());
  }
  return out;
}

TEST(FindDisturbances, SaysNothingOfAnUndisturbedRecording) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const std::string object : {"letter-a", "cylinder"}) {
    for (const std::uint64_t seed : {1, 2}) {
      const testing::Rig rig = turning_rig(object, 0.0, seed);
      const Placement found = found_in(calibrated(rig));
      EXPECT_TRUE(found.disturbances.empty()) << object << ": " << found.disturbances[0].text;
      EXPECT_TRUE(found.left_out.empty());
    }
  }
}

TEST(FindDisturbances, LooksPastThingsBesideAPlatterThatNobodySees) {
  testing::RigOptions o = rig_options("letter-a", 0.0, 1);
  o.platter = false;
  o.clutter = 4;
  const testing::Rig rig(o);
  SequenceView sequence = calibrated(rig);
  SequenceHeader header = sequence.header();
  header.turntable->radius_m.reset();
  sequence.set_header(header);
  const Placement found = found_in(sequence);
  EXPECT_TRUE(found.disturbances.empty()) << found.disturbances[0].text;
}

TEST(FindDisturbances, MovesFramesBackAfterTheObjectMoved) {
  const testing::Rig before = turning_rig("letter-a"), after = turning_rig("letter-a", 0.006);
  const SequenceView sequence = changing(before, after, 34);
  const Placement found = found_in(sequence);
  ASSERT_EQ(found.disturbances.size(), 1u);
  EXPECT_EQ(found.disturbances[0].kind, DisturbanceKind::kObject) << found.disturbances[0].text;
  EXPECT_EQ(found.disturbances[0].first_frame, 34u);
  std::vector<Pose> truth = poses_of(sequence);
  for (std::size_t i = 34; i < truth.size(); ++i) truth[i].translation().x() -= 0.006;
  EXPECT_LT(largest_error(found.T_table_sensor, truth), 0.001);
  EXPECT_GT(largest_error(poses_of(sequence), truth), 0.005);
}

TEST(FindDisturbances, MovesACylinderBackAndLeavesItsTurnAlone) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig before = turning_rig("cylinder"), after = turning_rig("cylinder", 0.006);
  const SequenceView sequence = changing(before, after, 30);
  const Placement found = found_in(sequence);
  ASSERT_EQ(found.disturbances.size(), 1u);
  const auto believed = poses_of(sequence);
  const Pose moved = found.T_table_sensor.back() * believed.back().inverse();
  EXPECT_NEAR(moved.translation().x(), -0.006, 0.001);
  EXPECT_LT(Eigen::AngleAxisd(moved.linear()).angle(), 0.3 * kRadiansPerDegree);
}

TEST(FindDisturbances, CorrectsASpeedThatWasStatedWrongly) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig = turning_rig("letter-a");
  const Placement found = found_in(calibrated(rig, 1.04));
  ASSERT_EQ(found.disturbances.size(), 1u);
  EXPECT_EQ(found.disturbances[0].kind, DisturbanceKind::kSpeed) << found.disturbances[0].text;
  EXPECT_LT(largest_error(found.T_table_sensor, poses_of(calibrated(rig))), 0.001);
}

TEST(FindDisturbances, CorrectsASpeedThatWasFarOff) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig = turning_rig("letter-a");
  for (const double factor : {0.82, 1.2}) {
    const Placement found = found_in(calibrated(rig, factor));
    ASSERT_EQ(found.disturbances.size(), 1u) << factor;
    EXPECT_EQ(found.disturbances[0].kind, DisturbanceKind::kSpeed) << found.disturbances[0].text;
    EXPECT_LT(largest_error(found.T_table_sensor, poses_of(calibrated(rig))), 0.0015);
  }
}

TEST(FindDisturbances, LeavesTheSpeedAloneWhereNothingShowsIt) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig = turning_rig("cylinder");
  const SequenceView sequence = calibrated(rig, 1.2);
  EXPECT_TRUE(found_in(sequence).disturbances.empty());
}

/// Raw depths of pixels around the one that sees the middle of the object, right and down of it;
/// near: of something in front of it.
using DepthInFront = std::function<std::uint16_t(double right, double down, std::uint16_t near)>;

std::uint16_t solid(double, double, std::uint16_t near) { return near; }

/// Where and when pixels change.
struct InFront {
  int left, right, above, below;  ///< pixels from the one that sees the middle
  double nearer_m = 0.08;         ///< than the middle
  std::function<bool(std::size_t frame)> when = [](std::size_t i) { return i >= 20 && i <= 25; };
};

SequenceView changed_in_front(const testing::Rig& rig, const InFront& what,
                              const DepthInFront& depth) {
  SequenceView out = calibrated(rig);
  const CameraIntrinsics camera = rig.header().sensors[0].intrinsics;
  const Vec3d middle = rig.truth().center_m + 0.1 * rig.truth().axis;
  const double unit = rig.header().sensors[0].depth_unit_m;
  out.set_map([=](Frame frame, std::size_t i) -> Result<Frame> {
    if (!what.when(i)) return frame;
    const Eigen::Vector2d at = camera.project(middle);
    for (int y = int(at.y()) - what.above; y < int(at.y()) + what.below; ++y) {
      for (int x = int(at.x()) - what.left; x < int(at.x()) + what.right; ++x) {
        if (y < 0 || x < 0 || y >= camera.height || x >= camera.width) continue;
        const double z = middle.z() - what.nearer_m + 0.00003 * (x - at.x()) * (x - at.x());
        frame.depth.pixels[std::size_t(y * camera.width + x)] =
            depth(x - at.x(), y - at.y(), std::uint16_t(z / unit));
      }
    }
    return frame;
  });
  return out;
}

TEST(FindDisturbances, LeavesOutFramesThatSomethingHides) {
  const testing::Rig rig = turning_rig("letter-a");
  const SequenceView sequence = changed_in_front(rig, {20, 20, 30, 20}, solid);
  const Placement found = found_in(sequence);
  ASSERT_FALSE(found.disturbances.empty());
  EXPECT_EQ(found.disturbances[0].kind, DisturbanceKind::kHidden);
  EXPECT_EQ(found.left_out, (std::vector<std::size_t>{20, 21, 22, 23, 24, 25}));
  EXPECT_LT(largest_error(found.T_table_sensor, poses_of(sequence)), 0.001);
}

TEST(FindDisturbances, TakesAnObjectsEndBeyondThePlatterForNoHand) {
  const testing::Rig rig = turning_rig("letter-a");
  // It turns past between sensor and platter, and hides what frames 20 to 25 see.
  InFront end{20, 20, 30, 20, 0.25};
  end.when = [](std::size_t i) { return i >= 10 && i <= 35 && (i < 20 || i > 25); };
  const SequenceView sequence = changed_in_front(rig, end, solid);
  EXPECT_TRUE(found_in(sequence).left_out.empty());
}

TEST(FindDisturbances, TakesWhatIsLeftOfAPlateSeenEdgeOnForNoHand) {
  const testing::Rig rig = turning_rig("letter-a");
  // Hardly anything returns, and what does mixes the edge with what is behind it.
  const SequenceView sequence =
      changed_in_front(rig, {90, 90, 90, 90}, [](double right, double down, std::uint16_t near) {
        const bool edge = std::abs(right) < 3 && std::abs(down) < 6;
        return edge ? near : std::uint16_t(0);
      });
  EXPECT_TRUE(found_in(sequence).left_out.empty());
}

TEST(FindDisturbances, IsSilentWhereItCannotCompareFrames) {
  const testing::Rig rig = turning_rig("letter-a");
  SequenceView sequence = calibrated(rig);
  SequenceHeader header = sequence.header();
  header.sensors.front().kind = SensorKind::kPointScanner;
  sequence.set_header(header);
  const auto found = find_disturbances(sequence, poses_of(sequence), {});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->has_value());
  EXPECT_EQ(find_disturbances(sequence, {}, {}).error().code, ErrorCode::kInvalidOption);
}

TEST(FindDisturbances, AreTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  const testing::Rig before = turning_rig("letter-a"), after = turning_rig("letter-a", 0.006);
  const SequenceView sequence = changing(before, after, 34);
  std::vector<Placement> found;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    found.push_back(found_in(sequence));
    set_thread_count(0);
    ASSERT_EQ(found.back().T_table_sensor.size(), std::size_t(kFrames));
    for (std::size_t i = 0; i < std::size_t(kFrames); ++i)
      EXPECT_EQ(found.back().T_table_sensor[i].matrix(), found.front().T_table_sensor[i].matrix());
  }
  const RunContext context;
  context.cancel();
  EXPECT_EQ(find_disturbances(sequence, poses_of(sequence), context).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
