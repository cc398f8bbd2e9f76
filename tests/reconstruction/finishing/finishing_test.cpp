#include <gtest/gtest.h>

#include <turnscan/reconstruction/finishing/finishing.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using finishing::finish_objects;

constexpr float kRadius = 0.05f;

/// A ball of which nothing measured the cap above 0.8 radii, nor the specks about two points.
ObjectResult ball(const Vec3d& center = Vec3d::Zero(), double radius = kRadius) {
  ObjectResult out;
  out.mesh = test::sphere(radius, 5, center);
  for (const auto& triangle : out.mesh.triangles) {
    const Vec3f p = (out.mesh.vertices[triangle[0]] - center.cast<float>()) / float(radius);
    const bool unseen =
        p.y() > 0.8f || (p - Vec3f::UnitX()).norm() < 0.05f || (p - Vec3f::UnitZ()).norm() < 0.05f;
    out.evidence.push_back(unseen ? Evidence::kInvented : Evidence::kMeasured);
  }
  for (const Vec3f& p : out.mesh.vertices) out.confidence.push_back(p.x());
  out.check = check_mesh(out.mesh);
  out.invented_area_m2 = 1.0;
  return out;
}

Reconstruction of(std::vector<ObjectResult> objects) {
  Reconstruction out;
  out.objects = std::move(objects);
  return out;
}

FinishOptions with_holes(Holes holes, double size_m = 0.01) {
  FinishOptions options;
  options.holes = holes;
  options.hole_size_m = size_m;
  return options;
}

TEST(FinishObjects, ChangesNothingUnlessAsked) {
  Reconstruction r = of({ball()});
  const TriangleMesh before = r.objects[0].mesh;
  ASSERT_TRUE(finish_objects({}, r, {}));
  EXPECT_EQ(r.objects[0].mesh.vertices, before.vertices);
  EXPECT_EQ(r.objects[0].mesh.triangles, before.triangles);
  EXPECT_EQ(r.objects[0].invented_area_m2, 1.0);
}

TEST(FinishObjects, LeavesLargeHolesOpenAndClosesSmallOnes) {
  Reconstruction r = of({ball()});
  ASSERT_TRUE(finish_objects(with_holes(Holes::kOpen), r, {}));
  const ObjectResult& object = r.objects[0];
  EXPECT_TRUE(object.left_open);
  EXPECT_FALSE(object.check.closed);
  EXPECT_TRUE(object.check.manifold);
  EXPECT_EQ(object.check.euler, 1);  // a disc: one hole
  float top = 0.0f;
  for (const Vec3f& p : object.mesh.vertices) top = std::max(top, p.y());
  EXPECT_NEAR(top, 0.8f * kRadius, 0.1f * kRadius);
  ASSERT_EQ(object.confidence.size(), object.mesh.vertices.size());
  for (std::size_t v = 0; v < object.confidence.size(); ++v)
    EXPECT_EQ(object.confidence[v], object.mesh.vertices[v].x());
  EXPECT_EQ(object.evidence.size(), object.mesh.triangles.size());
  EXPECT_NE(object.notes.back().find("one hole was left open"), std::string::npos)
      << object.notes.back();
}

TEST(FinishObjects, LeavesEveryHoleOpenDownToNothing) {
  Reconstruction r = of({ball()});
  ASSERT_TRUE(finish_objects(with_holes(Holes::kOpen, 0.0), r, {}));
  EXPECT_EQ(r.objects[0].check.euler, -1);  // three holes
  EXPECT_EQ(r.objects[0].invented_area_m2, 0.0);
}

TEST(FinishObjects, OpensTheUndersideTooAndFlattensItNever) {
  ObjectResult object = ball();
  for (Evidence& evidence : object.evidence)
    if (evidence == Evidence::kInvented) evidence = Evidence::kBase;
  Reconstruction open = of({object}), flat = of({object});
  ASSERT_TRUE(finish_objects(with_holes(Holes::kOpen), open, {}));
  EXPECT_FALSE(open.objects[0].check.closed);
  ASSERT_TRUE(finish_objects(with_holes(Holes::kFlat, 0.0), flat, {}));
  EXPECT_EQ(flat.objects[0].mesh.vertices, object.mesh.vertices);
}

TEST(FinishObjects, FlatIsTheSurfaceOfLeastAreaOverTheRim) {
  Reconstruction r = of({ball()});
  ASSERT_TRUE(finish_objects(with_holes(Holes::kFlat), r, {}));
  const ObjectResult& object = r.objects[0];
  EXPECT_TRUE(object.check.watertight());
  EXPECT_FALSE(object.left_open);
  for (const Vec3f& p : object.mesh.vertices) EXPECT_LT(p.y(), 0.86f * kRadius);
}

TEST(FinishObjects, NoScrapStaysWhereATriangleHangsByACorner) {
  ObjectResult object = ball();
  // Every other triangle of the cap was measured.
  for (std::size_t t = 0; t < object.evidence.size(); t += 2)
    object.evidence[t] = Evidence::kMeasured;
  Reconstruction r = of({object});
  ASSERT_TRUE(finish_objects(with_holes(Holes::kOpen, 0.0), r, {}));
  EXPECT_TRUE(r.objects[0].check.manifold) << r.objects[0].check.text();
}

