// What a virtual scan does beyond one camera before one object: several scanners, line scanners,
// the room, a turntable that is not where it was meant to be.

#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "tests/simulator/scans.hpp"
#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

using test::scan_of;

constexpr double kUnit = 1e-4;
const Vec3d kLow(0.01, 0.0, -0.05), kHigh(0.06, 0.1, 0.03);

VirtualScanOptions clean() {
  VirtualScanOptions o = test::plain_scan();
  o.measure.noise = "none";
  o.motion.frames = 8;
  o.platter.visible = false;
  return o;
}

TriangleMesh box() { return test::box_mesh(kLow, kHigh); }

VirtualScanner line_scanner() {
  ScannerParameters p;
  p.name = "line";
  p.kind = ScannerKind::kLine;
  p.rows = 300;
  p.fov_y_rad = 20.0 * kRadiansPerDegree;
  p.near_m = 0.2;
  p.far_m = 1.5;
  VirtualScanner scanner{*scanner_model(p), {}};
  scanner.placement.distance_m = 0.5;
  scanner.placement.elevation_rad = 0.0;
  scanner.placement.aim_height_m = 0.05;
  return scanner;
}

/// Points of a frame in the sensor's frame.
std::vector<Vec3d> points_of(const VirtualScan& scan, std::size_t position) {
  auto frame = scan.read(position);
  EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
  std::vector<Vec3d> points;
  for (const Vec3f& p : frame->points.points) points.push_back(p.cast<double>());
  const CameraIntrinsics& camera = scan.header().sensors[frame->info.sensor].intrinsics;
  for (int y = 0; y < frame->depth.height; ++y)
    for (int x = 0; x < frame->depth.width; ++x)
      if (frame->depth.at(x, y) != kNoReturn)
        points.emplace_back(frame->depth.at(x, y) * kUnit * camera.ray(x, y));
  return points;
}

/// Distance from the surface of a box.
double off_box(const Vec3d& p, const Vec3d& low, const Vec3d& high) {
  return (low - p).cwiseMax(p - high).maxCoeff();
}

/// The box as the scan has it: turned with the table's frame.
double off_truth(const VirtualScan& scan, const Vec3d& p_table) {
  return off_box(scan.T_table_given().inverse() * p_table, kLow, kHigh);
}

void expect_points_on_truth(const VirtualScan& scan) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    if (scan.frames()[i].status == FrameStatus::kDropped) continue;
    for (const Vec3d& p : points_of(scan, i)) {
      ASSERT_NEAR(off_truth(scan, scan.T_table_sensor(i) * p), 0.0, 1.1e-4) << "frame " << i;
      ++seen;
    }
  }
  EXPECT_GT(seen, 1000u);
}

/// What the recording itself says of a frame's pose.
Pose recorded_pose(const VirtualScan& scan, std::size_t i) {
  const FrameInfo& info = scan.frames()[i];
  if (info.T_table_sensor) return *info.T_table_sensor;
  return rotation_about_y(-*info.angle_rad) * *scan.header().sensors[info.sensor].T_table_sensor;
}

TEST(VirtualRig, PutsThePointsOnTheTruthWhateverTheRig) {
  VirtualScanOptions o = clean();
  o.scanners.push_back(o.scanners[0]);
  o.scanners[0].placement.azimuth_rad = 40.0 * kRadiansPerDegree;
  o.scanners[0].placement.roll_rad = 10.0 * kRadiansPerDegree;
  o.scanners[1].placement.azimuth_rad = 200.0 * kRadiansPerDegree;
  o.scanners[1].placement.travel_m = 0.2;
  o.scanners.push_back(line_scanner());
  o.table = {0.02, 0.01, -0.015, 3.0 * kRadiansPerDegree, 1.0};
  o.motion.frames = 12;
  o.motion.turns = -1.3;
  o.motion.ripple = 0.05;
  o.motion.start_ramp_s = 0.1;
  o.motion.wobble_rad = 0.5 * kRadiansPerDegree;
  o.motion.dropped = 0.2;
  expect_points_on_truth(scan_of({box()}, o));
}

