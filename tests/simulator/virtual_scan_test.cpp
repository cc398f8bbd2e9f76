#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

#include "tests/simulator/scans.hpp"
#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

using test::kPi;
using test::scan_of;

constexpr double kDepthUnit = 1e-4;
// Half a step of the depth image, and what float32 rays lose.
constexpr double kRounding = 0.5 * kDepthUnit + 1e-6;

VirtualScanOptions noiseless() {
  VirtualScanOptions o = test::plain_scan();
  o.measure.noise = "none";
  o.measure.mixed_pixels = 0.0;
  o.motion.frames = 8;
  o.platter.visible = false;
  return o;
}

DepthImage depth_of(const VirtualScan& scan, std::size_t position) {
  auto frame = scan.read(position);
  EXPECT_TRUE(frame) << (frame ? "" : frame.error().text());
  return frame->depth;
}

const CameraIntrinsics& camera_of(const VirtualScan& scan) {
  return scan.header().sensors[0].intrinsics;
}

/// Calls body(column, row, ray in the table frame with the depth as its parameter, depth or 0).
template <class Body>
void for_each_pixel(const VirtualScan& scan, std::size_t position, const Body& body) {
  const DepthImage depth = depth_of(scan, position);
  const Pose T = scan.T_table_sensor(position);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const Vec3d direction = T.linear() * camera_of(scan).ray(x, y);
      body(x, y, Vec3d(T.translation()), direction, depth.at(x, y) * kDepthUnit);
    }
  }
}

/// Nearest root of the quadratic a t^2 + 2 b t + c, or infinity; `margin` is how clearly it has
/// any: (b^2 - a c) / b^2.
double nearest_root(double a, double b, double c, double& margin) {
  margin = (b * b - a * c) / (b * b);
  if (margin < 0.0) return std::numeric_limits<double>::infinity();
  return (-b - std::sqrt(b * b - a * c)) / a;
}

TEST(VirtualScan, TellsTheTruthOfEverySampleThatItRecords) {
  VirtualScanOptions o = noiseless();
  o.measure.noise = "gaussian:2mm";
  o.platter.visible = true;
  const double radius = 0.06;
  const Vec3d centre(0.03, 0.08, 0.02);
  const VirtualScan scan = scan_of({test::sphere_mesh(centre, radius, 200)}, o);
  for (const std::size_t position : {0u, 5u}) {
    const auto truth = scan.samples(position);
    ASSERT_TRUE(truth);
    const SampleGrid& exact = truth->exact;
    const DepthImage depth = depth_of(scan, position);
    const Pose T = scan.T_table_sensor(position);
    std::size_t of_sphere = 0;
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        if (!exact.contains(x, y)) {
          ASSERT_EQ(depth.at(x, y), kNoReturn);
          continue;
        }
        const std::size_t i = exact.index(x, y);
        ASSERT_NEAR(depth.at(x, y) * kDepthUnit, truth->measured.z[i], kRounding);
        ASSERT_EQ(depth.at(x, y) != kNoReturn, truth->measured.miss[i] == Miss::kNone);
        if (!exact.hit(i)) continue;
        const SampleHit& hit = truth->hits[i];
        ASSERT_LT((T * hit.p_sensor - hit.p_body).norm(), 1e-9);
        // Rounding of the ray counts for more the flatter it meets the surface.
        ASSERT_NEAR(hit.p_sensor.z(), exact.z[i], 5e-7 / std::cos(hit.incidence_rad));
        if (exact.object(i) == kPlatter) {
          ASSERT_NEAR(hit.p_body.y(), 0.0, 1e-12);
          continue;
        }
        ++of_sphere;
        ASSERT_NEAR((hit.p_body - centre).norm(), radius, 1e-5);
        ASSERT_GT(hit.normal_body.dot((hit.p_body - centre).normalized()), 0.999);
      }
    }
    EXPECT_GT(of_sphere, 500u);
  }
  EXPECT_FALSE(scan.samples(8));
}

