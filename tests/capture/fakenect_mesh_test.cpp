// The mesh of what came through the driver for the Kinect v1.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <turnscan/geometry/search/closest_point.hpp>

#include "tests/capture/doll_mesh.hpp"
#include "tests/capture/fakenect_doll.hpp"
#include "tests/capture/fakenect_dump.hpp"

#ifdef TURNSCAN_FAKENECT

namespace turnscan {
namespace {

using testing::kFakenectFrames;

constexpr double kSpeed_rad_s = 2.0 * std::numbers::pi / 0.8;  // 24 frames a turn, 30 a second

struct FreenectMesh : testing::FakenectDoll {
  static TriangleMesh mesh_of(const std::vector<Frame>& frames, const SourceInfo& sensor) {
    return testing::mesh_of(frames, sensor.header.sensors[0], rig.header, kSpeed_rad_s);
  }
};

TEST_F(FreenectMesh, OfTheDollThroughTheDriverIsThatOfTheSameFramesTakenDirectly) {
  ASSERT_EQ(taken.size(), kFakenectFrames);
  std::vector<Frame> frames = direct;
  for (Frame& frame : frames) frame.depth = testing::rounded_as_kinect(frame.depth);
  const TriangleMesh mesh = mesh_of(taken, kinect);
  const TriangleMesh same = mesh_of(frames, rig);
  EXPECT_GT(mesh.triangles.size(), 1000u);
  EXPECT_EQ(mesh.triangles, same.triangles);
  ASSERT_EQ(mesh.vertices.size(), same.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_LT((mesh.vertices[i] - same.vertices[i]).norm(), 1e-6f);

  // What the sensor's steps, 2.9 mm at 1 m, take away from the doll.
  const MeshDistance unrounded(mesh_of(direct, rig));
  std::vector<double> distances;
  for (const Vec3f& p : mesh.vertices)
    distances.push_back(unrounded.closest(p.cast<double>()).distance);
  std::sort(distances.begin(), distances.end());
  EXPECT_LT(distances[distances.size() / 2], 0.0005);
  RecordProperty("median_um", int(1e6 * distances[distances.size() / 2]));
}

}  // namespace
}  // namespace turnscan

#endif
