#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/geometry/hull/convex_hull.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

TriangleMesh hull_of(const std::vector<Vec3f>& points) {
  TriangleMesh mesh;
  mesh.vertices = points;
  mesh.triangles = convex_hull(points);
  return mesh;
}

/// Closed, of one piece without holes, and outward.
void expect_closed(const TriangleMesh& hull) {
  std::vector<std::uint64_t> edges, reversed;
  std::vector<bool> used(hull.vertices.size(), false);
  for (const auto& t : hull.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t from = t[k], to = t[(k + 1) % 3];
      edges.push_back(from << 32 | to);
      reversed.push_back(to << 32 | from);
      used[from] = true;
    }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
  EXPECT_TRUE(edges == reversed);
  const auto corners = std::size_t(std::count(used.begin(), used.end(), true));
  EXPECT_EQ(corners + hull.triangles.size(), edges.size() / 2 + 2) << "Euler's formula";
  EXPECT_GT(signed_volume(hull), 0.0);
}

/// And no point outside of any face.
void expect_hull(const TriangleMesh& hull, double tolerance) {
  ASSERT_FALSE(hull.empty());
  expect_closed(hull);
  for (const auto& t : hull.triangles) {
    const Vec3d a = hull.vertices[t[0]].cast<double>(), b = hull.vertices[t[1]].cast<double>(),
                c = hull.vertices[t[2]].cast<double>();
    const Vec3d normal = (b - a).cross(c - a).normalized();
    for (const Vec3f& p : hull.vertices) ASSERT_LE(normal.dot(p.cast<double>() - a), tolerance);
  }
}

TEST(ConvexHull, HoldsAllPoints) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    std::vector<Vec3f> points;
    for (std::uint64_t i = 0; i < 2000; ++i)
      points.emplace_back(float(test::random_value(seed, i, 0)),
                          float(test::random_value(seed, i, 1)),
                          0.3f * float(test::random_value(seed, i, 2)));
    expect_hull(hull_of(points), 1e-5);
  }
}

TEST(ConvexHull, OfASubdividedCubeIsTheCube) {
  const TriangleMesh hull = hull_of(test::subdivided(test::cube(), 4).vertices);
  expect_hull(hull, 1e-5);
  EXPECT_NEAR(signed_volume(hull), 1.0, 1e-5);
}

TEST(ConvexHull, OfABallHasAllItsPoints) {
  const TriangleMesh ball = test::sphere(0.1, 5);
  const TriangleMesh hull = hull_of(ball.vertices);
  expect_hull(hull, 1e-6);
  EXPECT_EQ(hull.triangles.size(), ball.triangles.size());
}

/// What the kinds of hard sets are made of: numbers from 0 to 1 of one point.
using Draw = std::array<double, 3>;

/// A few values only, so that many points are the same or in one plane.
double coarse(double u, double steps) { return std::round(u * steps) / steps; }

Vec3d on_ball(double u, double v) {
  const double y = 2.0 * u - 1.0, a = 2.0 * std::numbers::pi * v, r = std::sqrt(1.0 - y * y);
  return {r * std::cos(a), y, r * std::sin(a)};
}

Vec3d hard_point(std::uint64_t kind, const Draw& u) {
  const double a = 2.0 * std::numbers::pi * coarse(u[1], 60.0);
  switch (kind) {
    case 0:  // planar
      return {u[0], u[1], 0.0};
    case 1:  // collinear
      return {u[0], u[0], u[0]};
    case 2:  // duplicated
      return {coarse(u[0], 6.0), coarse(u[1], 6.0), coarse(u[2], 6.0)};
    case 3:  // cospherical
      return on_ball(u[0], u[1]);
    case 4:  // on circles of a ball
      return on_ball(coarse(u[0], 12.0), coarse(u[1], 12.0));
    case 5:  // rings
      return {std::cos(a), coarse(u[0], 3.0), std::sin(a)};
    case 6:  // a floor and what is above it
      return {u[0], u[1], u[2] < 0.01 ? 1.0 : 0.0};
    case 7:  // hardly thicker than a plane
      return {u[0], u[1] * u[0], 4e-6 * u[2]};
    case 8:  // on the edges of a box
      return {coarse(u[0], 1.0), coarse(u[1], 1.0), u[2]};
    default:  // crowded at a corner
      return Vec3d(u[0], u[1], u[2]).array().pow(8.0);
  }
}

/// Turned, with noise or far from the origin for some, and rounded to floats.
std::vector<Vec3f> hard_points(std::uint64_t seed) {
  const auto draw = [&](std::uint64_t i, std::uint64_t k) {
    return uniform01(hash_key(seed, i, k));
  };
  const std::uint64_t n = seed == 56   ? 1000000
                          : seed == 13 ? 100000
                                       : std::uint64_t(10.0 * std::pow(2000.0, draw(0, 4)));
  const double noise = std::array{0.0, 1e-7, 3e-6}[seed / 10 % 3];
  const Vec3d shift = double(seed / 30 % 2) * Vec3d(50.0, -20.0, 3.0);
  const Eigen::AngleAxisd turn(6.0 * draw(0, 5), on_ball(draw(0, 6), draw(0, 7)));
  std::vector<Vec3f> out;
  out.reserve(n);
  for (std::uint64_t i = 1; i <= n; ++i) {
    const Vec3d p = hard_point(seed % 10, {draw(i, 0), draw(i, 1), draw(i, 2)});
    const Vec3d off = noise * Vec3d(draw(i, 8), draw(i, 9), draw(i, 10));
    out.push_back((turn * (p + off) + shift).cast<float>());
  }
  return out;
}