TEST(VirtualScan, SeesThePlatterAsThePlaneItIs) {
  VirtualScanOptions o = noiseless();
  o.platter.visible = true;
  const VirtualScan scan = scan_of({}, o);
  std::size_t seen = 0;
  for_each_pixel(scan, 3, [&](int, int, const Vec3d& eye, const Vec3d& way, double depth) {
    const double t = -eye.y() / way.y();
    const double radius = std::hypot(eye.x() + t * way.x(), eye.z() + t * way.z());
    if (std::abs(radius - 0.15) < 1e-5) return;
    const bool on = t > 0.0 && radius < 0.15;
    ASSERT_EQ(depth > 0.0, on);
    if (on) {
      ASSERT_NEAR(depth, t, kRounding);
    }
    seen += on ? 1 : 0;
  });
  EXPECT_GT(seen, 3000u);
}

TEST(VirtualScan, SeesASphereWhereAlgebraSays) {
  const Vec3d centre(0.02, 0.09, 0.01);
  const VirtualScan scan = scan_of({test::sphere_mesh(centre, 0.06, 500)}, noiseless());
  std::size_t seen = 0;
  for_each_pixel(scan, 5, [&](int, int, const Vec3d& eye, const Vec3d& way, double depth) {
    const Vec3d o = eye - centre;
    double margin = 0.0;
    const double t =
        nearest_root(way.squaredNorm(), o.dot(way), o.squaredNorm() - 0.06 * 0.06, margin);
    if (std::abs(margin) < 1e-4) return;  // within a few pixels of the outline: facets
    ASSERT_EQ(depth > 0.0, std::isfinite(t));
    if (depth > 0.0) {
      ASSERT_NEAR(depth, t, kRounding + 5e-6);
    }
    seen += depth > 0.0 ? 1 : 0;
  });
  EXPECT_GT(seen, 1500u);
}

TEST(VirtualScan, SeesTheCylinderWhereAlgebraSays) {
  const VirtualScan scan = scan_of({*builtin_object("cylinder")}, noiseless());
  std::size_t walls = 0, top = 0;
  for_each_pixel(scan, 2, [&](int, int, const Vec3d& eye, const Vec3d& way, double depth) {
    if (depth == 0.0) return;
    double margin = 0.0;
    const double wall =
        nearest_root(way.x() * way.x() + way.z() * way.z(), eye.x() * way.x() + eye.z() * way.z(),
                     eye.x() * eye.x() + eye.z() * eye.z() - 0.04 * 0.04, margin);
    const double lid = (0.16 - eye.y()) / way.y();
    const double height = eye.y() + wall * way.y();
    if (margin < 1e-4 || std::abs(height - 0.16) < 1e-5) return;
    const bool on_wall = height > 0.0 && height < 0.16;
    ASSERT_NEAR(depth, on_wall ? wall : lid, kRounding + 1e-5);
    (on_wall ? walls : top) += 1;
  });
  EXPECT_GT(walls, 1000u);
  EXPECT_GT(top, 100u);
}

void expect_box_seen(const Vec3d& low, const Vec3d& high) {
  const VirtualScan scan = scan_of({test::box_mesh(low, high)}, noiseless());
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    for_each_pixel(scan, i, [&](int, int, const Vec3d& eye, const Vec3d& way, double depth) {
      // Where the ray enters and leaves the three slabs (Kay and Kajiya 1986).
      const Vec3d a = (low - eye).cwiseQuotient(way), b = (high - eye).cwiseQuotient(way);
      const double enter = a.cwiseMin(b).maxCoeff(), leave = a.cwiseMax(b).minCoeff();
      if (std::abs(enter - leave) < 1e-5) return;
      ASSERT_EQ(depth > 0.0, enter < leave && enter > 0.0);
      if (depth > 0.0) {
        ASSERT_NEAR(depth, enter, kRounding);
      }
    });
  }
}

