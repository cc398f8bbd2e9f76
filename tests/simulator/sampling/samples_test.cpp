#include <turnscan/core/random.hpp>
#include <turnscan/simulator/sampling/sample_kernel.hpp>
#include <turnscan/simulator/sampling/samples.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

CameraIntrinsics camera(int width = 160, int height = 120, double f = 150.0) {
  CameraIntrinsics c;
  c.width = width, c.height = height;
  c.fx = c.fy = f;
  c.cx = 0.5 * (width - 1), c.cy = 0.5 * (height - 1);
  return c;
}

ScannerModel scanner(const Vec3d& emitter = Vec3d::Zero()) {
  ScannerModel g;
  g.max_incidence_rad = test::kPi / 2;
  g.camera = camera();
  g.emitter_m = emitter;
  g.near_m = 0.1, g.far_m = 5.0;
  return g;
}

SampleTracer tracer_of(const ScannerModel& g) {
  auto tracer = SampleTracer::create(g);
  EXPECT_TRUE(tracer) << (tracer ? "" : tracer.error().text());
  return std::move(*tracer);
}

Scene scene_of(const std::vector<TriangleMesh>& meshes, std::optional<double> platter = {}) {
  auto scene = Scene::create(meshes, platter);
  EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
  return std::move(*scene);
}

/// Rectangle [x0, x1] x [y0, y1] at depth z, its normal towards -z.
TriangleMesh wall(double x0, double x1, double y0, double y1, double z) {
  TriangleMesh mesh;
  for (const auto& [x, y] : {std::pair(x0, y0), {x1, y0}, {x1, y1}, {x0, y1}})
    mesh.vertices.push_back(Vec3d(x, y, z).cast<float>());
  mesh.triangles = {{0, 3, 2}, {0, 2, 1}};
  return mesh;
}

Pose random_pose(std::uint64_t seed) {
  const auto u = [&](std::uint64_t k) { return 2.0 * uniform01(hash_key(seed, 1, 2, k)) - 1.0; };
  Pose T = Pose::Identity();
  T.linear() = Eigen::Quaterniond(u(0), u(1), u(2), u(3)).normalized().toRotationMatrix();
  T.translation() = Vec3d(u(4), u(5), u(6));
  return T;
}

SampleGrid trace(const SampleTracer& tracer, const std::vector<Body>& bodies,
                 const Pose& T_world_sensor = Pose::Identity()) {
  SampleGrid grid;
  tracer.trace(bodies, T_world_sensor, grid);
  return grid;
}

Miss miss_at(const SampleGrid& grid, int column, int row) {
  return grid.contains(column, row) ? grid.miss[grid.index(column, row)] : Miss::kNothing;
}

std::size_t count(const SampleGrid& grid, Miss miss) {
  return std::size_t(std::count(grid.miss.begin(), grid.miss.end(), miss));
}

TEST(Samples, OfAPlaneLieOnIt) {
  const Scene scene = scene_of({wall(-3, 3, -3, 3, 0.7)});
  const SampleGrid grid = trace(tracer_of(scanner({0.08, 0, 0})), {{&scene}});
  ASSERT_EQ(grid.size(), 160u * 120u);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    ASSERT_TRUE(grid.counts(i));
    ASSERT_NEAR(grid.z[i], 0.7f, 1.2e-7);
  }
}

