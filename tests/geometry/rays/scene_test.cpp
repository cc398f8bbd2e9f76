#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/rays/scene.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

Scene scene_of(const std::vector<TriangleMesh>& meshes, std::optional<double> platter = {}) {
  auto scene = Scene::create(meshes, platter);
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  return std::move(*scene);
}

std::vector<Ray> random_rays(std::size_t n) {
  std::vector<Ray> rays(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto u = [&](std::uint64_t k) { return 2.0 * uniform01(hash_key(7, i, k)) - 1.0; };
    rays[i].origin = Vec3d(0.5 * u(0), 0.5 * u(1), 0.5 * u(2)).cast<float>();
    rays[i].direction = Vec3d(0.1 * u(3), 0.1 * u(4), 0.1 * u(5)).cast<float>() - rays[i].origin;
  }
  return rays;
}

TEST(Scene, LeavesTheNumberOfThreadsOfTheProcessAlone) {
  const int before = thread_count();
  const auto scene = Scene::create({}, 0.1);
  ASSERT_TRUE(scene);
  EXPECT_EQ(thread_count(), before);
}

TEST(Scene, HitsASphereWhereAlgebraSays) {
  const double radius = 0.1;
  const Scene scene = scene_of({test::sphere_mesh(Vec3d::Zero(), radius, 400)});
  std::size_t hits = 0;
  for (const Ray& ray : random_rays(2000)) {
    const Vec3d o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
    const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - radius * radius;
    const double root = b * b - a * c;
    // Grazing rays feel the facets.
    if (c < 1e-3 || std::abs(root) < 1e-2 * b * b) continue;
    const RayHit hit = scene.intersect(ray);
    ASSERT_EQ(hit.valid(), root > 0.0 && b < 0.0);
    if (!hit.valid()) continue;
    ++hits;
    const double t = (-b - std::sqrt(root)) / a;
    const Vec3d p = o + t * d;
    // Facets of 0.8 mm lie at most 0.8 um inside.
    EXPECT_LT(std::abs(hit.t - t) * d.norm(), 1e-5);
    EXPECT_GT(hit.normal.cast<double>().dot(p) / radius, 0.9999);
    EXPECT_EQ(hit.object, 0u);
  }
  EXPECT_GT(hits, 500u);
}

TEST(Scene, GivesTheSameHitsForOneRayAndForMany) {
  const Scene scene = scene_of(
      {test::sphere_mesh({0.1, 0.1, 0}, 0.1, 40), test::box_mesh({-.2, 0, 0}, {0, .1, .1})}, 0.3);
  const std::vector<Ray> rays = random_rays(1003);
  for (const RayOrder order : {RayOrder::kCoherent, RayOrder::kIncoherent}) {
    std::vector<RayHit> hits(rays.size());
    std::vector<std::uint8_t> blocked(rays.size());
    scene.intersect(rays, hits, order);
    scene.occluded(rays, blocked, order);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const RayHit one = scene.intersect(rays[i]);
      ASSERT_EQ(one.object, hits[i].object);
      ASSERT_EQ(one.triangle, hits[i].triangle);
      ASSERT_EQ(one.t, hits[i].t);
      ASSERT_EQ(blocked[i] != 0, one.valid());
      ASSERT_EQ(scene.occluded(rays[i]), one.valid());
    }
  }
}

TEST(Scene, TellsWhichObjectAndTriangleWasHit) {
  const Scene scene = scene_of(
      {test::box_mesh({0, 0, 0}, {1, 1, 1}), TriangleMesh(), test::box_mesh({3, 0, 0}, {4, 1, 1})});
  EXPECT_EQ(scene.object_count(), 3u);
  Ray ray;
  ray.origin = Vec3f(3.25f, 0.5f, 5.0f);
  ray.direction = Vec3f(0, 0, -2);
  const RayHit hit = scene.intersect(ray);
  EXPECT_EQ(hit.object, 2u);
  EXPECT_TRUE(hit.triangle == 2 || hit.triangle == 3) << hit.triangle;
  EXPECT_FLOAT_EQ(hit.t, 2.0f);
  EXPECT_LT((hit.normal - Vec3f::UnitZ()).norm(), 1e-6f);
}