TEST(VirtualScan, SeesABoxOutToItsLastPixel) {
  expect_box_seen({-0.05, 0.02, -0.04}, {0.05, 0.15, 0.04});
}

TEST(VirtualScan, SeesWhatReachesBeyondTheCamera) {
  expect_box_seen({0.05, -0.5, -3.0}, {0.3, -0.4, 3.0});
}

TEST(VirtualScan, FollowsTheDistortionOfItsLens) {
  VirtualScanOptions o = noiseless();
  o.platter.visible = true;
  o.scanners[0].placement.distance_m = 0.3;
  o.scanners[0].placement.aim_height_m = 0.0;
  o.scanners[0].model.camera.distortion = {0.09, -0.27, 0.001, -0.0005, 0.09};
  const VirtualScan scan = scan_of({}, o);
  for_each_pixel(scan, 0, [&](int, int, const Vec3d& eye, const Vec3d& way, double depth) {
    const double t = -eye.y() / way.y();
    const double radius = std::hypot(eye.x() + t * way.x(), eye.z() + t * way.z());
    if (std::abs(radius - 0.15) < 1e-5) return;
    ASSERT_EQ(depth > 0.0, t > 0.0 && radius < 0.15);
    if (depth > 0.0) {
      ASSERT_NEAR(depth, t, kRounding);
    }
  });
}

TEST(VirtualScan, TurnsTheObjectCounterClockwiseSeenFromAbove) {
  // A post on the +X side comes to -Z, before the camera, after a quarter of a turn.
  VirtualScanOptions o = noiseless();
  o.motion.frames = 4;
  const VirtualScan scan = scan_of({test::box_mesh({0.09, 0, -0.01}, {0.11, 0.18, 0.01})}, o);
  const auto nearest = [&](std::size_t position) {
    double z = 10.0;
    for (const auto raw : depth_of(scan, position).pixels)
      if (raw != kNoReturn) z = std::min(z, raw * kDepthUnit);
    return z;
  };
  EXPECT_NEAR(nearest(1), 0.9 - 0.11 * std::cos(o.scanners[0].placement.elevation_rad), 0.03);
  EXPECT_NEAR(nearest(3), 0.9 + 0.09 * std::cos(o.scanners[0].placement.elevation_rad), 0.03);
  // The camera's x axis is -X of the table at the start, so the post is on the left.
  const DepthImage first = depth_of(scan, 0);
  for (int y = 0; y < first.height; ++y)
    for (int x = 256; x < first.width; ++x) ASSERT_EQ(first.at(x, y), kNoReturn);
}

TEST(VirtualScan, PutsThePointsOfAllFramesOnTheObjectAtAngleZero) {
  const Vec3d low(0.02, 0.0, -0.05), high(0.06, 0.1, 0.03);
  const VirtualScan scan = scan_of({test::box_mesh(low, high)}, noiseless());
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    for_each_pixel(scan, i, [&](int, int, const Vec3d& eye, const Vec3d& way, double depth) {
      if (depth == 0.0) return;
      const Vec3d p = eye + depth * way;
      const Vec3d out = (low - p).cwiseMax(p - high);
      ASSERT_NEAR(out.maxCoeff(), 0.0, 1e-4);
    });
  }
}

TEST(VirtualScan, SaysWhereItsTurntableIs) {
  const VirtualScan scan = scan_of({}, noiseless());
  const SensorInfo& sensor = scan.header().sensors.at(0);
  const TurntableInfo& table = *scan.header().turntable;
  // Thesis eq. 3.10 read as rows: the table's axes in the sensor's frame.
  const Vec3d y = table.axis, x = y.cross(table.center_m).normalized(), z = x.cross(y);
  Pose T = Pose::Identity();
  T.linear() << x.transpose(), y.transpose(), z.transpose();
  T.translation() = -(T.linear() * table.center_m);
  EXPECT_TRUE(T.isApprox(*sensor.T_table_sensor, 1e-12));
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
  EXPECT_NEAR((T.translation() - Vec3d(0, 0.09, 0)).norm(), 0.9, 1e-12);
  EXPECT_DOUBLE_EQ(*table.radius_m, 0.15);
  EXPECT_DOUBLE_EQ(sensor.depth_unit_m, kDepthUnit);
}