TEST(Samples, OfATiltedPlaneLieOnItToFloatPrecisionWhereverTheBodyIs) {
  const Scene scene = scene_of({wall(-3, 3, -3, 3, 0.0)});
  const SampleTracer tracer = tracer_of(scanner({0.0, 0.05, 0.01}));
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    // The plane n * p = 1.2 in the sensor frame.
    const Vec3d n = (Vec3d(0, 0, 1) + 0.3 * random_pose(seed).translation()).normalized();
    Pose T_sensor_body = Pose::Identity();
    T_sensor_body.linear() =
        Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), n).toRotationMatrix();
    T_sensor_body.translation() = 1.2 * n;
    const Pose T_world_sensor = random_pose(seed + 100);
    const std::vector<Body> bodies{{&scene, T_world_sensor * T_sensor_body}};
    const SampleGrid grid = trace(tracer, bodies, T_world_sensor);
    ASSERT_GT(grid.size(), 15000u);
    for (int row = 0; row < 120; ++row) {
      for (int column = 0; column < 160; ++column) {
        if (miss_at(grid, column, row) == Miss::kNothing) continue;
        const std::size_t i = grid.index(column, row);
        ASSERT_TRUE(grid.counts(i)) << name_of(grid.miss[i]);
        const Vec3d d = tracer.direction(column, row);
        ASSERT_NEAR(grid.z[i], 1.2 / n.dot(d), 5e-7 / std::abs(n.dot(d)));
        const SampleHit hit = tracer.hit_of(bodies, T_world_sensor, grid, i, d);
        ASSERT_NEAR(hit.p_sensor.dot(n), 1.2, 1e-9);
        ASSERT_NEAR(hit.incidence_rad, std::acos(std::min(1.0, n.dot(d.normalized()))), 1e-7);
      }
    }
  }
}

TEST(Samples, OfASphereLieWhereAlgebraSays) {
  const double radius = 0.2;
  const Vec3d centre(0.02, -0.03, 0.8);
  const Scene scene = scene_of({test::sphere_mesh(centre, radius, 500)});
  const SampleTracer tracer = tracer_of(scanner());
  const SampleGrid grid = trace(tracer, {{&scene}});
  std::size_t seen = 0;
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const Vec3d d = tracer.direction(column, row);
      const double a = d.squaredNorm(), b = -centre.dot(d),
                   c = centre.squaredNorm() - radius * radius;
      const double root = b * b - a * c;
      if (std::abs(root) < 1e-3) continue;  // the outline feels the facets
      ASSERT_EQ(miss_at(grid, column, row), root > 0.0 ? Miss::kNone : Miss::kNothing);
      if (root < 0.0) continue;
      // Facets of 1.3 mm lie at most 1 um inside.
      ASSERT_NEAR(grid.z[grid.index(column, row)], (-b - std::sqrt(root)) / a, 2e-5);
      ++seen;
    }
  }
  EXPECT_GT(seen, 3000u);
}

/// A slot seen frontally: the wall in front, from x = 0 to the right, hides from an emitter b to
/// the right of the receiver a strip of the wall dz behind it that is b * dz / z wide.
TEST(Samples, MissTheUmbraOfASlotAndNoMore) {
  for (const double b : {0.02, 0.08, 0.2}) {
    for (const double dz : {0.01, 0.05, 0.3}) {
      const double z = 0.6;
      const Scene scene = scene_of({wall(0.0, 5, -5, 5, z), wall(-5, 5, -5, 5, z + dz)});
      ScannerModel g = scanner({b, 0, 0});
      g.camera = camera(1000, 3, 900.0);
      const SampleTracer tracer = tracer_of(g);
      const SampleGrid grid = trace(tracer, {{&scene}});
      for (int column = 0; column < 1000; ++column) {
        const double slope = tracer.direction(column, 1).x();
        const double x = slope * (z + dz);  // on the wall behind
        const Miss miss = miss_at(grid, column, 1);
        if (std::min(std::abs(slope), std::abs(x + b * dz / z)) < 1e-5) continue;
        const bool shadow = slope < 0.0 && x > -b * dz / z;
        ASSERT_EQ(miss, shadow ? Miss::kEmitterBlocked : Miss::kNone) << b << ' ' << dz << ' ' << x;
      }
    }
  }
}