TEST(VirtualRig, RecordsThePosesThatAreTrue) {
  VirtualScanOptions o = clean();
  o.scanners[0].placement.azimuth_rad = -70.0 * kRadiansPerDegree;
  o.scanners.push_back(line_scanner());
  o.scanners[1].placement.travel_m = 0.1;
  o.scanners[1].placement.travel_along = TravelAlong::kAcross;
  o.table = {0.0, 0.01, 0.02, 2.0 * kRadiansPerDegree, 0.3};
  const VirtualScan scan = scan_of({box()}, o);
  for (std::size_t i = 0; i < scan.frames().size(); ++i)
    EXPECT_TRUE(recorded_pose(scan, i).isApprox(scan.T_table_sensor(i), 1e-12)) << i;
}

TEST(VirtualRig, HasATableFrameThatAxisAndCentreGive) {
  VirtualScanOptions o = clean();
  o.scanners[0].placement.azimuth_rad = 100.0 * kRadiansPerDegree;
  o.table = {0.03, 0.01, 0.02, 4.0 * kRadiansPerDegree, 2.0};
  const VirtualScan scan = scan_of({box()}, o);
  const TurntableInfo& table = *scan.header().turntable;
  const Vec3d y = table.axis, x = y.cross(table.center_m).normalized(), z = x.cross(y);
  Pose T = Pose::Identity();
  T.linear() << x.transpose(), y.transpose(), z.transpose();
  T.translation() = -(T.linear() * table.center_m);
  EXPECT_TRUE(T.isApprox(*scan.header().sensors[0].T_table_sensor, 1e-9));
  EXPECT_TRUE(scan.turntable().axis.isApprox(table.axis));
}

TEST(VirtualRig, TurnsTheTruthWithTheTableFrame) {
  VirtualScanOptions o = clean();
  o.scanners[0].placement.azimuth_rad = 90.0 * kRadiansPerDegree;
  const VirtualScan scan = scan_of({box()}, o);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR((scan.objects()[0].vertices[i].cast<double>() -
                 scan.T_table_given() * box().vertices[i].cast<double>())
                    .norm(),
                0.0, 1e-7);
  EXPECT_GT((scan.T_table_given().linear() - Eigen::Matrix3d::Identity()).norm(), 1.0);
}

TEST(VirtualRig, TakesOneFrameOfEachScannerAtATime) {
  VirtualScanOptions o = clean();
  o.scanners.push_back(line_scanner());
  o.scanners.push_back(o.scanners[0]);
  o.record.pass = 2;
  const VirtualScan scan = scan_of({box()}, o);
  ASSERT_EQ(scan.frames().size(), 24u);
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_EQ(scan.frames()[i].index, i);
    EXPECT_EQ(scan.frames()[i].sensor, i % 3);
    EXPECT_EQ(scan.frames()[i].pass, 2u);
    EXPECT_DOUBLE_EQ(scan.frames()[i].time_s, double(i / 3) / 30.0);
  }
  EXPECT_EQ(scan.header().sensors[1].kind, SensorKind::kPointScanner);
  EXPECT_EQ(scan.header().sensors[2].kind, SensorKind::kDepthCamera);
}

TEST(VirtualRig, GivesTheScannersNoiseOfTheirOwn) {
  VirtualScanOptions o = clean();
  o.scanners.push_back(o.scanners[0]);
  o.measure.noise = "gaussian:1mm";
  const VirtualScan scan = scan_of({box()}, o);
  EXPECT_NE(scan.read(0)->depth.pixels, scan.read(1)->depth.pixels);
}

TEST(VirtualRig, GivesTheSectionThatALineScannerLightsUp) {
  VirtualScanOptions o = clean();
  o.scanners = {line_scanner()};
  const VirtualScan scan = scan_of({box()}, o);
  const std::vector<Vec3d> points = points_of(scan, 0);
  // The upright sheet of light is the plane x = 0 of the table and misses the box...
  EXPECT_TRUE(points.empty());
  // ... until the box, which is on the side of +X, has turned into it.
  const std::vector<Vec3d> quarter = points_of(scan, 2);
  ASSERT_GT(quarter.size(), 100u);
  double top = 0.0;
  for (const Vec3d& p : quarter) {
    EXPECT_EQ(p.x(), 0.0);
    top = std::max(top, (scan.T_table_sensor(2) * p).y());
  }
  EXPECT_NEAR(top, kHigh.y(), 0.001);
}

TEST(VirtualRig, TurnsTheLineWhenTheScannerIsRolled) {
  VirtualScanOptions o = clean();
  o.scanners = {line_scanner()};
  o.scanners[0].placement.roll_rad = 90.0 * kRadiansPerDegree;
  const VirtualScan scan = scan_of({box()}, o);
  const std::vector<Vec3d> points = points_of(scan, 0);
  ASSERT_GT(points.size(), 50u);
  for (const Vec3d& p : points) EXPECT_NEAR((scan.T_table_sensor(0) * p).y(), 0.05, 1e-6);
}