TEST(VirtualScan, SpreadsFramesOverTheTurns) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = 920;
  o.motion.turns = 2.0;
  const VirtualScan scan = scan_of({}, o);
  EXPECT_DOUBLE_EQ(*scan.frames()[0].angle_rad, 0.0);
  EXPECT_NEAR(*scan.frames()[919].angle_rad, 4.0 * kPi * 919 / 920, 1e-12);
  EXPECT_EQ(scan.frames()[459].turn, 0u);
  EXPECT_EQ(scan.frames()[460].turn, 1u);
  EXPECT_DOUBLE_EQ(scan.frames()[30].time_s, 1.0);
  EXPECT_NEAR(*scan.header().turntable->speed_rad_s, 4.0 * kPi * 30.0 / 920.0, 1e-12);
}

TEST(VirtualScan, TakesTheAngleFromSpeedAndFrameRateWhenTheyAreGiven) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = 920;
  ASSERT_TRUE(describe(o.motion).set("speed", "10.4478deg/s"));
  const VirtualScan scan = scan_of({}, o);
  EXPECT_NEAR(*scan.frames()[919].angle_rad * 180.0 / kPi, 10.4478 * 919 / 30, 1e-9);
}

TEST(VirtualScan, GivesTheSameBytesInAnyOrderOnAnyThread) {
  VirtualScanOptions o = test::plain_scan();
  o.motion.frames = 12;
  o.record.color = true;
  const VirtualScan scan = scan_of({*builtin_object("letter-a")}, o);
  std::vector<Frame> serial(12), parallel(12);
  for (std::size_t i = 12; i-- > 0;) serial[i] = *scan.read(i);
  set_thread_count(4);
  const VirtualScan again = scan_of({*builtin_object("letter-a")}, o);
  parallel_for(12, 1, [&](std::size_t i) { parallel[i] = *again.read(i); });
  set_thread_count(0);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(serial[i].depth.pixels, parallel[i].depth.pixels) << i;
    EXPECT_EQ(serial[i].color.pixels, parallel[i].color.pixels) << i;
  }
}

TEST(VirtualScan, ChangesItsNoiseWithTheSeed) {
  VirtualScanOptions o = noiseless();
  o.platter.visible = true;
  o.measure.noise = "gaussian:1mm";
  const DepthImage one = depth_of(scan_of({}, o), 0);
  o.measure.seed = 2;
  EXPECT_NE(one.pixels, depth_of(scan_of({}, o), 0).pixels);
}

/// Noise of each pixel of the platter in units of sigma, frame by frame.
std::vector<std::vector<double>> residuals(double sigma, int frames) {
  VirtualScanOptions o = noiseless();
  o.platter.visible = true;
  o.motion.frames = frames;
  const VirtualScan truth = scan_of({}, o);
  o.measure.noise = fmt::format("gaussian:{}m", sigma);
  const VirtualScan noisy = scan_of({}, o);
  std::vector<std::vector<double>> out(frames);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const DepthImage a = depth_of(truth, i), b = depth_of(noisy, i);
    for (std::size_t k = 0; k < a.pixels.size(); ++k)
      if (a.pixels[k] != kNoReturn)
        out[i].push_back((double(b.pixels[k]) - double(a.pixels[k])) * kDepthUnit / sigma);
  }
  return out;
}

