// What goes wrong during a virtual scan: an object that moves, a scanner that is knocked, a platter
// that does not run true.

#include <turnscan/core/angles.hpp>

#include "tests/simulator/scans.hpp"
#include "tests/simulator/shapes.hpp"

namespace turnscan::events {
namespace {

using test::scan_of;

constexpr double kUnit = 1e-4;
const Vec3d kLow(0.01, 0.0, -0.05), kHigh(0.06, 0.1, 0.03);

VirtualScanOptions clean() {
  VirtualScanOptions o = test::plain_scan();
  o.measure.noise = "none";
  o.motion.frames = 8;
  o.motion.fps = 2.0;
  o.platter.thickness_m = 0.01;
  return o;
}

/// Moved at 2 s, which is frame 4.
VirtualScanOptions moved() {
  VirtualScanOptions o = clean();
  o.object_move = {2.0, 0.02, 1.0, 12.0 * kRadiansPerDegree, 3.0 * kRadiansPerDegree};
  return o;
}

/// Knocked at 2 s, which is frame 4.
VirtualScanOptions knocked() {
  VirtualScanOptions o = clean();
  o.scanners[0].placement.knock = {2.0, 0.01, 0.5, 2.0 * kRadiansPerDegree,
                                   -1.0 * kRadiansPerDegree};
  return o;
}

VirtualScan box_scan(const VirtualScanOptions& o) {
  return scan_of({test::box_mesh(kLow, kHigh)}, o);
}

/// Distance from the surface of the box as the scan has it.
double off_truth(const VirtualScan& scan, const Vec3d& p_table) {
  const Vec3d p = scan.T_table_given().inverse() * p_table;
  return (kLow - p).cwiseMax(p - kHigh).maxCoeff();
}

/// Every recorded point of an object goes back to the object as it stood at first.
void expect_objects_on_truth(const VirtualScan& scan) {
  std::size_t on_object = 0;
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    const TrueSamples truth = *scan.samples(i);
    const DepthImage depth = scan.read(i)->depth;
    const CameraIntrinsics& camera = scan.header().sensors[0].intrinsics;
    const PixelRect& rect = truth.exact.rect;
    for (int y = rect.top; y < rect.bottom; ++y) {
      for (int x = rect.left; x < rect.right; ++x) {
        const std::size_t k = truth.exact.index(x, y);
        if (depth.at(x, y) == kNoReturn || truth.exact.body(k) != 0 || truth.exact.object(k) != 0)
          continue;
        const Vec3d p = scan.T_table_sensor(i) * (depth.at(x, y) * kUnit * camera.ray(x, y));
        ASSERT_NEAR(off_truth(scan, p), 0.0, 1.1e-4) << "frame " << i;
        ASSERT_LT((p - truth.hits[k].p_body).norm(), 1.1e-4);
        ++on_object;
      }
    }
  }
  EXPECT_GT(on_object, 10000u);
}

TEST(ObjectThatMoves, GoesBackToWhereItStoodAtFirst) {
  VirtualScanOptions o = moved();
  expect_objects_on_truth(box_scan(o));
  o.scanners[0].placement.azimuth_rad = 1.2;
  o.table = {0.01, 0.0, 0.02, 2.0 * kRadiansPerDegree, 0.4};
  o.room.kind = RoomKind::kClutter;
  expect_objects_on_truth(box_scan(o));
}

TEST(ObjectThatMoves, ChangesNothingUntilItDoes) {
  const VirtualScan still = box_scan(clean()), scan = box_scan(moved());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(scan.read(i)->depth.pixels, still.read(i)->depth.pixels) << i;
    EXPECT_TRUE(scan.T_table_sensor(i).isApprox(still.T_table_sensor(i), 0.0));
  }
  for (std::size_t i = 4; i < 8; ++i)
    EXPECT_NE(scan.read(i)->depth.pixels, still.read(i)->depth.pixels) << i;
}

TEST(ObjectThatMoves, LeavesThePlatterWhereItIs) {
  VirtualScanOptions o = moved();
  o.object_move.tip_rad = 0.0;
  const VirtualScan scan = box_scan(o);
  const Vec3d where = scan.T_table_sensor(4).translation();
  o.object_move = {};
  EXPECT_GT((where - box_scan(o).T_table_sensor(4).translation()).norm(), 0.01);
  const TrueSamples truth = *scan.samples(5);
  ASSERT_EQ(truth.bodies, (std::vector{BodyKind::kObjects, BodyKind::kPlatterAlone}));
  std::size_t on_platter = 0;
  for (std::size_t k = 0; k < truth.exact.size(); ++k) {
    if (!truth.exact.hit(k) || truth.exact.body(k) != 1 || truth.exact.object(k) != kPlatter)
      continue;
    ++on_platter;
    EXPECT_NEAR(truth.hits[k].p_body.y(), 0.0, 1e-9);
    EXPECT_LT(std::hypot(truth.hits[k].p_body.x(), truth.hits[k].p_body.z()), 0.1501);
  }
  EXPECT_GT(on_platter, 1000u);
}