TEST(ConvexHull, OfHardSetsIsClosedAndOfOnePiece) {
  std::size_t solid = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh hull = hull_of(hard_points(seed));
    if (!hull.triangles.empty()) expect_closed(hull), ++solid;
  }
  EXPECT_GE(solid, 80u);
}

TEST(ConvexHull, OfCrowdedPointsOfAScanHoldsThem) {
  // Vertices of a real scan's mesh; computed in floating point, some distances to faces contradict
  // each other.
  expect_hull(hull_of({{-0.0604751408f, 0.0479925461f, -0.226008803f},
                       {-0.236531541f, 0.144031763f, -0.155061871f},
                       {-0.237837791f, 0.200131476f, -0.0757579505f},
                       {-0.0374685265f, 0.548714399f, -0.0621457361f},
                       {0.281294882f, 0.0726848766f, -0.037827231f},
                       {-0.24728097f, 0.153126195f, -0.0402908958f},
                       {-0.247389138f, 0.148574665f, -0.0400660262f},
                       {-0.245856121f, 0.152253374f, -0.0370368473f},
                       {-0.244495496f, 0.153595969f, -0.0367517509f},
                       {-0.0528630875f, 0.532627463f, -0.0379063375f},
                       {-0.0758130029f, 0.504383028f, -0.0249057971f},
                       {-0.0503838062f, 0.520703316f, 0.0136349658f},
                       {-0.0230248198f, 0.53735292f, 0.0115164863f},
                       {-0.0173767507f, 0.552938819f, 0.00504388195f},
                       {-0.26229167f, 0.0102993641f, 0.0168901999f},
                       {-0.261793882f, 0.00860854611f, 0.0178665388f},
                       {-0.262025476f, 0.0104123093f, 0.0170538984f},
                       {-0.070239462f, 0.487706572f, 0.0294996221f},
                       {-0.0714651123f, 0.490625799f, 0.0242561344f},
                       {-0.0695316419f, 0.490474671f, 0.0287434179f},
                       {-0.068498306f, 0.492307395f, 0.0287140142f},
                       {-0.0693831146f, 0.489501297f, 0.0296570566f},
                       {-0.0685573742f, 0.491440564f, 0.0297055915f},
                       {-0.0685896873f, 0.491888821f, 0.0292182565f},
                       {0.0813717693f, 0.499292403f, 0.0232883729f},
                       {0.0791307986f, 0.4683882f, 0.0474370793f},
                       {-0.063158989f, 0.479383647f, 0.0455462001f},
                       {-0.063379392f, 0.478448212f, 0.0457273722f},
                       {-0.0613530166f, 0.474861562f, 0.0501645245f},
                       {-0.0584443994f, 0.478384763f, 0.0519551933f},
                       {-0.0612526014f, 0.483980566f, 0.0454130881f},
                       {-0.0601486638f, 0.48481676f, 0.0462679863f},
                       {-0.0585201681f, 0.489653021f, 0.0447221436f},
                       {-0.0547610335f, 0.491350561f, 0.0481505394f},
                       {-0.0547521077f, 0.490824491f, 0.0485501587f},
                       {-0.0537869334f, 0.491495609f, 0.0491583943f},
                       {-0.0538769774f, 0.491970241f, 0.0487643257f},
                       {-0.0520432964f, 0.491433382f, 0.0510592796f},
                       {-0.0519876406f, 0.49253571f, 0.0502452888f},
                       {-0.0521207191f, 0.494929194f, 0.048039563f},
                       {-0.0511867702f, 0.494914442f, 0.0489492267f},
                       {-0.052029185f, 0.491983473f, 0.050639715f},
                       {-0.0511583947f, 0.492486387f, 0.0511490256f},
                       {-0.0538929142f, 0.495975226f, 0.045385737f},
                       {-0.0530386567f, 0.496021509f, 0.0464162044f},
                       {-0.0557813719f, 0.465598583f, 0.0596174039f},
                       {0.0741377175f, 0.458790004f, 0.0556148626f},
                       {-0.059648037f, 0.471694946f, 0.0536793508f},
                       {-0.0558245145f, 0.472017765f, 0.0575736314f},
                       {-0.0519531034f, 0.475678831f, 0.0593488216f},
                       {-0.0426434018f, 0.491789401f, 0.0589607172f},
                       {0.0109739332f, 0.387665957f, 0.0998044536f},
                       {0.00812265556f, 0.388507783f, 0.0997252986f},
                       {-0.243019283f, 0.0196983274f, -0.107022829f},
                       {-0.25602299f, 0.058624249f, -0.112422571f},
                       {-0.267639905f, 0.0758256018f, -0.110497192f},
                       {-0.00931132585f, 0.558764815f, -0.00568893552f},
                       {0.221010894f, 0.0240380317f, 0.0766488239f},
                       {-0.020990843f, 0.46015656f, 0.0753287822f}}),
              1e-6);
}

TEST(ConvexHull, OfWhatIsFlatIsEmpty) {
  EXPECT_TRUE(convex_hull(test::plane(5).vertices).empty());
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_TRUE(convex_hull(std::vector<Vec3f>(10, Vec3f(1, 2, 3))).empty());
  std::vector<Vec3f> points = test::cube().vertices;
  points.emplace_back(std::nanf(""), 0.0f, 0.0f);
  EXPECT_TRUE(convex_hull(points).empty());
}

}  // namespace
}  // namespace turnscan
