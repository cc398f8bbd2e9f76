#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/reconstruction/quality/vertex_visibility.hpp>

namespace turnscan::quality {
namespace {

constexpr int kSide = 40;
constexpr double kAway_m = 0.5, kHalf_m = 0.05;

/// A cube about the origin.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(float(c & 1 ? kHalf_m : -kHalf_m), float(c & 2 ? kHalf_m : -kHalf_m),
                               float(c & 4 ? kHalf_m : -kHalf_m));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Parallel rays onto the cube from a heading, which sees the corners' depth wherever it looks.
views::DepthView view_from(double heading_rad) {
  views::DepthView view;
  const Vec3d forward(-std::cos(heading_rad), 0.0, -std::sin(heading_rad));
  const Vec3d down(0.0, -1.0, 0.0), right = down.cross(forward);
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), down.transpose(), forward.transpose();
  view.rotation = rotation.cast<float>();
  view.translation = Vec3f(0.0f, 0.0f, float(kAway_m));
  view.parallel = true;
  view.fx = view.fy = 200.0f, view.cx = view.cy = 0.5f * kSide;
  view.width = view.height = kSide;
  view.unit_m = 1e-4f;
  const double nearest = kAway_m - std::numbers::sqrt2 * kHalf_m;
  view.pixels.assign(kSide * kSide,
                     views::DepthView::pack(std::uint32_t(nearest / 1e-4), false, 0));
  return view;
}

TEST(VertexVisibility, CountsTheFramesThatMeasuredAVertexAndTheirDirections) {
  // Onto the edge between the sides +x and +z, from half a degree to either side of it.
  std::vector<views::DepthView> views;
  for (const double degrees : {44.5, 45.0, 45.5})
    views.push_back(view_from(degrees * kRadiansPerDegree));
  const auto seen = vertex_visibility(cube(), views, 0.001, {});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->frames[5], 3) << "on the edge that the depth is of";
  EXPECT_EQ(seen->directions[5], 1);
  EXPECT_EQ(seen->frames[0], 0) << "on the far side";
  EXPECT_EQ(seen->frames[1], 0) << "its depth is another";
  EXPECT_EQ(seen->directions[0], 0);
}

TEST(VertexVisibility, LooksAtSomeOfManyViewsAndLetsThemStandForTheOthers) {
  const std::vector<views::DepthView> views(600, view_from(45.0 * kRadiansPerDegree));
  const auto seen = vertex_visibility(cube(), views, 0.001, {});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->frames[5], 600);
  EXPECT_EQ(seen->directions[5], 1);
}

TEST(VertexVisibility, SaysZeroWithoutViewsAndStopsWhenItIsCancelled) {
  const auto seen = vertex_visibility(cube(), {}, 0.001, {});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->frames, std::vector<std::uint16_t>(8, 0));
  RunContext cancelled;
  cancelled.cancel();
  const std::vector<views::DepthView> one{view_from(0.0)};
  EXPECT_EQ(vertex_visibility(cube(), one, 0.001, cancelled).error().code, ErrorCode::kCancelled);
}

TEST(WithoutReturn, IsWhatHalfOfTheViewsThatItFacesLookedAtInVain) {
  const auto looked_at = [](std::size_t no_return, std::uint32_t word, std::uint8_t asked) {
    std::vector<views::DepthView> views(6, view_from(45.0 * kRadiansPerDegree));
    for (std::size_t v = 0; v < no_return; ++v) views[v].pixels.assign(kSide * kSide, word);
    return *without_return(cube(), views, std::vector<std::uint8_t>(8, asked), {});
  };
  using enum NoReturn;
  const std::vector<NoReturn> none(8, kNone);
  const std::vector<NoReturn> two_corners{kNone, kNone,    kNone, kNone,
                                          kNone, kNothing, kNone, kNothing};
  EXPECT_EQ(looked_at(3, 0, 1), two_corners) << "of the edge that faces them";
  EXPECT_EQ(looked_at(2, 0, 1), none) << "most had returns there";
  EXPECT_EQ(looked_at(3, views::DepthView::pack(0, false, 9000), 1), none) << "seen to be empty";
  EXPECT_EQ(looked_at(3, 0, 0), none) << "not asked";
}

TEST(WithoutReturn, SaysWhatWouldBeNearerThanAnythingThatWasMeasured) {
  std::vector<views::DepthView> views(6, view_from(45.0 * kRadiansPerDegree));
  for (views::DepthView& view : views) view.pixels.assign(kSide * kSide, 0);
  const auto corner = [&](std::uint16_t nearest) {
    for (views::DepthView& view : views) view.nearest = nearest;
    return without_return(cube(), views, std::vector<std::uint8_t>(8, 1), {})->at(5);
  };
  EXPECT_EQ(corner(1), NoReturn::kNothing);
  EXPECT_EQ(corner(65535), NoReturn::kTooNear);
  EXPECT_EQ(corner(0), NoReturn::kNothing) << "nothing is known of what was measured";
}

}  // namespace
}  // namespace turnscan::quality