TEST(ObjectThatMoves, IsNotToldByTheRecording) {
  const VirtualScan still = box_scan(clean()), scan = box_scan(moved());
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_EQ(*scan.frames()[i].angle_rad, *still.frames()[i].angle_rad);
  EXPECT_TRUE(scan.header().sensors[0].T_table_sensor->isApprox(
      *still.header().sensors[0].T_table_sensor, 0.0));
}

TEST(ObjectThatMoves, ShinesWithItsOwnColourAndSignal) {
  VirtualScanOptions o = moved();
  o.platter.thickness_m = 0.0;
  o.room.kind = RoomKind::kDesk;
  o.record.color = true;
  TriangleMesh box = test::box_mesh(kLow, kHigh);
  box.colors.assign(8, Rgb{200, 0, 0});
  const VirtualScan scan = scan_of({box}, o);
  const Frame frame = *scan.read(6);
  const TrueSamples truth = *scan.samples(6);
  const auto kind_at = [&](int x, int y) {
    return truth.bodies[truth.exact.body(truth.exact.index(x, y))];
  };
  const PixelRect& rect = truth.exact.rect;
  for (int y = rect.top; y < rect.bottom; ++y) {
    for (int x = rect.left; x < rect.right; ++x) {
      if (!truth.exact.hit(truth.exact.index(x, y))) continue;
      const Rgb c = frame.color.at(x, y);
      ASSERT_EQ(kind_at(x, y) == BodyKind::kObjects, c.g == 0) << x << " " << y;
    }
  }
}

TEST(KnockedScanner, StillTellsTheTruthOfItsPose) {
  VirtualScanOptions o = knocked();
  expect_objects_on_truth(box_scan(o));
  o.object_move = moved().object_move;
  o.scanners[0].placement.travel_m = 0.05;
  o.scanners[0].placement.roll_rad = 0.3;
  expect_objects_on_truth(box_scan(o));
}

TEST(KnockedScanner, StaysAsItIsAndOnlyIt) {
  VirtualScanOptions o = knocked();
  o.scanners.push_back(o.scanners[0]);
  o.scanners[1].placement.knock = {};
  const VirtualScan scan = box_scan(o);
  o.scanners[0].placement.knock = {};
  const VirtualScan still = box_scan(o);
  const Pose knock = knock_pose(knocked().scanners[0].placement.knock);
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    const Pose moved_by = still.T_table_sensor(i).inverse() * scan.T_table_sensor(i);
    EXPECT_TRUE(moved_by.isApprox(i % 2 == 0 && i >= 8 ? knock : Pose::Identity(), 1e-9)) << i;
  }
}

TEST(KnockedScanner, LeavesTheRecordedCalibrationAsItWas) {
  for (const double at : {0.0, 2.0}) {
    VirtualScanOptions o = knocked();
    o.scanners[0].placement.knock.at_s = at;
    const VirtualScan scan = box_scan(o), still = box_scan(clean());
    EXPECT_TRUE(scan.header().sensors[0].T_table_sensor->isApprox(
        *still.header().sensors[0].T_table_sensor, 0.0));
    EXPECT_TRUE(scan.T_table_given().isApprox(still.T_table_given(), 0.0));
    EXPECT_EQ(scan.turntable().axis, still.turntable().axis);
    EXPECT_EQ(scan.read(0)->depth.pixels == still.read(0)->depth.pixels, at > 0.0);
  }
}

/// From 1 s to 3 s: frames 2 to 5.
VirtualScanOptions with_hand() {
  VirtualScanOptions o = clean();
  o.room.kind = RoomKind::kWall;
  o.record.color = true;
  o.hand.at_s = 1.0;
  o.hand.duration_s = 2.0;
  return o;
}

TEST(HandThatReachesIn, ChangesTheFramesOfItsTimeOnly) {
  VirtualScanOptions o = with_hand();
  const VirtualScan scan = box_scan(o);
  o.hand = {};
  const VirtualScan alone = box_scan(o);
  for (std::size_t i = 0; i < 8; ++i) {
    const Frame with = *scan.read(i), without = *alone.read(i);
    const bool there = i >= 3 && i <= 5;  // at frame 2 it is beside the view
    EXPECT_EQ(with.depth.pixels != without.depth.pixels, there) << i;
    EXPECT_EQ(with.color.pixels != without.color.pixels, there) << i;
  }
}