TEST(Scene, GivesBarycentricCoordinatesOfTheHit) {
  const TriangleMesh mesh = test::sphere_mesh(Vec3d::Zero(), 0.1, 30);
  const Scene scene = scene_of({mesh});
  for (const Ray& ray : random_rays(200)) {
    const RayHit hit = scene.intersect(ray);
    if (!hit.valid()) continue;
    const auto& t = mesh.triangles[hit.triangle];
    const Vec3f p = (1.0f - hit.u - hit.v) * mesh.vertices[t[0]] + hit.u * mesh.vertices[t[1]] +
                    hit.v * mesh.vertices[t[2]];
    EXPECT_LT((p - (ray.origin + hit.t * ray.direction)).norm(), 1e-6f);
  }
}

TEST(Scene, LetsNoRayThroughBetweenTriangles) {
  const TriangleMesh mesh = test::sphere_mesh(Vec3d::Zero(), 0.1, 60);
  const Scene scene = scene_of({mesh});
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      for (const float part : {0.1f, 0.3f, 0.5f, 0.8f}) {
        Ray ray;
        ray.origin = Vec3f(0.0123f, -0.0077f, 0.0031f);
        ray.direction =
            (1.0f - part) * mesh.vertices[t[k]] + part * mesh.vertices[t[(k + 1) % 3]] - ray.origin;
        ASSERT_TRUE(scene.occluded(ray));
      }
    }
  }
}

TEST(Scene, RespectsTheRaysEnds) {
  const Scene scene = scene_of({test::box_mesh({0, 0, 0}, {1, 1, 1})}, 10.0);
  Ray ray;
  ray.origin = Vec3f(0.5f, 0.5f, -1.0f);
  ray.t_max = 0.99f;
  EXPECT_FALSE(scene.occluded(ray));
  ray.t_max = 1.01f;
  EXPECT_TRUE(scene.occluded(ray));
  ray = {Vec3f(5.0f, 0.0f, 0.0f), Vec3f(0.0f, 1.0f, 0.0f)};  // starts on the platter
  EXPECT_FALSE(scene.occluded(ray));
}

TEST(Scene, HasARoundPlatter) {
  const Scene scene = scene_of({}, 0.15);
  Ray ray;
  ray.direction = Vec3f(0, -1, 0);
  ray.origin = Vec3f(0.149f, 0.2f, 0.0f);
  EXPECT_EQ(scene.intersect(ray).object, kPlatter);
  EXPECT_FLOAT_EQ(scene.intersect(ray).t, 0.2f);
  ray.origin = Vec3f(0.1065f, 0.2f, 0.1065f);
  EXPECT_FALSE(scene.intersect(ray).valid());
  EXPECT_TRUE(scene.object_box().empty());
  EXPECT_NEAR(scene.box().size().x(), 0.3, 1e-12);
}

TEST(Scene, HidesThePlatterUnderAnObject) {
  const Scene scene = scene_of({test::box_mesh({-.1, 0, -.1}, {.1, .05, .1})}, 0.15);
  const Ray ray{Vec3f(0, 1, 0), Vec3f(0, -1, 0)};
  EXPECT_EQ(scene.intersect(ray).object, 0u);
  EXPECT_FLOAT_EQ(scene.intersect(ray).t, 0.95f);
}

TEST(Scene, RefusesATriangleThatNamesAVertexThatIsNotThere) {
  TriangleMesh mesh = test::box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles[3][1] = 8;
  const auto scene = Scene::create({&mesh, 1});
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::kFormat);
  EXPECT_NE(scene.error().message.find("triangle 3 names vertex 8"), std::string::npos);
}

TEST(Scene, RefusesAVertexThatIsNotFinite) {
  TriangleMesh mesh = test::box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.vertices[5].y() = std::numeric_limits<float>::quiet_NaN();
  const auto scene = Scene::create({&mesh, 1});
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().code, ErrorCode::kFormat);
}

TEST(Scene, RefusesAPlatterWithoutSize) {
  EXPECT_FALSE(Scene::create({}, 0.0));
  EXPECT_FALSE(Scene::create({}, std::numeric_limits<double>::quiet_NaN()));
}

TEST(Scene, ThrowsWhenSpansDiffer) {
  const Scene scene = scene_of({});
  std::vector<Ray> rays(3);
  std::vector<RayHit> hits(2);
  EXPECT_THROW(scene.intersect(rays, hits), std::invalid_argument);
}

}  // namespace
}  // namespace turnscan
