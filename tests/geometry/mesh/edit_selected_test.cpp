#include <turnscan/geometry/mesh/edit_selected.hpp>

#include <gtest/gtest.h>

#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

/// The triangles whose middle lies beyond the plane.
Selection beyond(const TriangleMesh& mesh, const Vec3d& normal, double offset) {
  Selection out(mesh.triangles.size());
  for (std::size_t t = 0; t < out.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0f;
    out[t] = normal.dot(middle.cast<double>()) > offset ? 1 : 0;
  }
  return out;
}

/// A ball with a cap taken away at +y and one at -y.
TriangleMesh with_two_holes() {
  const TriangleMesh ball = sphere(0.03, 4);
  auto once = without_selected(ball, beyond(ball, Vec3d::UnitY(), 0.025));
  auto twice = without_selected(*once, beyond(*once, -Vec3d::UnitY(), 0.025));
  return *twice;
}

TEST(EditSelected, DeletesWhatIsSelectedAndNothingElse) {
  const TriangleMesh ball = sphere(0.03, 4);
  const Selection top = beyond(ball, Vec3d::UnitY(), 0.01);
  const auto rest = without_selected(ball, top);
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->triangles.size(), ball.triangles.size() - count_selected(top));
  EXPECT_EQ(count_selected(beyond(*rest, Vec3d::UnitY(), 0.01)), 0u);
  EXPECT_LT(bounds(rest->vertices).max.y(), 0.0125);
  EXPECT_TRUE(without_selected(ball, Selection(ball.triangles.size(), 1))->empty());
  const auto misfit = without_selected(ball, Selection(3, 1));
  ASSERT_FALSE(misfit);
  EXPECT_EQ(misfit.error().code, ErrorCode::kInvalidOption);
}

/// Every place shows the height of the vertex there.
TriangleMesh painted_ball() {
  TriangleMesh ball = sphere(0.03, 4);
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(4, 4, Rgb{1, 2, 3});
  for (const auto& triangle : ball.triangles) {
    auto& corners = texture->corners.emplace_back();
    for (int k = 0; k < 3; ++k)
      corners[std::size_t(k)] = {0.5f, ball.vertices[triangle[std::size_t(k)]].y()};
  }
  ball.texture = std::move(texture);
  return ball;
}

TEST(EditSelected, TheTextureStaysWhereTrianglesOnlyGoOrMove) {
  const TriangleMesh ball = painted_ball();
  const Selection top = beyond(ball, Vec3d::UnitY(), 0.01);
  const auto rest = without_selected(ball, top);
  ASSERT_TRUE(rest && has_texture(*rest));
  for (std::size_t t = 0; t < rest->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(rest->texture->corners[t][k].y(), rest->vertices[rest->triangles[t][k]].y());
  EXPECT_EQ(rest->texture->image.width, 4);
  const auto smoothed = smooth_selected(ball, top, 0.005, {});
  ASSERT_TRUE(smoothed);
  EXPECT_EQ(smoothed->texture, ball.texture);
  EXPECT_EQ(smooth_selected(ball, {}, 0.005, {})->texture, ball.texture);
  EXPECT_FALSE(has_texture(*reduce_selected(ball, {}, 100)));
}

TEST(EditSelected, FillsOnlyTheHoleBesideTheSelection) {
  const TriangleMesh open = with_two_holes();
  const auto upper = fill_selected_holes(open, beyond(open, Vec3d::UnitY(), 0.015), {});
  ASSERT_TRUE(upper) << upper.error().text();
  EXPECT_EQ(upper->holes, 1u);
  EXPECT_GT(bounds(upper->mesh.vertices).max.y(), 0.028);
  EXPECT_GT(check_mesh(upper->mesh).boundary_edges, 0u);  // the lower one
  EXPECT_LT(-bounds(upper->mesh.vertices).min.y(), 0.027);
  const auto both = fill_selected_holes(open, {}, {});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->holes, 2u);
  EXPECT_TRUE(check_mesh(both->mesh).watertight());
  const auto none = fill_selected_holes(open, Selection(open.triangles.size(), 0), {});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->holes, 0u);
  EXPECT_EQ(none->mesh.triangles, open.triangles);
}

TEST(EditSelected, HolesThatTouchEachOtherAtAVertexAreFilled) {
  const TriangleMesh ball = sphere(0.03, 4);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Selection some(ball.triangles.size());
    for (std::size_t t = 0; t < some.size(); ++t) some[t] = random_value(seed, t) > 0.4 ? 1 : 0;
    const auto torn = without_selected(ball, some);
    ASSERT_TRUE(torn);
    ASSERT_FALSE(check_mesh(*torn).manifold);
    const auto filled = fill_selected_holes(*torn, {}, {});
    ASSERT_TRUE(filled) << filled.error().text();
    const MeshReport report = check_mesh(filled->mesh);
    EXPECT_TRUE(report.closed && report.manifold) << report.text();
    // Those beside a selection, of which the triangles are as they were.
    const auto part = fill_selected_holes(*torn, beyond(*torn, Vec3d::UnitY(), 0.01), {});
    ASSERT_TRUE(part) << part.error().text();
    EXPECT_GT(part->holes, 0u);
    EXPECT_LT(part->holes, filled->holes);
  }
}

TEST(EditSelected, SmoothsWithinTheSelectionAndLeavesItsRimAndTheRest) {
  TriangleMesh rough = sphere(0.03, 5);
  for (std::size_t v = 0; v < rough.vertices.size(); ++v)
    rough.vertices[v] *= float(1.0 + 0.004 * random_value(5, v));
  const Selection top = beyond(rough, Vec3d::UnitY(), 0.0);
  const auto made = smooth_selected(rough, top, 0.01, {});
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(made->triangles, rough.triangles);
  Selection elsewhere(rough.vertices.size(), 0);
  for (std::size_t t = 0; t < top.size(); ++t)
    if (top[t] == 0)
      for (const std::uint32_t v : rough.triangles[t]) elsewhere[v] = 1;
  const auto roughness = [](const TriangleMesh& mesh) {
    double sum = 0.0, count = 0.0;
    for (const Vec3f& p : mesh.vertices)
      if (p.y() > 0.005f) {
        sum += std::pow(double(p.norm()) - 0.03, 2);
        count += 1.0;
      }
    return std::sqrt(sum / count);
  };
  for (std::size_t v = 0; v < elsewhere.size(); ++v) {
    if (elsewhere[v] != 0) {
      EXPECT_EQ(made->vertices[v], rough.vertices[v]) << v;
    }
  }
  EXPECT_LT(roughness(*made), 0.4 * roughness(rough));
  EXPECT_FALSE(smooth_selected(rough, top, 0.0, {}));
}

TEST(EditSelected, ReducesWithinTheSelectionAlone) {
  const TriangleMesh ball = sphere(0.03, 4);  // 2048 triangles
  const Selection top = beyond(ball, Vec3d::UnitY(), 0.0);
  const auto whole = reduce_selected(ball, {}, 600);
  ASSERT_TRUE(whole);
  EXPECT_LE(whole->triangles.size(), 600u);
  EXPECT_TRUE(check_mesh(*whole).watertight());
  const auto part = reduce_selected(ball, top, 1500);
  ASSERT_TRUE(part);
  EXPECT_LE(part->triangles.size(), 1520u);
  EXPECT_EQ(count_selected(beyond(*part, -Vec3d::UnitY(), 0.0)),
            count_selected(beyond(ball, -Vec3d::UnitY(), 0.0)));
}

}  // namespace
}  // namespace turnscan