TEST(HandThatReachesIn, IsNearerThanWhatItHidesAndStaysWhileThePlatterTurns) {
  const VirtualScan scan = box_scan(with_hand());
  const TrueSamples truth = *scan.samples(4);
  ASSERT_EQ(truth.bodies, (std::vector{BodyKind::kObjects, BodyKind::kRoom, BodyKind::kHand}));
  std::size_t of_hand = 0, above = 0;
  for (std::size_t k = 0; k < truth.exact.size(); ++k) {
    if (!truth.exact.hit(k) || truth.exact.body(k) != 2) continue;
    ++of_hand;
    // In the world's frame: nothing of it is as low as the object's top.
    EXPECT_GT(truth.hits[k].p_body.y(), kHigh.y());
    above += std::hypot(truth.hits[k].p_body.x(), truth.hits[k].p_body.z()) < 0.1 ? 1 : 0;
    EXPECT_NEAR(truth.hits[k].normal_body.norm(), 1.0, 1e-9);
  }
  EXPECT_GT(of_hand, 2000u);
  EXPECT_GT(above, 500u);
  EXPECT_TRUE(scan.T_table_sensor(4).isApprox(box_scan(clean()).T_table_sensor(4), 1e-12));
}

TEST(HandThatReachesIn, IsMeasuredWithEveryNoise) {
  VirtualScanOptions o = with_hand();
  o.object_move = {0.5, 0.01, 0.0, 0.0, 0.0};  // all bodies at once
  for (const char* noise : {"gaussian:1mm", "model"}) {
    o.measure.noise = noise;
    const VirtualScan scan = box_scan(o);
    const TrueSamples truth = *scan.samples(4);
    ASSERT_EQ(truth.bodies.size(), 4u);
    std::size_t measured = 0;
    for (std::size_t k = 0; k < truth.exact.size(); ++k)
      if (truth.exact.hit(k) && truth.exact.body(k) == 3)
        measured += truth.measured.miss[k] == Miss::kNone ? 1 : 0;
    EXPECT_GT(measured, 1000u) << noise;
  }
}

/// World height of the point of the platter's rim that is at an azimuth.
double rim_height(const VirtualScan& scan, std::size_t i, double azimuth, double radius) {
  const Pose T_world_table = scan.T_table_world(i).inverse();
  const Vec3d axis = T_world_table.linear().col(1);
  const Vec3d rim = radius * (rotation_about_y(azimuth) * Vec3d(0, 0, -1));
  return -(axis.x() * rim.x() + axis.z() * rim.z()) / axis.y();
}

TEST(PlatterThatWobbles, OnceATurnLiesObliquelyOnATrueAxis) {
  VirtualScanOptions o = clean();
  o.motion.frames = 72;
  o.motion.wobble_rad = 1.0 * kRadiansPerDegree;
  o.motion.wobble_cycles = 1.0;
  const VirtualScan scan = box_scan(o);
  double low = 1.0, high = -1.0;
  int crossings = 0;
  for (std::size_t i = 0; i < 72; ++i) {
    const double here = rim_height(scan, i, 0.7, 0.15);
    const double next = rim_height(scan, (i + 1) % 72, 0.7, 0.15);
    crossings += (here < 0.0) != (next < 0.0) ? 1 : 0;
    low = std::min(low, here);
    high = std::max(high, here);
    // Turned back about the true axis, the platter always lies in the same way.
    const Pose lies = rotation_about_y(-scan.angle_rad(i)) * scan.T_table_world(i).inverse();
    EXPECT_TRUE(lies.isApprox(scan.T_table_world(0).inverse(), 1e-9)) << i;
  }
  EXPECT_EQ(crossings, 2);  // up once and down once
  EXPECT_NEAR(high, 0.15 * std::tan(o.motion.wobble_rad), 1e-5);
  EXPECT_NEAR(low, -high, 2e-5);
  expect_objects_on_truth(box_scan(o));
}

TEST(PlatterThatRunsOut, GoesRoundACircleAsOftenAsAsked) {
  for (const double cycles : {1.0, 3.0}) {
    VirtualScanOptions o = clean();
    o.motion.frames = 60;
    o.motion.runout_m = 0.002;
    o.motion.runout_cycles = cycles;
    const VirtualScan scan = box_scan(o);
    Vec3d mean = Vec3d::Zero();
    int crossings = 0;
    for (std::size_t i = 0; i < 60; ++i) {
      const Vec3d centre = scan.T_table_world(i).inverse().translation();
      const Vec3d next = scan.T_table_world((i + 1) % 60).inverse().translation();
      EXPECT_NEAR(centre.norm(), 0.002, 1e-12);
      EXPECT_EQ(centre.y(), 0.0);
      crossings += (centre.z() > 1e-9) != (next.z() > 1e-9) ? 1 : 0;
      mean += centre / 60.0;
    }
    EXPECT_LT(mean.norm(), 1e-9);
    EXPECT_EQ(crossings, int(2.0 * cycles));
  }
}