TEST(FinishObjects, DropsPartsThatAreTooSmall) {
  ObjectResult object = ball();
  const TriangleMesh crumb = test::sphere(0.002, 2, Vec3d(0.1, 0.0, 0.0));
  test::append(object.mesh, crumb);
  object.evidence.resize(object.mesh.triangles.size(), Evidence::kMeasured);
  object.confidence.resize(object.mesh.vertices.size(), 1.0f);
  FinishOptions options;
  options.smallest_part_m = 0.005;
  Reconstruction r = of({object, ball(Vec3d(1, 0, 0), 0.001)});
  ASSERT_TRUE(finish_objects(options, r, {}));
  ASSERT_EQ(r.objects.size(), 1u);
  EXPECT_EQ(r.objects[0].check.components, 1);
  EXPECT_TRUE(r.objects[0].check.watertight());
  options.smallest_part_m = 1.0;
  EXPECT_EQ(finish_objects(options, r, {}).error().code, ErrorCode::kTooFewPoints);
}

TEST(FinishObjects, KeepsTheObjectOfANumberOrSaysHowManyThereAre) {
  Reconstruction r = of({ball(), ball(Vec3d(1, 0, 0))});
  FinishOptions options;
  options.object = 2;
  ASSERT_TRUE(finish_objects(options, r, {}));
  ASSERT_EQ(r.objects.size(), 1u);
  EXPECT_GT(r.objects[0].mesh.vertices[0].x(), 0.5f);
  const auto none = finish_objects(options, r, {});
  EXPECT_EQ(none.error().code, ErrorCode::kInvalidOption);
  EXPECT_NE(none.error().message.find("there is only 1"), std::string::npos);
}

TEST(FinishObjects, SmoothsAndStaysClosedAndStopsWhenCancelled) {
  Reconstruction r = of({ball()});
  for (std::size_t v = 0; v < r.objects[0].mesh.vertices.size(); v += 7)
    r.objects[0].mesh.vertices[v] *= 1.02f;
  FinishOptions options;
  options.smooth_m = 0.015;
  Reconstruction rough = r;
  ASSERT_TRUE(finish_objects(options, r, {}));
  EXPECT_TRUE(r.objects[0].check.watertight());
  EXPECT_LT(r.objects[0].check.area_m2, 0.99 * check_mesh(rough.objects[0].mesh).area_m2);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(finish_objects(options, rough, context).error().code, ErrorCode::kCancelled);
}

TEST(FinishObjects, KeepsABoxWithFlatFacesThatAreNotInvented) {
  Reconstruction r = of({ball()});
  FinishOptions options;
  options.keep_box = "-2cm,-1cm,,2cm,,";
  ASSERT_TRUE(finish_objects(options, r, {}));
  const ObjectResult& object = r.objects[0];
  EXPECT_TRUE(object.check.watertight()) << object.check.text();
  const Box box = bounds(object.mesh.vertices);
  EXPECT_NEAR(box.min.x(), -0.02, 1e-5);
  EXPECT_NEAR(box.max.x(), 0.02, 1e-5);
  EXPECT_NEAR(box.min.y(), -0.01, 1e-5);
  EXPECT_NEAR(box.max.y(), kRadius, 1e-4);
  EXPECT_NEAR(box.max.z(), kRadius, 1e-3);
  ASSERT_EQ(object.evidence.size(), object.mesh.triangles.size());
  ASSERT_EQ(object.confidence.size(), object.mesh.vertices.size());
  EXPECT_GT(std::count(object.evidence.begin(), object.evidence.end(), Evidence::kCut), 0);
  EXPECT_LT(object.invented_area_m2, 0.4 * 2.0 * 3.14 * kRadius * kRadius);
  EXPECT_NE(object.notes.back().find("flat faces"), std::string::npos);
}

TEST(FinishObjects, CutsAwayOneSideOfAPlaneAndThenSmallParts) {
  Reconstruction r = of({ball(), ball({0.3, 0.0, 0.0}, 0.004)});
  FinishOptions options;
  options.cut_plane = ",,,0,1,0";
  ASSERT_TRUE(finish_objects(options, r, {}));
  ASSERT_EQ(r.objects.size(), 2u);
  EXPECT_NEAR(bounds(r.objects[0].mesh.vertices).max.y(), 0.0, 1e-5);
  options.cut_plane = "0.2m,0,0,1,0,0";
  ASSERT_TRUE(finish_objects(options, r, {}));
  EXPECT_EQ(r.objects.size(), 1u);
  options.cut_plane = "1m,0,0,-1,0,0";
  const auto nothing = finish_objects(options, r, {});
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::kTooFewPoints);
}

TEST(FinishObjects, SaysWhatABoxAndAPlaneMustLookLike) {
  FinishOptions options;
  const OptionTable table = describe(options);
  for (const char* bad : {"1cm", "1,2,3,4,5,6", "2cm,,,1cm,,", "1cm,,,1cm,,", "nan,,,,,", ",,,,,,"})
    EXPECT_FALSE(table.set("keep-box", bad)) << bad;
  for (const char* bad : {"1cm", "0,0,0,0,0,0", ",,,,,", "0,0,0,1,x,0", "1,0,0,1,0,0"})
    EXPECT_FALSE(table.set("cut-plane", bad)) << bad;
  EXPECT_TRUE(options.keep_box.empty() && options.cut_plane.empty());
  EXPECT_TRUE(table.set("keep-box", ",2mm,,,,"));
  EXPECT_TRUE(table.set("cut-plane", "0,1cm,0,0,-1,0.5"));
  options.cut_plane = "nonsense";
  EXPECT_FALSE(table.check());
  EXPECT_FALSE(kept_half_spaces(options));
}

}  // namespace
}  // namespace turnscan
