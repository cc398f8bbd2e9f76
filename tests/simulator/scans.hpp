#pragma once
// Virtual scans that the simulator's tests share.

#include <gtest/gtest.h>

#include <turnscan/simulator/virtual_scan.hpp>
#include <utility>
#include <vector>

namespace turnscan::test {

/// The camera of a Kinect v2 without its faults: one eye, any distance.
inline ScannerModel plain_kinect() {
  ScannerParameters p;
  p.name = "kinect";
  p.columns = 512;
  p.rows = 424;
  p.fy = 365.5;
  p.near_m = 0.001;
  p.far_m = 6.5534;
  p.max_incidence_rad = 1.5707963267948966;
  return *scanner_model(p);
}

inline VirtualScanOptions plain_scan() {
  VirtualScanOptions o;
  o.scanners = {{plain_kinect(), {}}};
  o.scanners[0].placement.aim_height_m = 0.09;
  return o;
}

inline VirtualScan scan_of(const std::vector<TriangleMesh>& meshes,
                           const VirtualScanOptions& options) {
  auto scan = VirtualScan::create(meshes, options);
  EXPECT_TRUE(scan) << (scan ? "" : scan.error().text());
  return std::move(*scan);
}

}  // namespace turnscan::test