TEST(GaussianNoise, HasItsMeanAndSigmaAndTails) {
  const double sigma = 1.5e-3;
  double sum = 0.0, squares = 0.0, beyond = 0.0;
  std::size_t n = 0;
  for (const auto& frame : residuals(sigma, 30)) {
    for (const double r : frame) {
      sum += r;
      squares += r * r;
      beyond += std::abs(r) > 2.0 ? 1.0 : 0.0;
      ++n;
    }
  }
  ASSERT_GT(n, 90000u);
  const double mean = sum / double(n);
  // Both images are rounded: two uniform errors of one step.
  const double rounding = 2.0 / 12.0 * (kDepthUnit / sigma) * (kDepthUnit / sigma);
  EXPECT_LT(std::abs(mean), test::mean_bound(1.0, n));
  EXPECT_NEAR(squares / double(n), 1.0 + rounding, test::mean_bound(std::sqrt(2.0), n));
  // P(|x| > 2) = 0.0455; the steps of the image blur the limit by a thirtieth of sigma.
  EXPECT_NEAR(beyond / double(n), 0.0455, test::mean_bound(std::sqrt(0.0455), n) + 0.004);
}

TEST(GaussianNoise, IsIndependentOfNeighboursAndOfTheNextFrame) {
  const auto r = residuals(1.5e-3, 20);
  double beside = 0.0, later = 0.0;
  std::size_t n = 0, m = 0;
  for (std::size_t i = 0; i + 1 < r.size(); ++i) {
    for (std::size_t k = 0; k + 1 < r[i].size(); ++k, ++n) beside += r[i][k] * r[i][k + 1];
    for (std::size_t k = 0; k < std::min(r[i].size(), r[i + 1].size()); ++k, ++m)
      later += r[i][k] * r[i + 1][k];
  }
  EXPECT_LT(std::abs(beside / double(n)), test::mean_bound(1.01, n));
  EXPECT_LT(std::abs(later / double(m)), test::mean_bound(1.01, m));
}

/// How far the deepest of the four neighbours lies behind; infinite before the background.
double step_behind(const DepthImage& depth, int x, int y) {
  double step = 0.0;
  for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    const int raw = depth.at(x + dx, y + dy);
    if (raw == kNoReturn) return std::numeric_limits<double>::infinity();
    step = std::max(step, (raw - int(depth.at(x, y))) * kDepthUnit);
  }
  return step;
}

struct MixedCount {
  std::size_t silhouette = 0, mixed = 0, elsewhere = 0, beyond_reach = 0;
  double part_sum = 0.0;  ///< of the reach, over mixed pixels before the background
  std::size_t parts = 0;
};

/// Two objects behind each other, so that there are silhouettes before both kinds of background.
MixedCount count_mixed(double share, int frames) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = frames;
  const std::vector<TriangleMesh> meshes{test::box_mesh({-0.02, 0, -0.08}, {0.02, 0.1, -0.06}),
                                         test::box_mesh({-0.1, 0, 0}, {0.1, 0.2, 0.02})};
  const VirtualScan truth = scan_of(meshes, o);
  o.measure.mixed_pixels = share;
  const VirtualScan mixed = scan_of(meshes, o);
  MixedCount count;
  for (std::size_t i = 0; i < truth.frames().size(); ++i) {
    const DepthImage a = depth_of(truth, i), b = depth_of(mixed, i);
    for (int y = 1; y + 1 < a.height; ++y) {
      for (int x = 1; x + 1 < a.width; ++x) {
        if (a.at(x, y) == kNoReturn) {
          count.elsewhere += b.at(x, y) != kNoReturn ? 1 : 0;
          continue;
        }
        const double step = step_behind(a, x, y);
        if (std::abs(step - kSilhouetteStep_m) < 2.0 * kDepthUnit) continue;
        const double moved = (int(b.at(x, y)) - int(a.at(x, y))) * kDepthUnit;
        const double reach = std::min(o.measure.mixed_reach_m, step);
        if (step < kSilhouetteStep_m) {
          count.elsewhere += moved != 0.0 ? 1 : 0;
          continue;
        }
        ++count.silhouette;
        count.beyond_reach += moved < 0.0 || moved > reach + 2.0 * kDepthUnit ? 1 : 0;
        if (moved == 0.0) continue;
        ++count.mixed;
        count.part_sum += moved / reach;
        ++count.parts;
      }
    }
  }
  return count;
}