TEST(VirtualRig, LosesWhatTheLightDoesNotReach) {
  // A screen before a wall: the umbra of the emitter's edge is baseline * dz / z wide on the wall.
  VirtualScanOptions o = clean();
  o.scanners[0].placement.elevation_rad = 0.0;
  o.scanners[0].placement.aim_height_m = 0.1;
  o.motion.frames = 1;
  const double z_screen = 0.7, z_wall = 1.0, baseline = 0.08;
  const std::vector<TriangleMesh> meshes{
      test::box_mesh({0.0, -0.2, z_screen - 0.9}, {0.3, 0.4, z_screen - 0.89}),
      test::box_mesh({-0.4, -0.2, z_wall - 0.9}, {0.4, 0.4, z_wall - 0.89})};
  const auto wall_pixels = [&](double emitter_x) {
    o.scanners[0].model.emitter_m = Vec3d(emitter_x, 0, 0);
    const VirtualScan scan = scan_of(meshes, o);
    int count = 0;
    const DepthImage depth = scan.read(0)->depth;
    for (int x = 0; x < depth.width; ++x)
      count += std::abs(depth.at(x, 212) * kUnit - z_wall) < 1e-3 ? 1 : 0;
    return count;
  };
  // The screen is on the left in the image (table +X is the camera's -x).
  const double umbra = baseline * (z_wall - z_screen) / z_screen;
  const double pixel = z_wall / o.scanners[0].model.camera.fx;
  EXPECT_NEAR((wall_pixels(0.0) - wall_pixels(-baseline)) * pixel, umbra, 1.01 * pixel);
  EXPECT_EQ(wall_pixels(0.0), wall_pixels(baseline));
}

TEST(VirtualRig, SeesNothingNearerOrFartherThanItsRange) {
  VirtualScanOptions o = clean();
  o.scanners[0].model.near_m = 0.86;
  o.scanners[0].model.far_m = 0.9;
  const VirtualScan scan = scan_of({box()}, o);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    for (const Vec3d& p : points_of(scan, i)) {
      ASSERT_GE(p.z(), 0.86 - kUnit);
      ASSERT_LE(p.z(), 0.9 + kUnit);
      ++seen;
    }
  }
  EXPECT_GT(seen, 100u);
}

TEST(VirtualRig, KeepsTheRoomStillWhileTheObjectTurns) {
  VirtualScanOptions o = clean();
  o.platter.visible = true;
  o.platter.thickness_m = 0.02;
  o.room.kind = RoomKind::kClutter;
  o.motion.frames = 5;
  const VirtualScan empty = scan_of({}, o);
  const DepthImage first = empty.read(0)->depth;
  // The empty table is the same at every angle, but for the facets of the platter's side.
  for (std::size_t i = 1; i < 5; ++i) {
    const DepthImage depth = empty.read(i)->depth;
    std::size_t other = 0;
    for (std::size_t k = 0; k < depth.pixels.size(); ++k)
      other += std::abs(int(depth.pixels[k]) - int(first.pixels[k])) > 10 ? 1 : 0;
    EXPECT_LT(other, 100u);
  }
  const auto returns = std::count_if(first.pixels.begin(), first.pixels.end(),
                                     [](std::uint16_t raw) { return raw != kNoReturn; });
  EXPECT_GT(returns, 150000);
  // With the object only what it covers changes.
  const DepthImage with = scan_of({box()}, o).read(0)->depth;
  std::size_t nearer = 0;
  for (std::size_t k = 0; k < with.pixels.size(); ++k) {
    if (with.pixels[k] == first.pixels[k]) continue;
    ASSERT_LT(with.pixels[k], first.pixels[k]);
    ++nearer;
  }
  EXPECT_GT(nearer, 500u);
}

TEST(VirtualRig, ShowsThePlattersSide) {
  VirtualScanOptions o = clean();
  o.platter.visible = true;
  const auto returns = [&](double thickness) {
    o.platter.thickness_m = thickness;
    return points_of(scan_of({}, o), 0).size();
  };
  EXPECT_GT(returns(0.03), returns(0.0) + 500);
}