TEST(Samples, DoNotCountOnASheetLitFromBehindOnly) {
  // A sheet along the line of sight's side: the receiver sees one side, the emitter the other.
  TriangleMesh sheet;
  sheet.vertices = {
      {-0.2f, -0.2f, 0.8f}, {-0.2f, 0.2f, 0.8f}, {0.2f, 0.2f, 1.2f}, {0.2f, -0.2f, 1.2f}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (const bool inverted : {false, true}) {
    if (inverted)
      for (auto& t : sheet.triangles) std::swap(t[0], t[1]);
    const Scene scene = scene_of({sheet});
    ScannerModel g = scanner({-1.1, 0, 0});
    const SampleGrid behind = trace(tracer_of(g), {{&scene}});
    EXPECT_EQ(count(behind, Miss::kNone), 0u);
    EXPECT_GT(count(behind, Miss::kEmitterBlocked), 1000u);
    g.emitter_m = {-0.9, 0, 0};
    const SampleGrid front = trace(tracer_of(g), {{&scene}});
    EXPECT_EQ(count(front, Miss::kEmitterBlocked), 0u);
    EXPECT_EQ(count(front, Miss::kNone), count(behind, Miss::kEmitterBlocked));
  }
}

TEST(Samples, SayWhyTheyDoNotCount) {
  const Scene scene = scene_of(
      {wall(-1.0, -0.2, -1, 1, 0.5), wall(-0.3, 0.3, -1, 1, 1.0), wall(0.3, 2.0, -1, 1, 2.0)});
  ScannerModel g = scanner();
  g.near_m = 0.6, g.far_m = 1.5;
  const SampleGrid grid = trace(tracer_of(g), {{&scene}});
  EXPECT_EQ(miss_at(grid, 0, 60), Miss::kTooNear);
  EXPECT_EQ(miss_at(grid, 80, 60), Miss::kNone);
  EXPECT_EQ(miss_at(grid, 150, 60), Miss::kTooFar);
  EXPECT_FLOAT_EQ(grid.z[grid.index(150, 60)], 2.0f);
  // Both ends count.
  g.near_m = 1.0, g.far_m = 2.0;
  EXPECT_EQ(count(trace(tracer_of(g), {{&scene}}), Miss::kTooFar), 0u);
  g.near_m = 0.1;
  g.max_incidence_rad = 0.2;
  const SampleTracer narrow = tracer_of(g);
  const SampleGrid flat = trace(narrow, {{&scene}});
  for (int column = 0; column < 160; ++column) {
    const Miss miss = miss_at(flat, column, 60);
    if (miss == Miss::kNothing) continue;
    const Vec3d d = narrow.direction(column, 60).normalized();
    EXPECT_EQ(miss, d.z() < std::cos(0.2) ? Miss::kGrazing : Miss::kNone);
  }
}

/// Every sample against single rays of the scene: the slow way.
TEST(Samples, AgreeWithSingleRaysForSeveralBodies) {
  const Scene turning = scene_of(
      {test::sphere_mesh({0.05, 0.1, 0}, 0.08, 30), test::box_mesh({-.1, 0, -.1}, {0, .2, .0})},
      0.15);
  const Scene room = scene_of(
      {test::box_mesh({-1, -.3, -1}, {1, -.2, 1}), test::box_mesh({.2, -.2, -.3}, {.3, .2, -.2})});
  for (const bool distorted : {false, true}) {
    ScannerModel g = scanner({0.4, 0.1, 0.0});
    if (distorted) g.camera.distortion = {0.1, -0.05, 0.001, 0.002, 0.0};
    const SampleTracer tracer = tracer_of(g);
    std::size_t shadows = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      Pose T = Pose::Identity();  // looks at the origin from afar
      const Vec3d eye = random_pose(seed).translation().normalized() + Vec3d(0, 0.4, 0);
      T.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), -eye).toRotationMatrix();
      T.translation() = eye;
      const Pose turned = rotation_about_y(0.7 + double(seed));
      const std::vector<Body> bodies{{&turning, turned}, {&room, Pose::Identity()}};
      const SampleGrid grid = trace(tracer, bodies, T);
      std::size_t wrong = 0, hits = 0;
      for (int row = 0; row < 120; ++row) {
        for (int column = 0; column < 160; ++column) {
          const Vec3d d = tracer.direction(column, row);
          float nearest = std::numeric_limits<float>::infinity();
          std::uint32_t body = 0, object = kNoObject;
          for (std::uint32_t b = 0; b < 2; ++b) {
            const Pose T_body = bodies[b].T_world_body.inverse() * T;
            Ray ray;
            ray.origin = T_body.translation().cast<float>();
            ray.direction = (T_body.linear() * d).cast<float>();
            const RayHit hit = bodies[b].scene->intersect(ray);
            if (hit.valid() && hit.t < nearest) nearest = hit.t, body = b, object = hit.object;
          }
          if (object == kNoObject) {
            wrong += miss_at(grid, column, row) == Miss::kNothing ? 0 : 1;
            continue;
          }
          ASSERT_TRUE(grid.contains(column, row));
          const std::size_t i = grid.index(column, row);
          ++hits;
          if (!grid.hit(i) || grid.body(i) != body || grid.object(i) != object ||
              std::abs(grid.z[i] - nearest) > 2e-6f) {
            ++wrong;
            continue;
          }
          bool blocked = false;
          const Vec3d e = T * g.emitter_m, p = T * tracer.hit_of(bodies, T, grid, i, d).p_sensor;
          for (const Body& other : bodies) {
            const Pose back = other.T_world_body.inverse();
            Ray ray;
            ray.origin = (back * e).cast<float>();
            ray.direction = (back.linear() * (p - e)).cast<float>();
            ray.t_max = 1.0f - 1e-5f;
            blocked = blocked || other.scene->occluded(ray);
          }
          shadows += blocked ? 1 : 0;
          wrong += grid.miss[i] == (blocked ? Miss::kEmitterBlocked : Miss::kNone) ? 0 : 1;
        }
      }
      EXPECT_GT(hits, 3000u);
      EXPECT_LE(wrong, 3u) << seed;  // rays that graze an edge
    }
    EXPECT_GT(shadows, 100u);
  }
}

