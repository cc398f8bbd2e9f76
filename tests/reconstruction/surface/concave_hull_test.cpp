#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <tests/support/temp_folder.hpp>
#include <thread>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/surface/concave_hull.hpp>
#include <turnscan/reconstruction/surface/hull_bytes.hpp>

namespace turnscan::surface {
namespace {

using ::testing::HasSubstr;
using turnscan::testing::TempFolder;

/// A folder with a script in the helper program's place, which is looked for there meanwhile.
class FakeHelper {
 public:
  explicit FakeHelper(const std::string& script) {
    const auto program = folder_.put(kConcaveHullProgram, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ::setenv("TURNSCAN_LIBEXEC", folder_.path().c_str(), 1);
  }
  ~FakeHelper() { ::unsetenv("TURNSCAN_LIBEXEC"); }
  FakeHelper(const FakeHelper&) = delete;
  FakeHelper& operator=(const FakeHelper&) = delete;

 private:
  TempFolder folder_;
};

PointCloud ball(std::size_t n, double radius) {
  PointCloud cloud;
  for (std::uint64_t i = 0; cloud.size() < n; ++i) {
    const Vec3d p(standard_normal(hash_key(1, i, 0)), standard_normal(hash_key(1, i, 1)),
                  standard_normal(hash_key(1, i, 2)));
    cloud.points.push_back((radius * p.normalized()).cast<float>());
  }
  return cloud;
}

Result<TriangleMesh> hull(const RunContext& context = RunContext()) {
  return concave_hull(ball(100, 0.05), 0.02, context);
}

TEST(ConcaveHull, HasVerticesThatArePointsHoweverFarFromTheOrigin) {
  PointCloud points = ball(4000, 0.05);
  for (Vec3f& p : points.points) p += Vec3f(2.0f, 0.0f, 0.0f);
  const auto mesh = concave_hull(points, 0.006, RunContext());
  ASSERT_TRUE(mesh) << mesh.error().text();
  EXPECT_GT(mesh->triangles.size(), 4000u);
  for (const Vec3f& v : mesh->vertices) EXPECT_NEAR((v - Vec3f(2, 0, 0)).norm(), 0.05f, 1e-5f);
}

TEST(ConcaveHull, GivesTheSameBytesOnEveryRun) {
  const auto a = hull(), b = hull();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->vertices, b->vertices);
  EXPECT_EQ(a->triangles, b->triangles);
}

TEST(ConcaveHull, RefusesAHandfulOfPoints) {
  EXPECT_EQ(concave_hull(ball(9, 0.05), 0.02, RunContext()).error().code, ErrorCode::kTooFewPoints);
}

TEST(ConcaveHull, ThatAlphaLeavesNothingOfIsAnError) {
  const auto mesh = concave_hull(ball(100, 0.05), 1e-5, RunContext());
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kLibrary);
  EXPECT_THAT(mesh.error().message, HasSubstr("concave hull: the result has no triangles"));
}

TEST(ConcaveHull, KeepsTheSentenceAndTheCodeOfAFailure) {
  const FakeHelper helper("echo 'library: no luck' >&2; exit 1");
  const auto mesh = hull();
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kLibrary);
  EXPECT_EQ(mesh.error().message, "concave hull: no luck");
}

TEST(ConcaveHull, ReportsAnEndWithoutAWordAsAnError) {
  const FakeHelper helper("exit 7");
  EXPECT_THAT(hull().error().message, HasSubstr("ended with status 7"));
}

TEST(ConcaveHull, ReportsACrashAsAnError) {
  const FakeHelper helper("kill -SEGV $$");
  const auto mesh = hull();
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kLibrary);
  EXPECT_THAT(mesh.error().message, HasSubstr("crashed with signal 11"));
}

TEST(ConcaveHull, RefusesAnAnswerThatIsNoMesh) {
  const FakeHelper helper("cat");
  EXPECT_THAT(hull().error().message, HasSubstr("cannot be read"));
}

TEST(ConcaveHull, IsEndedByCancelling) {
  const FakeHelper helper("sleep 3600");
  const RunContext context;
  std::thread canceller([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    context.cancel();
  });
  const auto mesh = hull(context);
  canceller.join();
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kCancelled);
}

TEST(ConcaveHull, SaysWhereItsProgramIsMissing) {
  const TempFolder folder;
  ::setenv("TURNSCAN_LIBEXEC", folder.path().c_str(), 1);
  const auto mesh = hull();
  ::unsetenv("TURNSCAN_LIBEXEC");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().code, ErrorCode::kMissingData);
  EXPECT_THAT(mesh.error().message, HasSubstr("turnscan-concave-hull"));
  EXPECT_THAT(mesh.error().message, HasSubstr("TURNSCAN_LIBEXEC"));
}

TEST(HullBytes, BringBackMegabytes) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 500000; ++i) mesh.vertices.emplace_back(float(i), 1.0f, -2.0f);
  for (std::uint32_t i = 0; i + 2 < 500000; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  const auto back = mesh_from_bytes(bytes_of_mesh(mesh));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->vertices, mesh.vertices);
  EXPECT_EQ(back->triangles, mesh.triangles);
}

TEST(HullBytes, ThatAreNoMeshAreRefused) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  const std::string bytes = bytes_of_mesh(mesh);
  EXPECT_TRUE(mesh_from_bytes(bytes));
  EXPECT_FALSE(mesh_from_bytes(""));
  EXPECT_FALSE(mesh_from_bytes(bytes.substr(0, bytes.size() - 1)));
  EXPECT_FALSE(mesh_from_bytes(bytes + "x"));
  mesh.triangles = {{0, 1, 3}};
  EXPECT_FALSE(mesh_from_bytes(bytes_of_mesh(mesh)));
  EXPECT_FALSE(points_from_bytes("abc"));
}

}  // namespace
}  // namespace turnscan::surface