TEST(MixedPixels, AreTheAskedShareOfTheSilhouetteAndNothingElse) {
  for (const double share : {0.2, 0.5}) {
    const MixedCount count = count_mixed(share, 60);
    ASSERT_GT(count.silhouette, 10000u);
    EXPECT_EQ(count.elsewhere, 0u);
    EXPECT_EQ(count.beyond_reach, 0u);
    // One in 200 to 1600 moves by less than half a step of the image and does not show.
    EXPECT_NEAR(double(count.mixed) / double(count.silhouette), share,
                test::mean_bound(std::sqrt(share * (1.0 - share)), count.silhouette) + 0.002);
  }
}

TEST(MixedPixels, LieUniformlyBetweenTheEdgeAndTheReach) {
  for (const double share : {0.3, 1.0}) {
    const MixedCount count = count_mixed(share, 60);
    EXPECT_NEAR(count.part_sum / double(count.parts), 0.5,
                test::mean_bound(std::sqrt(1.0 / 12.0), count.parts) + 0.002);
    EXPECT_NEAR(double(count.mixed) / double(count.silhouette), share, share < 1.0 ? 0.03 : 0.005);
  }
}

TEST(MixedPixels, LeaveTheSlantOfThePlatterAlone) {
  VirtualScanOptions o = noiseless();
  o.platter.visible = true;
  o.scanners[0].placement.aim_height_m = 0.0;
  o.scanners[0].placement.elevation_rad =
      4.0 * kPi / 180.0;  // neighbouring rows are more than 2 cm apart
  const DepthImage truth = depth_of(scan_of({}, o), 0);
  o.measure.mixed_pixels = 1.0;
  const DepthImage mixed = depth_of(scan_of({}, o), 0);
  std::size_t inner = 0;
  for (int y = 1; y + 1 < truth.height; ++y) {
    for (int x = 1; x + 1 < truth.width; ++x) {
      if (truth.at(x, y) == kNoReturn || std::isinf(step_behind(truth, x, y))) continue;
      ASSERT_EQ(truth.at(x, y), mixed.at(x, y));
      inner += step_behind(truth, x, y) > kSilhouetteStep_m ? 1 : 0;
    }
  }
  EXPECT_GT(inner, 20u);
}

TEST(VirtualScan, ColoursThePixelsThatSeeSomething) {
  VirtualScanOptions o = noiseless();
  o.record.color = true;
  TriangleMesh box = test::box_mesh({-0.05, 0, -0.05}, {0.05, 0.1, 0.05});
  box.colors.assign(8, Rgb{200, 0, 0});
  const VirtualScan scan = scan_of({box}, o);
  const Frame frame = *scan.read(0);
  ASSERT_EQ(frame.color.width, frame.depth.width);
  for (std::size_t k = 0; k < frame.depth.pixels.size(); ++k) {
    const Rgb c = frame.color.pixels[k];
    ASSERT_EQ(frame.depth.pixels[k] != kNoReturn, c.r > 60 && c.g == 0);
  }
}

TEST(VirtualScan, IsEmptyWhenThereIsNothingToSee) {
  const VirtualScan scan = scan_of({TriangleMesh()}, noiseless());
  for (const auto raw : depth_of(scan, 0).pixels) ASSERT_EQ(raw, kNoReturn);
}

