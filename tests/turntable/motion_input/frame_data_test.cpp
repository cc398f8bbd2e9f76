#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan {
namespace {

/// Share of the doll's pixels that lie within its outline, before a Kinect v2.
double inner_share(double distance_m, const std::string& noise) {
  ScannerParameters parameters;
  parameters.columns = 512;
  parameters.rows = 424;
  parameters.fy = 365.5;
  parameters.near_m = 0.3;
  parameters.noise.physics = SensorPhysics::kKinectV2;
  VirtualScanOptions options;
  VirtualScanner scanner{scanner_model(parameters).value(), {}};
  scanner.placement.distance_m = distance_m;
  scanner.placement.elevation_rad = 20.0 * kRadiansPerDegree;
  scanner.placement.aim_height_m = 0.07;
  options.scanners.push_back(scanner);
  options.motion.frames = 5;
  options.measure.noise = noise;
  const VirtualScan scan = VirtualScan::create({*builtin_object("doll")}, options).value();
  const auto data = motion::load_motion(scan, {}, {});
  EXPECT_TRUE(data.has_value());
  return data ? data->inner_share : 0.0;
}

TEST(MotionInput, OfAFilteringSensorTheOutlinesAreLeftOutWhichIsMoreOfAThingFarAway) {
  const double near = inner_share(0.6, "physics"), far = inner_share(1.3, "physics");
  EXPECT_GT(near, far + 0.1);
  EXPECT_LT(near, 0.9);
  EXPECT_GT(far, 0.1);
}

TEST(MotionInput, OfASharpSensorAllPixelsAreKept) {
  EXPECT_EQ(inner_share(0.9, "gaussian:1.5mm"), 1.0);
}

}  // namespace
}  // namespace turnscan