TEST(Samples, OfAListAreThoseOfTheImage) {
  const Scene scene = scene_of({test::sphere_mesh({0, 0, 1}, 0.3, 30), wall(-2, 2, -2, 2, 1.4)});
  const SampleTracer tracer = tracer_of(scanner({0.1, 0, 0}));
  const SampleGrid grid = trace(tracer, {{&scene}});
  std::vector<float> x, y;
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      x.push_back(float(tracer.direction(column, row).x()));
      y.push_back(float(tracer.direction(column, row).y()));
    }
  }
  x[5] = std::numeric_limits<float>::quiet_NaN();
  x.push_back(0.0f), y.push_back(0.0f);  // not a whole packet
  Samples list;
  const Body body{&scene};
  tracer.trace({&body, 1}, Pose::Identity(), x, y, list);
  ASSERT_EQ(list.size(), x.size());
  EXPECT_EQ(list.miss[5], Miss::kOutOfView);
  for (std::size_t i = 6; i + 1 < list.size(); ++i) {
    ASSERT_EQ(list.miss[i], grid.miss[i]);
    ASSERT_EQ(list.surface[i], grid.surface[i]);
    ASSERT_FLOAT_EQ(list.z[i], grid.z[i]);  // on an edge either triangle may be named
  }
}

TEST(Samples, OfALineScannerAreAColumn) {
  const Scene scene = scene_of({wall(-1, 1, -1, 1, 0.5)});
  ScannerModel g = scanner();
  g.kind = ScannerKind::kLine;
  g.receiver_m = {0.1, 0, 0};
  g.camera = camera(1, 77, 100.0);
  const SampleGrid grid = trace(tracer_of(g), {{&scene}});
  EXPECT_EQ(grid.rect, (PixelRect{0, 0, 1, 77}));
  EXPECT_EQ(count(grid, Miss::kNone), 77u);
  const Scene hidden = scene_of({wall(-1, 1, -1, 1, 0.5), wall(0.02, 1, -1, 1, 0.4)});
  EXPECT_EQ(count(trace(tracer_of(g), {{&hidden}}), Miss::kReceiverBlocked), 77u);
}

TEST(Samples, OfNothingAreNone) {
  const SampleTracer tracer = tracer_of(scanner({0.1, 0, 0}));
  EXPECT_EQ(trace(tracer, {}).size(), 0u);
  const Scene empty = scene_of({});
  EXPECT_EQ(count(trace(tracer, {{&empty}}), Miss::kNone), 0u);
  const Scene behind = scene_of({wall(-1, 1, -1, 1, -0.5)});
  EXPECT_EQ(trace(tracer, {{&behind}}).size(), 0u);
}

TEST(Samples, ThrowWithoutAScene) {
  SampleGrid grid;
  const Body body;
  EXPECT_THROW(tracer_of(scanner()).trace({&body, 1}, Pose::Identity(), grid),
               std::invalid_argument);
}