TEST(VirtualScan, WorksFromInsideAnObject) {
  const VirtualScan scan = scan_of({test::sphere_mesh(Vec3d::Zero(), 2.0, 60)}, noiseless());
  for (const auto raw : depth_of(scan, 0).pixels) ASSERT_NE(raw, kNoReturn);
}

TEST(VirtualScan, FailsForAFrameThatIsNotThere) {
  const VirtualScan scan = scan_of({}, noiseless());
  EXPECT_EQ(scan.read(8).error().code, ErrorCode::kNotFound);
}

TEST(VirtualScanOptionsTest, RefusesValuesOutsideTheirRange) {
  const auto refused = [](const VirtualScanOptions& o, const std::string& name) {
    const auto scan = VirtualScan::create({}, o);
    return !scan && scan.error().code == ErrorCode::kInvalidOption &&
           scan.error().message.find(name) != std::string::npos;
  };
  VirtualScanOptions o = test::plain_scan();
  o.motion.frames = 0;
  EXPECT_TRUE(refused(o, "frames = 0"));
  o = test::plain_scan();
  o.scanners[0].placement.distance_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(refused(o, "distance"));
  o = test::plain_scan();
  o.measure.mixed_pixels = 1.5;
  EXPECT_TRUE(refused(o, "mixed-pixels = 1.5"));
  o = test::plain_scan();
  o.measure.noise = "loud";
  EXPECT_TRUE(refused(o, "noise = loud"));
}

TEST(VirtualScanOptionsTest, RefusesIntrinsicsThatMakeNoSense) {
  VirtualScanOptions o = test::plain_scan();
  o.scanners[0].model.camera = CameraIntrinsics();
  EXPECT_FALSE(VirtualScan::create({}, o));
}

TEST(VirtualScanOptionsTest, RefusesAScanWithoutScanners) {
  VirtualScanOptions o = test::plain_scan();
  o.scanners.clear();
  const auto scan = VirtualScan::create({}, o);
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().code, ErrorCode::kInvalidOption);
}

/// A tall triangle with a texture: red to the left of u = 1/2, blue to the right of it.
TriangleMesh textured_wall() {
  TriangleMesh mesh;
  mesh.vertices = {{-0.2f, 0.0f, 0.0f}, {0.0f, 0.4f, 0.0f}, {0.2f, 0.0f, 0.0f}};
  mesh.triangles = {{0, 1, 2}};
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(64, 64, Rgb{200, 20, 20});
  for (int y = 0; y < 64; ++y)
    for (int x = 32; x < 64; ++x) texture->image.at(x, y) = {20, 20, 200};
  texture->corners.push_back({Eigen::Vector2f(0.1f, 0.9f), {0.5f, 0.1f}, {0.9f, 0.9f}});
  mesh.texture = std::move(texture);
  return mesh;
}

TEST(ColourCamera, SeesTheTextureFromItsOwnPlaceAndTheHeaderSaysWhereItIs) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = 1;
  o.record.color = true;
  o.color_camera.width = 160;
  o.color_camera.pan_rad = 0.02;
  const VirtualScan scan = scan_of({textured_wall()}, o);
  const SensorInfo& sensor = scan.header().sensors[0];
  ASSERT_TRUE(sensor.color_intrinsics);
  EXPECT_EQ(sensor.color_intrinsics->height, 90);
  const auto frame = scan.read(0);
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->color.width, 160);
  for (const double side : {-0.02, 0.02}) {
    const Vec3d p = scan.T_table_sensor(0).inverse() * Vec3d(side, 0.1, 0.0);
    const Eigen::Vector2d at = sensor.color_intrinsics->project(sensor.T_color_sensor * p);
    const Rgb seen = frame->color.at(int(std::lround(at.x())), int(std::lround(at.y())));
    const Rgb is = side < 0.0 ? Rgb{200, 20, 20} : Rgb{20, 20, 200};
    EXPECT_NEAR(seen.r, is.r, 1) << side;
    EXPECT_NEAR(seen.b, is.b, 1) << side;
  }
}

