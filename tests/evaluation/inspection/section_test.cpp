#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/evaluation/inspection/section.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

Section section_of(const TriangleMesh& mesh, const Vec3d& normal, double offset_m) {
  const auto made = cross_section(mesh, {normal.normalized(), offset_m});
  if (!made) {
    ADD_FAILURE() << made.error().text();
    return {};
  }
  return *made;
}

Vec3d random_direction(std::uint64_t i) {
  return Vec3d(random_value(7, i, 0), random_value(7, i, 1), random_value(7, i, 2)).normalized();
}

TEST(Section, OfAClosedMeshHasClosedContoursInEveryPlane) {
  const TriangleMesh ring = torus(0.05, 0.02, 40, 24);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Section made = section_of(ring, random_direction(i), 0.05 * random_value(8, i));
    EXPECT_EQ(made.open, 0u) << i;
    for (const Contour& contour : made.contours) {
      EXPECT_TRUE(contour.closed) << i;
      for (const Vec3d& p : contour.points)
        EXPECT_NEAR(made.normal.dot(p), made.offset_m, 1e-9) << i;
    }
  }
}

TEST(Section, HasTheAreaOfTheFacesThatCloseTheCut) {
  const TriangleMesh ring = torus(0.05, 0.02, 40, 24);
  for (std::uint64_t i = 0; i < 40; ++i) {
    const HalfSpace plane{random_direction(i), 0.03 * random_value(9, i)};
    const auto made = cross_section(ring, plane);
    const auto clipped = clip(ring, plane);
    ASSERT_TRUE(made && clipped);
    EXPECT_NEAR(made->area_m2, clipped->cut_area_m2, 1e-7) << i;
  }
}

TEST(Section, OfASphereIsADisc) {
  const double r = 0.1;
  const TriangleMesh ball = sphere(r, 6);
  for (const double h : {-0.08, -0.02, 0.0, 0.05}) {
    const Section made = section_of(ball, Vec3d(1, 2, -1), h);
    ASSERT_EQ(made.contours.size(), 1u);
    const double disc = std::sqrt(r * r - h * h);
    EXPECT_NEAR(made.area_m2 / (std::numbers::pi * disc * disc), 1.0, 2e-3) << h;
    EXPECT_NEAR(made.length_m / (2.0 * std::numbers::pi * disc), 1.0, 2e-3) << h;
  }
}

TEST(Section, OfARingLeavesItsHoleOut) {
  // The plane of the ring: an annulus from 30 to 70 mm.
  const Section made = section_of(torus(0.05, 0.02, 200, 60), Vec3d::UnitZ(), 1e-5);
  ASSERT_EQ(made.contours.size(), 2u);
  EXPECT_NEAR(made.area_m2, std::numbers::pi * (0.07 * 0.07 - 0.03 * 0.03), 2e-5);
}

TEST(Section, ThroughVerticesAndFacesOfACubeIsWhole) {
  for (const double offset : {0.0, 1e-12, 0.5}) {
    const Section made = section_of(cube(), Vec3d::UnitX(), offset);
    if (offset > 0.1) {
      EXPECT_NEAR(made.area_m2, 1.0, 1e-12);
    }
    EXPECT_EQ(made.open, 0u) << offset;
  }
  // Through four of its corners.
  const Section diagonal = section_of(cube(), Vec3d(1, -1, 0), 0.0);
  EXPECT_EQ(diagonal.open, 0u);
  EXPECT_NEAR(diagonal.area_m2, std::numbers::sqrt2, 1e-9);
}

TEST(Section, OfAnOpenMeshSaysThatItsContoursAreOpen) {
  const Section made = section_of(plane(8), Vec3d::UnitX(), 0.3);
  ASSERT_EQ(made.contours.size(), 1u);
  EXPECT_EQ(made.open, 1u);
  EXPECT_EQ(made.area_m2, 0.0);
  EXPECT_NEAR(made.length_m, 1.0, 1e-6);
}

TEST(Section, BesideTheMeshIsEmptyAndIsNotDrawn) {
  const Section made = section_of(cube(), Vec3d::UnitY(), 2.0);
  EXPECT_TRUE(made.contours.empty());
  for (const auto& text : {section_dxf(made), section_svg(made)}) {
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().code, ErrorCode::kTooFewPoints);
  }
}

TEST(Section, IsRefusedForANormalWithoutLength) {
  EXPECT_EQ(cross_section(cube(), {Vec3d::Zero(), 0.0}).error().code, ErrorCode::kInvalidOption);
}

TEST(Section, IsDrawnRightHandedWithUpOnTop) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Vec3d n = random_direction(i);
    const auto [right, up] = drawing_axes(n);
    EXPECT_NEAR((right.cross(up) - n).norm(), 0.0, 1e-12);
  }
  EXPECT_EQ(drawing_axes(Vec3d::UnitZ()).first, Vec3d(Vec3d::UnitX()));
  EXPECT_EQ(drawing_axes(Vec3d::UnitZ()).second, Vec3d(Vec3d::UnitY()));
  EXPECT_EQ(drawing_axes(Vec3d::UnitY()).first, Vec3d(Vec3d::UnitX()));
}

TEST(Section, IsDrawnInMillimetres) {
  TriangleMesh box = cube();
  for (Vec3f& v : box.vertices) v = v.cwiseProduct(Vec3f(0.03f, 0.02f, 0.01f));
  const Section made = section_of(box, Vec3d::UnitZ(), 0.005);
  const auto svg = section_svg(made);
  ASSERT_TRUE(svg);
  EXPECT_NE(svg->find("width=\"34.0000mm\" height=\"24.0000mm\""), std::string::npos) << *svg;
  const auto dxf = section_dxf(made);
  ASSERT_TRUE(dxf);
  EXPECT_NE(dxf->find("POLYLINE"), std::string::npos);
  EXPECT_NE(dxf->find("10\n30.00000\n20\n20.00000\n"), std::string::npos) << *dxf;
  EXPECT_TRUE(dxf->ends_with("0\nEOF\n"));
}

TEST(SectionCap, HasTheAreaOfTheSectionAndFacesAgainstTheNormal) {
  const TriangleMesh ring = torus(0.05, 0.02, 40, 24);
  std::size_t made_caps = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const Section made = section_of(ring, random_direction(i), 0.03 * random_value(9, i));
    const auto cap = section_cap(made);
    ASSERT_TRUE(cap) << cap.error().text();
    double area = 0.0;
    for (const auto& [a, b, c] : cap->triangles) {
      const Vec3d u = (cap->vertices[b] - cap->vertices[a]).cast<double>();
      const Vec3d v = (cap->vertices[c] - cap->vertices[a]).cast<double>();
      const double part = -0.5 * made.normal.dot(u.cross(v));
      EXPECT_GT(part, -1e-10) << i;
      area += part;
    }
    EXPECT_NEAR(area, made.area_m2, 1e-8) << i;
    made_caps += cap->empty() ? 0 : 1;
  }
  EXPECT_GT(made_caps, 20u);
}

TEST(SectionCap, OfNothingIsEmpty) {
  const auto cap = section_cap(section_of(cube(), Vec3d::UnitX(), 5.0));
  ASSERT_TRUE(cap);
  EXPECT_TRUE(cap->empty());
}

}  // namespace
}  // namespace turnscan