TEST(VirtualRig, LeavesOutOrBendsTheCalibrationOnRequest) {
  VirtualScanOptions o = clean();
  o.table = {0.02, 0.01, 0.0, 3.0 * kRadiansPerDegree, 0.5};
  const VirtualScan truth = scan_of({box()}, o);
  o.record.calibration = RecordedCalibration::kNominal;
  const VirtualScan nominal = scan_of({box()}, o);
  EXPECT_TRUE(nominal.turntable().axis.isApprox(truth.turntable().axis));
  const double lean = std::acos(nominal.header().turntable->axis.dot(truth.turntable().axis));
  EXPECT_NEAR(lean, 3.0 * kRadiansPerDegree, 1e-9);
  EXPECT_EQ(nominal.read(3)->depth.pixels, truth.read(3)->depth.pixels);
  o.record.calibration = RecordedCalibration::kNone;
  o.record.angles = false;
  const VirtualScan none = scan_of({box()}, o);
  EXPECT_FALSE(none.header().turntable);
  EXPECT_FALSE(none.header().sensors[0].T_table_sensor);
  for (const FrameInfo& frame : none.frames()) {
    EXPECT_FALSE(frame.angle_rad);
    EXPECT_FALSE(frame.T_table_sensor);
    EXPECT_TRUE(std::isfinite(frame.time_s));
  }
  EXPECT_EQ(none.angle_rad(3), truth.angle_rad(3));
}

TEST(VirtualRig, AimsAtTheMiddleOfTheObjectUnlessTold) {
  VirtualScanOptions o = clean();
  o.scanners[0].placement.aim_height_m.reset();
  const VirtualScan scan = scan_of({box()}, o);
  const Vec3d aim = scan.T_table_sensor(0) * Vec3d(0, 0, 0.9);
  EXPECT_NEAR(aim.y(), 0.05, 1e-9);
}

TEST(VirtualRig, DropsFramesAndSaysSo) {
  VirtualScanOptions o = clean();
  o.motion.frames = 200;
  o.motion.dropped = 0.3;
  const VirtualScan scan = scan_of({box()}, o);
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    if (scan.frames()[i].status != FrameStatus::kDropped) continue;
    ++dropped;
    EXPECT_EQ(scan.read(i).error().code, ErrorCode::kMissingData);
  }
  EXPECT_GT(dropped, 30u);
  EXPECT_LT(dropped, 90u);
}

TEST(VirtualRig, WorksOnMeshesThatAreNotPerfect) {
  VirtualScanOptions o = clean();
  const VirtualScan whole = scan_of({box()}, o);
  const DepthImage expected = whole.read(3)->depth;
  TriangleMesh inverted = box();
  for (auto& t : inverted.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(scan_of({inverted}, o).read(3)->depth.pixels, expected.pixels);
  TriangleMesh doubled = box();
  doubled.triangles.insert(doubled.triangles.end(), doubled.triangles.begin(),
                           doubled.triangles.end());
  doubled.triangles.push_back({0, 0, 1});
  doubled.triangles.push_back({5, 5, 5});
  EXPECT_EQ(scan_of({doubled}, o).read(3)->depth.pixels, expected.pixels);
  TriangleMesh open = box();
  open.triangles.resize(6);
  EXPECT_GT(points_of(scan_of({open}, o), 3).size(), 100u);
}

TEST(VirtualRigOptions, RefuseWhatCannotBe) {
  const auto refused = [](const VirtualScanOptions& o, const std::string& says) {
    const auto scan = VirtualScan::create({}, o);
    EXPECT_FALSE(scan) << says;
    EXPECT_EQ(scan.error().code, ErrorCode::kInvalidOption);
    EXPECT_NE(scan.error().message.find(says), std::string::npos) << scan.error().message;
  };
  VirtualScanOptions o = clean();
  o.scanners.assign(65, o.scanners[0]);
  refused(o, "65 scanners");
  o = clean();
  o.scanners[0].model.near_m = 9.0;
  refused(o, "near = 9000mm");
  o = clean();
  o.scanners[0].placement.roll_rad = 100.0;
  refused(o, "roll");
  o = clean();
  o.table.tilt_rad = -1.0;
  refused(o, "table-tilt");
  o = clean();
  o.platter.radius_m = 0.0;
  refused(o, "platter-radius");
  o = clean();
  o.room.clutter = -1;
  refused(o, "clutter");
  o = clean();
  o.record.pass = -1;
  refused(o, "pass");
  o = clean();
  o.measure.seed = -1;
  refused(o, "seed");
}

}  // namespace
}  // namespace turnscan