/// Where the line of sight enters a box: the slabs of its three pairs of faces.
TEST(Samples, OfABoxLieWhereTheSlabsSay) {
  const Vec3d low(-0.15, -0.1, -0.12), high(0.15, 0.2, 0.1);
  const Scene scene = scene_of({test::box_mesh(low, high)});
  const SampleTracer tracer = tracer_of(scanner());
  Pose T = Pose::Identity();
  T.translation() = Vec3d(0.5, 0.6, -0.7);
  T.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), -T.translation()).toRotationMatrix();
  const SampleGrid grid = trace(tracer, {{&scene}}, T);
  std::size_t hits = 0;
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const Vec3d d = T.linear() * tracer.direction(column, row);
      const Vec3d a = (low - T.translation()).cwiseQuotient(d);
      const Vec3d b = (high - T.translation()).cwiseQuotient(d);
      const double in = a.cwiseMin(b).maxCoeff(), out = a.cwiseMax(b).minCoeff();
      if (std::abs(out - in) < 1e-5) continue;  // an edge
      ASSERT_EQ(miss_at(grid, column, row) == Miss::kNone, in < out);
      if (in > out) continue;
      ASSERT_NEAR(grid.z[grid.index(column, row)], in, 4e-7);
      ++hits;
    }
  }
  EXPECT_GT(hits, 2500u);
}

/// The plane of a line scanner cuts a cylinder along an ellipse.
TEST(Samples, OfALineAreTheSectionOfACylinder) {
  const double radius = 0.1, tilt = 0.4;
  TriangleMesh cylinder;  // along x
  constexpr std::uint32_t n = 2000;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * test::kPi * i / n;
    for (const double x : {-0.5, 0.5})
      cylinder.vertices.push_back(
          Vec3d(x, radius * std::sin(a), radius * std::cos(a)).cast<float>());
    const std::uint32_t p = 2 * i, q = 2 * ((i + 1) % n);
    cylinder.triangles.push_back({p, q, q + 1});
    cylinder.triangles.push_back({p, q + 1, p + 1});
  }
  const Scene scene = scene_of({cylinder});
  ScannerModel g = scanner();
  g.kind = ScannerKind::kLine;
  g.camera = camera(1, 401, 900.0);
  g.camera.cx = 0.0;
  const SampleTracer tracer = tracer_of(g);
  Pose T = Pose::Identity();  // looks down +z, turned about its axis
  T.linear() = Eigen::AngleAxisd(tilt, Vec3d::UnitZ()).toRotationMatrix();
  T.translation() = Vec3d(0.05, 0.0, -0.6);
  const std::vector<Body> bodies{{&scene}};
  const SampleGrid grid = trace(tracer, bodies, T);
  std::size_t hits = 0;
  for (int row = 0; row < 401; ++row) {
    if (miss_at(grid, 0, row) != Miss::kNone) continue;
    ++hits;
    const std::size_t i = grid.index(0, row);
    const Vec3d p = double(grid.z[i]) * tracer.direction(0, row);
    ASSERT_NEAR(p.x(), 0.0, 1e-12);
    // In the scanner's plane: half axes radius / cos(tilt) and radius.
    const double along = p.y() * std::cos(tilt) / radius, deep = (p.z() - 0.6) / radius;
    if (std::abs(along) > 0.95) continue;
    ASSERT_NEAR(along * along + deep * deep, 1.0, 1e-5);
  }
  // What a pinhole at 0.6 m sees of it.
  const double edge = radius / std::sqrt(0.36 - 0.01) / std::cos(tilt);
  EXPECT_NEAR(double(hits), 2 * 900.0 * edge, 2.0);
}