TEST(ColourCamera, DriftsFromFrameToFrameAndIsGivenInTheWrongPlaceOnlyIfAsked) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = 3;
  o.motion.turns = 0.01;
  o.record.color = true;
  o.color_camera.width = 80;
  const auto sum_of = [](const VirtualScan& scan, std::size_t i) {
    double sum = 0.0;
    const Frame frame = scan.read(i).value();
    for (const Rgb c : frame.color.pixels) sum += c.r + c.g + c.b;
    return sum;
  };
  const VirtualScan steady = scan_of({textured_wall()}, o);
  EXPECT_NEAR(sum_of(steady, 0) / sum_of(steady, 2), 1.0, 0.01);
  o.color_camera.drift = 0.3;
  o.color_camera.given_turn_rad = 0.01;
  o.color_camera.given_shift_m = 0.005;
  const VirtualScan drifting = scan_of({textured_wall()}, o);
  EXPECT_GT(std::abs(sum_of(drifting, 0) / sum_of(drifting, 2) - 1.0) +
                std::abs(sum_of(drifting, 0) / sum_of(drifting, 1) - 1.0),
            0.02);
  const Pose error = drifting.header().sensors[0].T_color_sensor *
                     steady.header().sensors[0].T_color_sensor.inverse();
  EXPECT_NEAR(Eigen::AngleAxisd(error.linear()).angle(), 0.01, 1e-6);
  EXPECT_NEAR(error.translation().norm(), 0.005, 1e-4);
}

TEST(ColourCamera, ThatIsLateSeesTheObjectAsItIsThen) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = 5;
  o.motion.turns = 0.05;
  o.record.color = true;
  o.color_camera.width = 80;
  const VirtualScan in_step = scan_of({textured_wall()}, o);
  o.color_camera.delay_s = 1.0 / o.motion.fps;
  const VirtualScan late = scan_of({textured_wall()}, o);
  EXPECT_EQ(late.read(1)->color.pixels, in_step.read(2)->color.pixels);
  EXPECT_NE(late.read(1)->color.pixels, in_step.read(1)->color.pixels);
  EXPECT_EQ(late.read(1)->depth.pixels, in_step.read(1)->depth.pixels);
}

TEST(ColourCamera, JittersByAsMuchAsAskedForAboutItsDelay) {
  ColorCameraOptions o;
  o.delay_s = 0.01;
  o.jitter_s = 0.004;
  double least = 1.0, most = -1.0;
  for (std::uint64_t key = 0; key < 1000; ++key) {
    const double late = late_s(o, key);
    least = std::min(least, late), most = std::max(most, late);
  }
  EXPECT_NEAR(least, 0.006, 1e-4);
  EXPECT_NEAR(most, 0.014, 1e-4);
}

TEST(ColourCamera, ItsNoiseIsAsWideAsAskedForAndColoursAreThoseOfTheMeshWithout) {
  VirtualScanOptions o = noiseless();
  o.motion.frames = 1;
  o.record.color = true;
  o.color_camera.width = 320;
  const Frame clean = scan_of({textured_wall()}, o).read(0).value();
  o.color_camera.noise = 4.0;
  const Frame noisy = scan_of({textured_wall()}, o).read(0).value();
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < clean.color.pixels.size(); ++i) {
    const Rgb a = clean.color.pixels[i], b = noisy.color.pixels[i];
    if (a != Rgb{200, 20, 20} && a != Rgb{20, 20, 200}) continue;
    for (const int d : {b.r - a.r, b.g - a.g, b.b - a.b})
      n += 1.0, sum += d, squares += double(d) * d;
  }
  ASSERT_GT(n, 3000.0);
  EXPECT_NEAR(sum / n, 0.0, 0.2);
  EXPECT_NEAR(std::sqrt(squares / n), 4.0, 0.2);
}

}  // namespace
}  // namespace turnscan
