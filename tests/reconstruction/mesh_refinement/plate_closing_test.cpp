#include <gtest/gtest.h>

#include <cmath>
#include <tests/reconstruction/mesh_refinement/lens_mesh.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/reconstruction/mesh_refinement/plate_closing.hpp>

namespace turnscan::mesh_refinement {
namespace {

using testing::kSheetAround;
using testing::kSheetRing_m;
using testing::kSheetRings;
using testing::lens;

/// 1 where the distance from the axis is at least so much.
std::vector<float> measured_beyond(const TriangleMesh& mesh, float radius_m) {
  std::vector<float> support;
  for (const Vec3f& p : mesh.vertices)
    support.push_back(std::hypot(p.x(), p.z()) >= radius_m ? 1.0f : 0.0f);
  return support;
}

constexpr float kCap_m = 0.0145f;
constexpr float kBallRadius_m = 0.04f;

float ball_height(float r) { return std::sqrt(kBallRadius_m * kBallRadius_m - r * r) - 0.02f; }

/// A ball's upper and lower part, the caps cut off flat where nothing was measured.
TriangleMesh flat_capped() {
  return lens([](float r) { return ball_height(std::max(r, kCap_m)); });
}

PlateClosing anywhere() {
  PlateClosing closing;
  closing.unseen = [](const Vec3f&) { return true; };
  return closing;
}

TEST(PlateClosing, GoesOnAsWhatIsAroundItDoes) {
  TriangleMesh mesh = flat_capped();
  ASSERT_TRUE(close_as_plate(mesh, measured_beyond(mesh, kCap_m), anywhere(), {}));
  const float was = ball_height(0.0f) - ball_height(kCap_m);
  EXPECT_NEAR(mesh.vertices[0].y(), ball_height(0.0f), 0.25f * was);
}

TEST(PlateClosing, LeavesWhatWasMeasuredAlone) {
  const TriangleMesh before = flat_capped();
  TriangleMesh mesh = before;
  const std::vector<float> support = measured_beyond(mesh, kCap_m);
  ASSERT_TRUE(close_as_plate(mesh, support, anywhere(), {}));
  for (std::size_t v = 0; v < support.size(); ++v)
    if (support[v] > 0.0f) {
      EXPECT_EQ(mesh.vertices[v], before.vertices[v]);
    }
  TriangleMesh all = before;
  ASSERT_TRUE(close_as_plate(all, std::vector<float>(support.size(), 1.0f), anywhere(), {}));
  EXPECT_EQ(all.vertices, before.vertices);
}

TEST(PlateClosing, DoesNotGoWhereAViewSawNothing) {
  TriangleMesh mesh = flat_capped();
  PlateClosing closing = anywhere();
  closing.cell_m = 0.0004;
  const float limit = ball_height(kCap_m) + 0.001f;
  closing.unseen = [&](const Vec3f& p) { return p.y() < limit; };
  ASSERT_TRUE(close_as_plate(mesh, measured_beyond(mesh, kCap_m), closing, {}));
  float highest = 0.0f;
  for (const Vec3f& p : mesh.vertices)
    if (std::hypot(p.x(), p.z()) < kCap_m) highest = std::max(highest, p.y());
  EXPECT_LT(highest, limit + 0.0002f);
  EXPECT_GT(highest, limit - 0.0004f);
}

TEST(PlateClosing, LeavesWhatStandsOnThePlatter) {
  const TriangleMesh before = flat_capped();
  TriangleMesh mesh = before;
  PlateClosing closing = anywhere();
  closing.stands = [](const Vec3f& p) { return p.y() < 0.0f; };
  ASSERT_TRUE(close_as_plate(mesh, measured_beyond(mesh, kCap_m), closing, {}));
  for (std::size_t v = 0; v < before.vertices.size(); ++v)
    if (before.vertices[v].y() < 0.0f) {
      EXPECT_EQ(mesh.vertices[v], before.vertices[v]);
    }
  EXPECT_GT(mesh.vertices[0].y(), before.vertices[0].y());
}

/// A ball, its caps cut off, whose lower cap lies some millimetres above y = 0.
TriangleMesh hovering() {
  TriangleMesh mesh = flat_capped();
  for (Vec3f& p : mesh.vertices) p.y() += 0.021f;
  return mesh;
}

float lowest(const TriangleMesh& mesh) {
  float out = 1.0f;
  for (const Vec3f& p : mesh.vertices) out = std::min(out, p.y());
  return out;
}

TEST(PlateClosing, PutsWhatWouldTipOverOntoThePlatter) {
  TriangleMesh free = hovering(), resting = free, high = free;
  PlateClosing closing = anywhere();
  closing.cell_m = 0.0005;
  const std::vector<float> support = measured_beyond(free, kCap_m);
  ASSERT_TRUE(close_as_plate(free, support, closing, {}));
  ASSERT_GT(lowest(free), 0.0009f);
  closing.rests_below_m = 0.008;
  ASSERT_TRUE(close_as_plate(resting, support, closing, {}));
  EXPECT_NEAR(lowest(resting), 0.0f, 1e-6f);
  closing.rests_below_m = 0.5 * lowest(free);
  ASSERT_TRUE(close_as_plate(high, support, closing, {}));
  EXPECT_EQ(high.vertices, free.vertices);
}

TEST(PlateClosing, LeavesWhatStandsByItselfWhereItIs) {
  TriangleMesh free = hovering();
  const std::vector<float> support = measured_beyond(free, kCap_m);
  // Three feet around the middle.
  const std::size_t half = free.vertices.size() / 2, ring = half + 1 + 28 * kSheetAround;
  for (const std::size_t around : {0, 32, 64}) free.vertices[ring + around].y() = 0.0f;
  TriangleMesh resting = free;
  PlateClosing closing = anywhere();
  closing.cell_m = 0.0005;
  ASSERT_TRUE(close_as_plate(free, support, closing, {}));
  closing.rests_below_m = 0.008;
  ASSERT_TRUE(close_as_plate(resting, support, closing, {}));
  EXPECT_EQ(resting.vertices, free.vertices);
}

TEST(PlateClosing, DoesNotPassThroughOtherSurface) {
  // Both sides lead inwards, and as plates they would meet beyond each other.
  const auto hollow = [](float r) { return 0.0006f + 0.5f * (std::max(r, kCap_m) - kCap_m); };
  TriangleMesh mesh = lens(hollow);
  EXPECT_EQ(self_intersections(mesh).edges, 0u);
  PlateClosing closing = anywhere();
  closing.cell_m = 0.0005;
  ASSERT_TRUE(close_as_plate(mesh, measured_beyond(mesh, kCap_m), closing, {}));
  EXPECT_EQ(self_intersections(mesh).edges, 0u);
  EXPECT_GT(mesh.vertices[0].y(), 0.0f);
}

TEST(PlateClosing, OnlyWhatWouldPassThroughOtherSurfaceStaysBack) {
  TriangleMesh mesh = flat_capped();
  const float flat = ball_height(kCap_m);
  const auto first = std::uint32_t(mesh.vertices.size());
  for (const Vec3f& p : {Vec3f(0.0f, 0.0003f, 0.0f), Vec3f(0.002f, 0.0003f, 0.0f),
                         Vec3f(0.0f, 0.0003f, 0.002f), Vec3f(0.0005f, 0.002f, 0.0005f)})
    mesh.vertices.push_back(p + Vec3f(0.01f, flat, 0.0f));
  for (const auto& [a, b, c] : {std::array{0u, 1u, 2u}, {0u, 3u, 1u}, {1u, 3u, 2u}, {2u, 3u, 0u}})
    mesh.triangles.push_back({first + a, first + b, first + c});
  PlateClosing closing = anywhere();
  closing.cell_m = 0.0002;
  std::vector<float> support = measured_beyond(mesh, kCap_m);
  std::fill(support.begin() + first, support.end(), 1.0f);
  ASSERT_TRUE(close_as_plate(mesh, support, closing, {}));
  EXPECT_EQ(self_intersections(mesh).edges, 0u);
  EXPECT_GT(mesh.vertices[0].y(), flat + 0.7f * (ball_height(0.0f) - flat));
}

TEST(PlateClosing, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  TriangleMesh one = flat_capped(), two = one, none = one;
  const std::vector<float> support = measured_beyond(one, kCap_m);
  set_thread_count(1);
  ASSERT_TRUE(close_as_plate(one, support, anywhere(), {}));
  set_thread_count(0);
  ASSERT_TRUE(close_as_plate(two, support, anywhere(), {}));
  EXPECT_EQ(one.vertices, two.vertices);
  const RunContext context;
  context.cancel();
  const auto result = close_as_plate(none, support, anywhere(), context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