TEST(Samples, AreTheSameForEveryInstructionSet) {
  using namespace sampling;
  const Scene turning = scene_of({test::sphere_mesh({0.05, 0.1, 0}, 0.08, 30)}, 0.15);
  const Scene room = scene_of({test::box_mesh({-1, -.3, -1}, {1, -.2, 1})});
  const SampleTracer tracer = tracer_of(scanner({0.3, 0.1, 0.0}));
  Pose T = Pose::Identity();
  T.translation() = Vec3d(0.1, 0.5, -0.8);
  T.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), -T.translation()).toRotationMatrix();
  const std::vector<Body> bodies{{&turning, rotation_about_y(0.3)}, {&room}};
  const SampleGrid widest = trace(tracer, bodies, T);
  EXPECT_GT(count(widest, Miss::kEmitterBlocked), 10u);
  for (const auto set :
       {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (SampleKernels::find(set) == nullptr) continue;
    const SampleKernel* const before = &SampleKernels::current();
    SampleKernels::use(set);
    const SampleGrid grid = trace(tracer, bodies, T);
    for (const auto other :
         {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512})
      if (SampleKernels::find(other) == before) SampleKernels::use(other);
    EXPECT_EQ(grid.z, widest.z);
    EXPECT_EQ(grid.surface, widest.surface);
    EXPECT_EQ(grid.triangle, widest.triangle);
    EXPECT_EQ(grid.miss, widest.miss);
  }
}

TEST(Samples, OfAMeshWithDegenerateDoubleAndInvertedTrianglesAreThoseOfTheCleanOne) {
  const TriangleMesh clean = test::sphere_mesh({0, 0, 0.8}, 0.2, 40);
  TriangleMesh dirty = clean;
  for (std::size_t t = 0; t < clean.triangles.size(); ++t) {
    const auto& c = clean.triangles[t];
    if (t % 3 == 0) dirty.triangles[t] = {c[0], c[2], c[1]};
    if (t % 5 == 0) dirty.triangles.push_back(c);
    dirty.triangles.push_back({c[0], c[0], c[1]});
    dirty.triangles.push_back({c[2], c[2], c[2]});
  }
  const Scene good = scene_of({clean}), bad = scene_of({dirty});
  const SampleTracer tracer = tracer_of(scanner({0.1, 0, 0}));
  const SampleGrid a = trace(tracer, {{&good}}), b = trace(tracer, {{&bad}});
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a.miss[i], b.miss[i]);
    ASSERT_NEAR(a.z[i], b.z[i], 2e-7);
  }
}

TEST(Samples, FromWithinAnObjectSeeItsInside) {
  const Scene scene = scene_of({test::sphere_mesh({0, 0, 0}, 0.5, 40)});
  const SampleTracer tracer = tracer_of(scanner({0.1, 0, 0}));
  const SampleGrid grid = trace(tracer, {{&scene}});
  EXPECT_EQ(count(grid, Miss::kNone), 160u * 120u);
  EXPECT_NEAR(grid.z[grid.index(80, 60)], 0.5f, 2e-3);
}

struct Differences {
  std::size_t samples = 0, hit = 0, triangle = 0, z = 0, miss = 0, blocked = 0;
};

/// Of a way to trace from that with a ray for everything; both of `bodies` seen from T.
Differences differences(const ScannerModel& model, const TraceMethods& methods,
                        const std::vector<Body>& bodies, const Pose& T) {
  auto all = SampleTracer::create(model, {HitMethod::kRays, OcclusionMethod::kAllRays});
  auto tracer = SampleTracer::create(model, methods);
  EXPECT_TRUE(all && tracer);
  const SampleGrid fast = trace(*tracer, bodies, T), slow = trace(*all, bodies, T);
  EXPECT_EQ(fast.rect, slow.rect);
  Differences n;
  n.samples = slow.size();
  n.blocked = count(slow, Miss::kEmitterBlocked);
  for (std::size_t i = 0; i < fast.size(); ++i) {
    n.hit += fast.hit(i) != slow.hit(i) ? 1 : 0;
    const bool same = fast.surface[i] == slow.surface[i] && fast.triangle[i] == slow.triangle[i];
    n.triangle += same ? 0 : 1;
    n.z += same && fast.z[i] != slow.z[i] ? 1 : 0;
    n.miss += fast.miss[i] != slow.miss[i] ? 1 : 0;
  }
  return n;
}

