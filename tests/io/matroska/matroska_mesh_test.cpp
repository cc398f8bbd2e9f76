// The mesh of a recording of an Azure Kinect, written by libmatroska. Apart from the other tests of
// such recordings, which need no reconstruction.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/virtual_scan.hpp>

#include "tests/io/matroska/k4a_take.hpp"
#include "tests/simulator/shapes.hpp"
#include "tests/support/memory_sequence.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::K4aTake;
using testing::TempFolder;

std::unique_ptr<FrameSequence> opened(const TempFolder& folder, const K4aTake& take,
                                      const ImportOptions& options = {}) {
  take.write(folder / "take.mkv");
  auto sequence = open_foreign(folder / "take.mkv", options);
  EXPECT_TRUE(sequence) << (sequence ? "" : sequence.error().text());
  return sequence ? std::move(*sequence) : nullptr;
}

/// A box on a turntable as an Azure Kinect sees it, narrow and binned, with one frame dropped: the
/// scan, and the same without its own word on where the table is.
struct BoxScan {
  testing::MemorySequence native;
  K4aTake take;
};

BoxScan box_scan(const CameraIntrinsics& camera, ImportOptions& options) {
  ScannerParameters parameters;
  parameters.columns = camera.width, parameters.rows = camera.height;
  parameters.fy = camera.fy;
  parameters.near_m = 0.1;
  parameters.depth_unit_m = 1e-3;
  ScannerModel model = *scanner_model(parameters);
  model.camera = camera;
  VirtualScanOptions scanning;
  scanning.scanners = {{model, {}}};
  scanning.scanners[0].placement.aim_height_m = 0.05;
  scanning.motion.frames = 12;
  const VirtualScan scan =
      *VirtualScan::create({test::box_mesh({-0.05, 0.0, -0.04}, {0.05, 0.1, 0.04})}, scanning);
  const TurntableInfo& table = *scan.header().turntable;
  const auto meters = [](const Vec3d& v) {
    return fmt::format("{}m,{}m,{}m", v.x(), v.y(), v.z());
  };
  options.turntable_axis = fmt::format("{},{},{}", table.axis.x(), table.axis.y(), table.axis.z());
  options.turntable_center = meters(table.center_m);
  options.turntable_radius_m = 0.1;
  options.speed_rad_s = table.speed_rad_s;
  BoxScan out;
  for (std::size_t i = 0; i < scan.frames().size(); ++i) {
    Frame frame = *scan.read(i);
    frame.info.T_table_sensor.reset();
    frame.info.angle_rad.reset();
    // The recorder's clock counts microseconds.
    const auto time_us = std::llround(frame.info.time_s * 1e6);
    frame.info.time_s = double(time_us) * 1e3 * 1e-9;
    if (i == 5) {
      frame.info.status = FrameStatus::kDropped;
    } else {
      out.take.add_depth(frame.info.time_s, frame.depth);
    }
    out.native.add(std::move(frame));
  }
  out.take.frame_time_ns = 33333333;
  return out;
}

TEST(MatroskaImport, ReconstructGivesTheMeshOfTheNativeScan) {
  const TempFolder folder;
  K4aTake probe;
  probe.add_depth(0.0, DepthImage(probe.width, probe.height, 1000));
  const CameraIntrinsics camera = opened(folder, probe)->header().sensors[0].intrinsics;
  ASSERT_TRUE(camera.rational());
  ImportOptions options;
  BoxScan scan = box_scan(camera, options);
  const auto sequence = opened(folder, scan.take, options);
  ASSERT_TRUE(sequence);
  scan.native.header_value = sequence->header();
  ASSERT_EQ(sequence->frames().size(), scan.native.frames().size());
  std::size_t returns = 0;
  for (std::size_t i = 0; i < sequence->frames().size(); ++i) {
    const FrameInfo &info = sequence->frames()[i], &expected = scan.native.frames()[i];
    EXPECT_EQ(info.status, expected.status);
    if (info.status == FrameStatus::kDropped) continue;
    EXPECT_EQ(info.time_s, expected.time_s);
    const auto frame = sequence->read(i);
    ASSERT_TRUE(frame) << frame.error().text();
    EXPECT_EQ(frame->depth.pixels, scan.native.data[i].depth.pixels);
    returns += frame->depth.pixels.size() -
               std::size_t(std::count(frame->depth.pixels.begin(), frame->depth.pixels.end(), 0));
  }
  EXPECT_GT(returns, 10000u);
  const auto imported = reconstruct(*sequence, {}, {}, RunContext());
  const auto native = reconstruct(scan.native, {}, {}, RunContext());
  ASSERT_TRUE(imported) << imported.error().text();
  ASSERT_TRUE(native);
  ASSERT_EQ(imported->objects.size(), 1u);
  const TriangleMesh &a = imported->objects[0].mesh, &b = native->objects[0].mesh;
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  // Its size, as far as a few coarse frames show it.
  Vec3f low = a.vertices[0], high = low;
  for (const Vec3f& v : a.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  EXPECT_NEAR(high.y(), 0.1, 0.006);
  EXPECT_NEAR((high - low).x(), 0.1, 0.02);
}

}  // namespace
}  // namespace turnscan