TEST(PlatterThatRunsOut, OnceATurnLiesOffTheCentreOfATrueAxis) {
  VirtualScanOptions o = clean();
  o.motion.runout_m = 0.002;
  const VirtualScan scan = box_scan(o);
  for (std::size_t i = 0; i < 8; ++i) {
    const Pose lies = rotation_about_y(-scan.angle_rad(i)) * scan.T_table_world(i).inverse();
    EXPECT_TRUE(lies.isApprox(scan.T_table_world(0).inverse(), 1e-9)) << i;
  }
  expect_objects_on_truth(scan);
}

TEST(ExposureOfAScan, IsTheMeanOfTheMomentsInIt) {
  VirtualScanOptions o = clean();
  o.platter.visible = false;
  o.motion.frames = 40;
  o.motion.fps = 10.0;
  o.record.color = true;
  o.measure.exposure_s = 0.1;
  const VirtualScan blurred = box_scan(o);
  // Nine instants of each tenth of a second, the fifth in the middle.
  o.measure.exposure_s = 0.0;
  o.motion.fps = 90.0;
  o.motion.frames = 360;
  const VirtualScan instants = box_scan(o);
  const Frame frame = *blurred.read(20);
  std::vector<Frame> moments;
  for (std::size_t j = 0; j < 9; ++j) moments.push_back(*instants.read(9 * 20 - 4 + j));
  EXPECT_NEAR(blurred.angle_rad(20), instants.angle_rad(180), 1e-12);
  std::size_t whole = 0;
  for (std::size_t i = 0; i < frame.depth.pixels.size(); ++i) {
    double sum = 0.0, red = 0.0;
    int low = 1 << 20, high = 0;
    for (const Frame& moment : moments) {
      sum += moment.depth.pixels[i] / 9.0;
      red += moment.color.pixels[i].r / 9.0;
      low = std::min(low, int(moment.depth.pixels[i]));
      high = std::max(high, int(moment.depth.pixels[i]));
    }
    ASSERT_NEAR(frame.color.pixels[i].r, red, 0.51 + 1e-9);
    if (low == 0 || high - low > 40) continue;
    ASSERT_NEAR(frame.depth.pixels[i], sum, 1.1) << i;
    ++whole;
  }
  EXPECT_GT(whole, 300u);
}

TEST(ExposureOfAScan, IsNoLongerThanFromFrameToFrame) {
  VirtualScanOptions o = clean();
  o.measure.exposure_s = 0.51;
  const auto scan = VirtualScan::create({}, o);
  ASSERT_FALSE(scan);
  EXPECT_NE(scan.error().message.find("exposure = 0.51s is longer than from frame to frame"),
            std::string::npos)
      << scan.error().message;
  for (const double bad : {-0.1, std::nan("")}) {
    o.measure.exposure_s = bad;
    const auto refused = VirtualScan::create({}, o);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("exposure = "), std::string::npos);
  }
}

TEST(EventOptions, RefuseWhatLiesBeyondTheRecording) {
  const auto refused = [](const VirtualScanOptions& o, const std::string& says) {
    const auto scan = VirtualScan::create({}, o);
    ASSERT_FALSE(scan) << says;
    EXPECT_EQ(scan.error().code, ErrorCode::kInvalidOption);
    EXPECT_NE(scan.error().message.find(says), std::string::npos) << scan.error().message;
  };
  VirtualScanOptions o = moved();
  o.object_move.at_s = 4.0;
  refused(o, "object-move-at = 4s is not within the recording");
  o = knocked();
  o.scanners[0].placement.knock.at_s = 5.0;
  refused(o, "knock-at = 5s is not within the recording");
  o = moved();
  o.object_move.tip_rad = std::nan("");
  refused(o, "object-move-tip");
  o = knocked();
  o.scanners[0].placement.knock.pan_rad = 3.0;
  refused(o, "knock-pan");
  o = with_hand();
  o.hand.at_s = 4.5;
  refused(o, "hand-at = 4.5s is not within the recording");
  o = clean();
  o.motion.runout_m = -0.001;
  refused(o, "runout");
}

}  // namespace
}  // namespace turnscan::events