TEST(Samples, NeedNoRayToTheEmitterWhereNothingInTheImageCanHideThem) {
  const Scene turning = scene_of(
      {test::sphere_mesh({0.05, 0.1, 0}, 0.08, 60), test::box_mesh({-.12, 0, -.1}, {-.05, .2, .0})},
      0.2);
  const Scene room =
      scene_of({test::box_mesh({-1, -.3, -1}, {1, -.2, 1}), wall(-3, 3, -3, 3, 1.5)});
  for (const Vec3d& emitter : {Vec3d(0.08, 0, 0), Vec3d(-0.2, 0, 0), Vec3d(0, 0.1, 0),
                               Vec3d(0, -0.3, 0), Vec3d(0.1, 0.1, 0), Vec3d(0.1, 0, 0.05)}) {
    ScannerModel model = scanner(emitter);
    model.camera = camera(320, 240, 300.0);
    std::size_t blocked = 0, other = 0, samples = 0, edges = 0;
    for (std::uint64_t k = 0; k < 6; ++k) {
      Pose T = Pose::Identity();
      T.translation() = Vec3d(0.2 * double(k) - 0.5, 0.5, -0.7);
      T.linear() =
          Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), Vec3d(0, 0.1, 0) - T.translation())
              .toRotationMatrix();
      for (const HitMethod hits : {HitMethod::kRays, HitMethod::kDrawn}) {
        const Differences n = differences(model, {hits, OcclusionMethod::kDoubtful},
                                          {{&turning, rotation_about_y(double(k))}, {&room}}, T);
        blocked += n.blocked;
        other += n.miss;
        samples += n.samples;
        edges += n.triangle;
        EXPECT_EQ(n.z, 0u);
      }
    }
    EXPECT_GT(blocked, 4000u);
    EXPECT_LE(other, samples / 20000) << emitter.transpose();
    EXPECT_LE(edges, samples / 10000) << emitter.transpose();
  }
}

TEST(Samples, AreHiddenFromTheEmitterByWhatLiesOutsideTheImage) {
  const Scene back = scene_of({wall(-3, 3, -3, 3, 1.0)});
  for (const double side : {-1.0, 1.0}) {
    // Halfway to the emitter, and beyond the image's border.
    const double x0 = 0.35 * side, x1 = 0.39 * side;
    const Scene beside = scene_of({wall(std::min(x0, x1), std::max(x0, x1), -1, 1, 0.4)});
    for (const bool vertical : {false, true}) {
      ScannerModel model = scanner(vertical ? Vec3d(0, 0.5 * side, 0) : Vec3d(0.5 * side, 0, 0));
      Pose turn = Pose::Identity();
      if (vertical)
        turn.linear() = Eigen::AngleAxisd(test::kPi / 2, Vec3d::UnitZ()).toRotationMatrix();
      for (const HitMethod hits : {HitMethod::kRays, HitMethod::kDrawn}) {
        const Differences n = differences(model, {hits, OcclusionMethod::kDoubtful},
                                          {{&back}, {&beside, turn}}, Pose::Identity());
        EXPECT_EQ(n.miss, 0u);
        EXPECT_GT(n.blocked, 1000u);
      }
    }
  }
}

/// A cloud of triangles of every size, slivers and needles among them.
TriangleMesh heap(std::uint64_t seed, std::size_t count, double smallest, double largest) {
  TriangleMesh mesh;
  for (std::uint64_t t = 0; t < count; ++t) {
    const auto u = [&](std::uint64_t k) { return 2.0 * uniform01(hash_key(seed, t, 3, k)) - 1.0; };
    const Vec3d middle(0.5 * u(0), 0.5 * u(1), 1.0 + 0.4 * u(2));
    const double size = smallest * std::pow(largest / smallest, 0.5 + 0.5 * u(3));
    for (std::uint64_t k = 0; k < 3; ++k)
      mesh.vertices.push_back((middle + size * Vec3d(u(4 + 3 * k), u(5 + 3 * k),
                                                     (t % 7 == 0 ? 0.001 : 1.0) * u(6 + 3 * k)))
                                  .cast<float>());
    const auto v = static_cast<std::uint32_t>(3 * t);
    mesh.triangles.push_back({v, v + 1, v + 2});
  }
  return mesh;
}

