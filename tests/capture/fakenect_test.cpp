// The driver for the Kinect v1 as it is, on libfreenect's own stand-in for the hardware.

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <turnscan/capture/source/plugins.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

#include "tests/capture/doll_mesh.hpp"
#include "tests/capture/fakenect_dump.hpp"
#include "tests/capture/taking.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::DumpWriter;
using testing::opened;
using testing::TempFolder;
using testing::Variable;

TEST(KinectV1, TheTableRisesAndItsInverseFindsTheNearestValue) {
  const auto table = plugin::KinectV1().table();
  for (std::size_t raw = 401; raw < 1000; ++raw) EXPECT_GT(table[raw], table[raw - 1]);
  EXPECT_EQ(table[2047], 0);
  // The reference plane itself: no shift but the constant one.
  EXPECT_NEAR(plugin::KinectV1().depth_m(801), 1.2, 0.003);
  const auto raw = testing::raw_values();
  for (std::uint32_t depth = 5000; depth < 30000; depth += 7) {
    const std::uint16_t r = raw[depth];
    for (const int other : {r - 1, r + 1})
      EXPECT_LE(std::abs(int(table[r]) - int(depth)),
                std::abs(int(table[std::size_t(other)]) - int(depth)));
  }
  EXPECT_EQ(raw[0], plugin::KinectV1::kNoValue);
}

#ifdef TURNSCAN_FAKENECT

/// fakenect in place of libfreenect, for the rest of the process: the loader takes the library that
/// is there already under that name.
bool load_fakenect() {
  static void* library = dlopen(TURNSCAN_FAKENECT, RTLD_NOW | RTLD_GLOBAL);
  return library != nullptr;
}

constexpr std::uint32_t kFrames = 24;
constexpr double kSpeed_rad_s = 2.0 * std::numbers::pi / 0.8;  // 24 frames a turn, 30 a second

/// The doll as a virtual Kinect sees it, and as it comes through libfreenect. Played once, because
/// fakenect goes through one dump in the life of a process.
struct Freenect : ::testing::Test {
  static void SetUpTestSuite() {
    ASSERT_TRUE(load_fakenect()) << dlerror();
    const TempFolder folder;
    const auto sensor =
        opened("virtual:doll?frames=24&turns=1&fps=30&distance=1m&calibration=true&sensor=" +
               testing::kinect_v1_file(folder.path()).string());
    ASSERT_TRUE(sensor);
    rig = sensor->info();
    direct = testing::run(*sensor).frames;
    DumpWriter dump(folder / "dump");
    // The clock of 32 bits runs over between the frames.
    for (std::uint32_t i = 0; i < kFrames; ++i)
      dump.add(direct[i].depth, 0xffffff00U + 2000000U * i);
    const Variable path("FAKENECT_PATH", (folder / "dump").string());
    const auto source = opened("freenect:0");
    ASSERT_TRUE(source);
    kinect = source->info();
    ASSERT_TRUE(source->start());
    taken = testing::take_all(*source, kFrames).frames;
    if (const auto gone = source->next(20.0, {}); !gone) ending = gone.error();
  }
  static TriangleMesh mesh_of(const std::vector<Frame>& frames, const SourceInfo& sensor) {
    return testing::mesh_of(frames, sensor.header.sensors[0], rig.header, kSpeed_rad_s);
  }
  static inline SourceInfo rig, kinect;
  static inline std::vector<Frame> direct, taken;
  static inline std::optional<Error> ending;
};

TEST_F(Freenect, AVirtualKinectsDumpComesBackBitByBit) {
  EXPECT_TRUE(kinect.live);
  EXPECT_EQ(kinect.identities, std::vector<std::string>{"freenect-kinect-v1-0"});
  const CameraIntrinsics& camera = kinect.header.sensors[0].intrinsics;
  const CameraIntrinsics& truth = rig.header.sensors[0].intrinsics;
  EXPECT_EQ(camera.width, truth.width);
  EXPECT_EQ(camera.fx, truth.fx);
  EXPECT_EQ(camera.cx, truth.cx);
  EXPECT_EQ(kinect.header.sensors[0].depth_unit_m, rig.header.sensors[0].depth_unit_m);
  ASSERT_EQ(taken.size(), kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) {
    EXPECT_EQ(taken[i].depth.pixels, testing::rounded_as_kinect(direct[i].depth).pixels);
    EXPECT_NEAR(taken[i].info.time_s, double(i) / 30.0, 1e-9);
  }
  // A dump that ends is a Kinect that was unplugged.
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->code, ErrorCode::kDeviceLost);
  EXPECT_NE(ending->message.find("cable"), std::string::npos);
}

TEST_F(Freenect, TheDollThroughItIsTheMeshOfTheSameFramesTakenDirectly) {
  ASSERT_EQ(taken.size(), kFrames);
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

TEST(FreenectAddress, OfADeviceThatIsNotThereIsNotFound) {
  ASSERT_TRUE(load_fakenect()) << dlerror();
  const auto source = open_source("freenect:7", {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(open_source("freenect:0?color=yes", {}).error().code, ErrorCode::kInvalidOption);
}

#endif

}  // namespace
}  // namespace turnscan