TEST(Samples, AreTheSameDrawnAsByRays) {
  const Scene dust = scene_of({heap(1, 20000, 0.0005, 0.01)});
  const Scene mixed = scene_of({heap(2, 3000, 0.0005, 0.8), heap(3, 50, 0.5, 2.0)}, 0.3);
  const Scene ball = scene_of({test::sphere_mesh({0, 0, 1}, 0.3, 150)});
  ScannerModel model = scanner({0.08, 0, 0});
  model.camera = camera(301, 203, 260.0);  // not a whole number of packets or tiles
  for (const Scene* scene : {&dust, &mixed, &ball}) {
    for (std::uint64_t k = 0; k < 4; ++k) {
      // The last is in the midst of it: things before, beside and behind the eye. None looks along
      // the ball's edges.
      Pose T = Pose::Identity();
      T.linear() = Eigen::AngleAxisd(0.3 * double(k) + 0.05, Vec3d(0.1, 1.0, 0.2).normalized())
                       .toRotationMatrix();
      T.translation() = Vec3d(0, 0, 1) - T.linear() * Vec3d(0, 0, k == 3 ? 0.05 : 1.0);
      const Differences n =
          differences(model, {HitMethod::kDrawn, OcclusionMethod::kAllRays}, {{scene}}, T);
      EXPECT_GT(n.samples, 15000u);
      EXPECT_LE(n.hit, 2u) << k;
      EXPECT_LE(n.triangle, n.samples / 3000) << k;
      EXPECT_EQ(n.z, 0u) << k;
      EXPECT_LE(n.miss, n.triangle + 2) << k;
    }
  }
}

TEST(Samples, DrawnFallBetweenNoTwoTriangles) {
  // A sheet of uneven triangles that fills the view.
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    constexpr std::uint32_t n = 60;
    TriangleMesh sheet;
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= n; ++j) {
        const bool inner = i > 0 && j > 0 && i < n && j < n;
        const auto shift = [&](std::uint64_t k) {
          return inner ? 0.9 * uniform01(hash_key(seed, i, j, k)) - 0.45 : 0.0;
        };
        sheet.vertices.push_back(Vec3d(4.0 * (i + shift(0)) / n - 2.0,
                                       4.0 * (j + shift(1)) / n - 2.0, 0.9 + 0.002 * shift(2))
                                     .cast<float>());
        if (i == n || j == n) continue;
        const std::uint32_t p = i * (n + 1) + j, q = p + n + 1;
        if ((i + j) % 2 == 0) {
          sheet.triangles.push_back({p, q, q + 1});
          sheet.triangles.push_back({p + 1, p, q + 1});
        } else {
          sheet.triangles.push_back({p, q, p + 1});
          sheet.triangles.push_back({q, q + 1, p + 1});
        }
      }
    }
    const Scene scene = scene_of({sheet});
    auto tracer = SampleTracer::create(scanner(), {HitMethod::kDrawn, OcclusionMethod::kAllRays});
    ASSERT_TRUE(tracer);
    const SampleGrid grid = trace(*tracer, {{&scene}});
    EXPECT_EQ(count(grid, Miss::kNone), 160u * 120u);
  }
}

TEST(Samples, DrawnAreTheSameForEveryInstructionSet) {
  using namespace sampling;
  const Scene scene = scene_of({heap(2, 4000, 0.0005, 0.5)}, 0.3);
  auto tracer =
      SampleTracer::create(scanner({0.1, 0, 0}), {HitMethod::kDrawn, OcclusionMethod::kDoubtful});
  ASSERT_TRUE(tracer);
  const SampleGrid widest = trace(*tracer, {{&scene}});
  const SampleKernel* const before = &SampleKernels::current();
  for (const auto set :
       {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (SampleKernels::find(set) == nullptr) continue;
    SampleKernels::use(set);
    const SampleGrid grid = trace(*tracer, {{&scene}});
    EXPECT_EQ(grid.z, widest.z);
    EXPECT_EQ(grid.surface, widest.surface);
    EXPECT_EQ(grid.triangle, widest.triangle);
    EXPECT_EQ(grid.miss, widest.miss);
  }
  for (const auto set : {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512})
    if (SampleKernels::find(set) == before) SampleKernels::use(set);
}

TEST(Samples, NeedAScannerThatCanBe) {
  ScannerModel g = scanner();
  g.near_m = 6.0;
  EXPECT_FALSE(SampleTracer::create(g));
}

}  // namespace
}  // namespace turnscan
