#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/coverage/coverage_patches.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

using test::kPi;

ScannerModel scanner(double emitter = 0.0) {
  ScannerModel model;
  model.camera.width = 320, model.camera.height = 240;
  model.camera.fx = model.camera.fy = 300.0;
  model.camera.cx = 159.5, model.camera.cy = 119.5;
  model.near_m = 0.3, model.far_m = 3.0;
  model.emitter_m = {emitter, 0, 0};
  return model;
}

/// At a distance from (0, aim, 0), at an elevation, on the side of -Z.
Pose looking(double distance, double elevation, double aim) {
  const double c = std::cos(elevation), s = std::sin(elevation);
  Pose T = Pose::Identity();
  T.linear().col(0) = Vec3d(-1.0, 0.0, 0.0);
  T.linear().col(1) = Vec3d(0.0, -c, -s);
  T.linear().col(2) = Vec3d(0.0, -s, c);
  T.translation() = Vec3d(0.0, aim, 0.0) - distance * T.linear().col(2);
  return T;
}

std::vector<CoveragePose> around(int n, const Pose& T, std::uint32_t scanner = 0) {
  std::vector<CoveragePose> poses;
  for (int i = 0; i < n; ++i) poses.push_back({scanner, rotation_about_y(-2.0 * kPi * i / n) * T});
  return poses;
}

CoverageMapOptions coarse() {
  CoverageMapOptions options;
  options.cell_m = 6e-3;
  return options;
}

CoverageMap map_of(const std::vector<TriangleMesh>& objects, const ScannerModel& model,
                   const std::vector<CoveragePose>& poses,
                   const CoverageMapOptions& options = coarse(),
                   std::optional<double> platter = 0.3) {
  const auto scene = Scene::create(objects, platter);
  EXPECT_TRUE(scene);
  auto map = coverage_map(*scene, objects, {&model, 1}, poses, options, RunContext());
  EXPECT_TRUE(map) << (map ? "" : map.error().text());
  return std::move(*map);
}

double area_with(const CoverageMap& map, const auto& wanted) {
  double sum = 0.0;
  for (const CoverageCell& cell : map.cells) sum += wanted(cell) ? cell.area_m2 : 0.0;
  return sum;
}

TEST(CoverageMap, OfABoxFindsItsUndersideUnreachableAndTheRestCovered) {
  const CoverageMap map = map_of({test::box_mesh({-.1, 0, -.1}, {.1, .15, .1})}, scanner(),
                                 around(24, looking(0.9, 0.5, 0.07)));
  const double under = 0.2 * 0.2, all = 2 * under + 4 * 0.2 * 0.15;
  EXPECT_NEAR(map.area_m2, all, 1e-6);
  EXPECT_NEAR(map.covered(), 1.0 - under / all, 1e-6);
  EXPECT_NEAR(map.covered_of_reachable(), 1.0, 1e-6);
  EXPECT_NEAR(map.state_m2[std::size_t(CoverageState::kUnreachable)], under, 1e-6);
  ASSERT_EQ(map.holes.size(), 1u);
  EXPECT_EQ(map.hole_count, 1u);
  EXPECT_LT(map.holes[0].center.norm(), 1e-6);
  EXPECT_NEAR(map.holes[0].size_m.x(), 0.2, 1e-6);
  EXPECT_EQ(map.holes[0].reason, Miss::kReceiverBlocked);
  EXPECT_NEAR(map.holes[0].unreachable_m2, under, 1e-6);
}

/// A pixel covers z^2 / f^2 of a plane that faces the camera.
TEST(CoverageMap, CountsTheDensityThatAPinholeHas) {
  TriangleMesh plate;
  plate.vertices = {{-.3f, .2f, 0}, {.3f, .2f, 0}, {.3f, .6f, 0}, {-.3f, .6f, 0}};
  plate.triangles = {{0, 2, 1}, {0, 3, 2}};
  CoverageMapOptions options;
  options.cell_m = 0.02;
  std::vector<CoveragePose> poses;
  for (int i = 0; i < 7; ++i) {
    Pose T = looking(1.0, 0.0, 0.4);
    T.translation() += Vec3d(1e-3 * i, 7e-4 * i, 0.0);
    poses.push_back({0, T});
  }
  const CoverageMap map = map_of({plate}, scanner(), poses, options);
  const double density = 7 * 300.0 * 300.0 * 1e-6;
  double sum = 0.0;
  for (const CoverageCell& cell : map.cells) {
    EXPECT_EQ(cell.views, 7u);
    EXPECT_NEAR(cell.density_per_mm2(), density, 0.35 * density);
    const double angle = std::atan(std::hypot(cell.center.x(), cell.center.y() - 0.4));
    EXPECT_NEAR(cell.best_incidence_rad, angle, 0.03);
    sum += cell.samples;
  }
  EXPECT_NEAR(sum / (1e6 * map.area_m2), density, 0.01 * density);
  EXPECT_EQ(sum, double(map.samples));
  double of_patches = 0.0;
  for (const CoveragePatch& patch : map.patches) of_patches += patch.samples;
  EXPECT_EQ(of_patches, sum);
  options.thin_per_mm2 = 2.0 * density;
  const CoverageMap thin = map_of({plate}, scanner(), poses, options);
  EXPECT_NEAR(thin.state_m2[std::size_t(CoverageState::kThin)], thin.area_m2, 1e-9);
}

TEST(CoverageMap, CutsLargeFacesToTheSizeOfACell) {
  const CoverageMap map = map_of({test::box_mesh({-.1, 0, -.1}, {.1, .2, .1})}, scanner(),
                                 around(3, looking(0.9, 0.5, 0.1)));
  double area = 0.0;
  for (const CoveragePatch& patch : map.patches) {
    for (int k = 0; k < 3; ++k)
      EXPECT_LE((patch.corners[std::size_t(k)] - patch.corners[std::size_t((k + 1) % 3)]).norm(),
                6.001e-3f);
    area += 0.5 * double((patch.corners[1] - patch.corners[0])
                             .cross(patch.corners[2] - patch.corners[0])
                             .norm());
    EXPECT_LT(patch.face, 12u);
    ASSERT_LT(patch.cell, map.cells.size());
  }
  EXPECT_NEAR(area, 6 * 0.04, 1e-6);
}

/// A shelf at depth dz behind a wall: b * dz / z of it lies in the umbra, seen by the receiver
/// only.
TEST(CoverageMap, FarFromTheOriginFacesAreCutNoFinerThanFloatsAre) {
  TriangleMesh mesh;
  mesh.vertices = {Vec3f(9e5f, 0, 0), Vec3f(9e5f + 1.0f, 0, 0), Vec3f(9e5f, 1.0f, 9e5f)};
  mesh.triangles = {{0, 1, 2}};
  const coverage::CoveragePatches patches(std::span(&mesh, 1), 1e-3);
  EXPECT_FALSE(patches.patches.empty());
  EXPECT_LT(patches.patches.size(), 4'001'000u);  // those that were begun at the limit are finished
}

TEST(CoverageMap, GivesTheUmbraOfASlotToTheEmitter) {
  const double b = 0.2, z = 0.8, dz = 0.2;
  TriangleMesh front, back;
  const auto wall = [](double x0, double x1, double depth) {
    TriangleMesh mesh;
    for (const auto& [x, y] : {std::pair(x0, 0.2), {x1, 0.2}, {x1, 0.5}, {x0, 0.5}})
      mesh.vertices.push_back(Vec3d(x, y, depth).cast<float>());
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    return mesh;
  };
  // The sensor's x axis is -X.
  front = wall(-0.3, 0.0, z - 1.0);
  back = wall(-0.3, 0.15, z + dz - 1.0);
  CoverageMapOptions options;
  options.cell_m = 5e-3;
  ScannerModel model = scanner(b);
  model.camera.width = 640, model.camera.height = 480;
  model.camera.fx = model.camera.fy = 1000.0;
  model.camera.cx = 319.5, model.camera.cy = 239.5;
  std::vector<CoveragePose> poses;
  for (int i = 0; i < 3; ++i) {
    poses.push_back({0, looking(1.0, 0.0, 0.35)});
    poses.back().T_table_sensor.translation().y() += 3e-4 * i;
  }
  const CoverageMap map = map_of({front, back}, model, poses, options, {});
  EXPECT_NEAR(area_with(map, [](const auto& c) { return c.reason == Miss::kEmitterBlocked; }),
              0.3 * b * dz / z, 0.3 * 2 * options.cell_m);
  EXPECT_NEAR(area_with(map, [](const auto& c) { return c.reason == Miss::kReceiverBlocked; }),
              0.3 * 0.3, 0.3 * 2 * options.cell_m);
}

TEST(CoverageMap, NamesRangeViewAndFlatness) {
  const std::vector<TriangleMesh> box{test::box_mesh({-.1, 0, -.1}, {.1, .2, .1})};
  const auto reason = [&](const ScannerModel& model, const Pose& T) {
    const CoverageMap map = map_of(box, model, around(12, T));
    EXPECT_EQ(map.covered(), 0.0);
    // Of the sides; the top may be out of sight.
    return area_with(map, [](const auto& c) { return c.reason == Miss::kTooFar; }) > 0.1
               ? Miss::kTooFar
           : area_with(map, [](const auto& c) { return c.reason == Miss::kTooNear; }) > 0.1
               ? Miss::kTooNear
           : area_with(map, [](const auto& c) { return c.reason == Miss::kOutOfView; }) > 0.1
               ? Miss::kOutOfView
               : Miss::kNone;
  };
  const Pose T = looking(0.9, 0.5, 0.1);
  ScannerModel model = scanner();
  model.near_m = 0.05, model.far_m = 0.3;
  EXPECT_EQ(reason(model, T), Miss::kTooFar);
  model.near_m = 1.5, model.far_m = 3.0;
  EXPECT_EQ(reason(model, T), Miss::kTooNear);
  Pose away = T;
  away.linear() = T.linear() * rotation_about_y(kPi / 2).linear();
  EXPECT_EQ(reason(scanner(), away), Miss::kOutOfView);
  model = scanner();
  model.max_incidence_rad = 30.0 * kPi / 180.0;
  const CoverageMap flat = map_of(box, model, around(12, looking(0.9, 0.3, 0.1)));
  EXPECT_NEAR(area_with(flat, [](const auto& c) { return c.reason == Miss::kGrazing; }), 0.04,
              1e-3);  // the top
}

TEST(CoverageMap, OfALineScannerThatSweepsIsThatOfWhatItsLineCrosses) {
  ScannerModel line = scanner();
  line.kind = ScannerKind::kLine;
  line.camera.width = 1;
  line.camera.cx = 0.0;
  line.receiver_m = {0.1, 0, 0};
  line.emitter_m = Vec3d::Zero();
  const CoverageMap map = map_of({test::sphere_mesh({0, 0.12, 0}, 0.1, 60)}, line,
                                 around(720, looking(0.9, 0.0, 0.12)));
  EXPECT_GT(map.covered(), 0.9);
  // Its poles are too flat.
  EXPECT_GT(area_with(map, [](const auto& c) { return c.reason == Miss::kGrazing; }), 0.0);
}

/// A line scanner's rays start at the laser. What lies in the shadow of a rod beside the line of
/// sight of its camera only, the camera misses.
TEST(CoverageMap, TellsLaserAndCameraOfALineScannerApart) {
  ScannerModel line = scanner();
  line.kind = ScannerKind::kLine;
  line.camera.width = 1;
  line.camera.cx = 0.0;
  line.emitter_m = Vec3d::Zero();
  line.receiver_m = {0.3, 0, 0};
  TriangleMesh plate;
  plate.vertices = {{-.1f, .1f, 0}, {.1f, .1f, 0}, {.1f, .3f, 0}, {-.1f, .3f, 0}};
  plate.triangles = {{0, 2, 1}, {0, 3, 2}};
  // Sweeps over the plate without turning; the camera is at its side, behind a wall that moves not.
  std::vector<CoveragePose> poses;
  for (int i = 0; i <= 200; ++i) {
    poses.push_back({0, looking(0.8, 0.0, 0.2)});
    poses.back().T_table_sensor.translation().x() = -0.12 + 0.24 * i / 200.0;
  }
  const TriangleMesh wall = test::box_mesh({-0.5, 0, -0.45}, {-0.13, 0.4, -0.4});
  const CoverageMap map = map_of({plate, wall}, line, poses, coarse(), {});
  double receiver = 0.0, emitter = 0.0;
  for (const CoveragePatch& patch : map.patches) {
    if (patch.object != 0) continue;
    receiver += map.cells[patch.cell].reason == Miss::kReceiverBlocked ? 1 : 0;
    emitter += map.cells[patch.cell].reason == Miss::kEmitterBlocked ? 1 : 0;
  }
  EXPECT_GT(receiver, 10.0);
  EXPECT_EQ(emitter, 0.0);
}

TEST(CoverageMap, IsTheSameForEveryNumberOfThreads) {
  const auto map = [] {
    return map_of(
        {test::sphere_mesh({0, 0.1, 0}, 0.1, 50), test::box_mesh({.1, 0, -.1}, {.2, .2, 0})},
        scanner(0.1), around(40, looking(0.8, 0.4, 0.1)));
  };
  set_thread_count(1);
  const CoverageMap one = map();
  set_thread_count(4);
  const CoverageMap four = map();
  set_thread_count(0);
  ASSERT_EQ(one.cells.size(), four.cells.size());
  for (std::size_t c = 0; c < one.cells.size(); ++c) {
    ASSERT_EQ(one.cells[c].samples, four.cells[c].samples);
    ASSERT_EQ(one.cells[c].views, four.cells[c].views);
    ASSERT_EQ(one.cells[c].best_incidence_rad, four.cells[c].best_incidence_rad);
    ASSERT_EQ(one.cells[c].reason, four.cells[c].reason);
    ASSERT_EQ(one.cells[c].state, four.cells[c].state);
    ASSERT_EQ(one.cells[c].hole, four.cells[c].hole);
  }
}

TEST(CoverageMap, CountsASampleInThePatchThatItHits) {
  // One frame, one triangle, one patch after the other: the slow way.
  TriangleMesh triangle;
  triangle.vertices = {{-.11f, .2f, .03f}, {.17f, .25f, -.02f}, {-.02f, .51f, .05f}};
  triangle.triangles = {{0, 2, 1}};
  CoverageMapOptions options;
  options.cell_m = 0.03;
  const std::vector<CoveragePose> poses{{0, looking(0.8, 0.1, 0.3)}};
  const CoverageMap map = map_of({triangle}, scanner(), poses, options, {});
  EXPECT_GT(map.patches.size(), 50u);
  const Pose T_sensor_table = poses[0].T_table_sensor.inverse();
  const ScannerModel model = scanner();
  for (const CoveragePatch& patch : map.patches) {
    // Pixels whose centre lies within the patch's image: three half planes.
    std::array<Eigen::Vector2d, 3> q;
    for (std::size_t k = 0; k < 3; ++k)
      q[k] = model.camera.project(T_sensor_table * patch.corners[k].cast<double>());
    std::uint32_t sure = 0, perhaps = 0;
    for (int v = 0; v < model.camera.height; ++v) {
      for (int u = 0; u < model.camera.width; ++u) {
        double least = 1e9, most = -1e9;
        for (std::size_t k = 0; k < 3; ++k) {
          const Eigen::Vector2d e = q[(k + 1) % 3] - q[k], w = Eigen::Vector2d(u, v) - q[k];
          const double side = (e.x() * w.y() - e.y() * w.x()) / e.norm();
          least = std::min(least, side), most = std::max(most, side);
        }
        const double inside = std::max(least, -most);
        sure += inside > 1e-3, perhaps += inside > -1e-3;
      }
    }
    EXPECT_GE(patch.samples, sure);
    EXPECT_LE(patch.samples, perhaps);
  }
}

TEST(CoverageMap, PredictsTheSigmaOfItsBestSample) {
  ScannerModel model = scanner();
  model.noise.axial_constant_m = 0.002;
  const CoverageMap map = map_of({test::box_mesh({-.1, 0, -.1}, {.1, .15, .1})}, model,
                                 around(12, looking(0.9, 0.5, 0.07)));
  for (const CoverageCell& cell : map.cells) {
    if (cell.samples > 0)
      EXPECT_FLOAT_EQ(float(cell.best_sigma_m), 0.002f);
    else
      EXPECT_TRUE(std::isnan(cell.best_sigma_m));
  }
}

TEST(CoverageMap, TakesDarkSurfacesOutOnlyWhereNoiseIsAskedFor) {
  ScannerModel model = scanner();
  model.noise.dark_signal_per_m2 = 0.2;
  TriangleMesh box = test::box_mesh({-.1, 0, -.1}, {.1, .15, .1});
  box.colors.assign(box.vertices.size(), Rgb{5, 5, 5});
  const auto poses = around(12, looking(0.9, 0.5, 0.07));
  CoverageMapOptions options = coarse();
  EXPECT_GT(map_of({box}, model, poses, options).covered(), 0.7);
  options.noise = true;
  const CoverageMap dark = map_of({box}, model, poses, options);
  EXPECT_EQ(dark.covered(), 0.0);
  EXPECT_GT(dark.reason_m2[std::size_t(Miss::kTooDark)], 0.1);
}

TEST(CoverageMap, ColoursAMeshOfItsPatches) {
  const CoverageMap map = map_of({test::box_mesh({-.1, 0, -.1}, {.1, .15, .1})}, scanner(),
                                 around(12, looking(0.9, 0.5, 0.07)));
  const TriangleMesh mesh = coverage_mesh(map, {});
  ASSERT_EQ(mesh.triangles.size(), map.patches.size());
  ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
  for (std::size_t p = 0; p < map.patches.size(); ++p) {
    const bool unreachable = map.cells[map.patches[p].cell].state == CoverageState::kUnreachable;
    ASSERT_EQ(mesh.colors[3 * p] == (Rgb{85, 85, 90}), unreachable);
  }
}

TEST(CoverageMap, IsNotMadeWithoutFacesOrScannersOrForAScannerThatIsNotThere) {
  const std::vector<TriangleMesh> box{test::box_mesh({-.1, 0, -.1}, {.1, .2, .1})}, none(1);
  const auto scene = Scene::create(box), bare = Scene::create(none);
  const ScannerModel model = scanner();
  const std::vector<CoveragePose> second{{1, Pose::Identity()}};
  const RunContext context;
  const auto code = [](const auto& result) {
    return result ? ErrorCode::kCancelled : result.error().code;
  };
  EXPECT_EQ(code(coverage_map(*bare, none, {&model, 1}, {}, {}, context)),
            ErrorCode::kTooFewPoints);
  EXPECT_EQ(code(coverage_map(*scene, box, {}, {}, {}, context)), ErrorCode::kInvalidOption);
  EXPECT_EQ(code(coverage_map(*scene, box, {&model, 1}, second, {}, context)),
            ErrorCode::kInvalidOption);
  CoverageMapOptions options;
  options.cell_m = 0.0;
  EXPECT_EQ(code(coverage_map(*scene, box, {&model, 1}, {}, options, context)),
            ErrorCode::kInvalidOption);
  options = {};
  options.thin_per_mm2 = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code(coverage_map(*scene, box, {&model, 1}, {}, options, context)),
            ErrorCode::kInvalidOption);
  options = {};
  options.holes = -1;
  EXPECT_EQ(code(coverage_map(*scene, box, {&model, 1}, {}, options, context)),
            ErrorCode::kInvalidOption);
  // Without a frame nothing is covered.
  const auto empty = coverage_map(*scene, box, {&model, 1}, {}, {}, context);
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->covered(), 0.0);
}

TEST(CoverageMap, CanBeCancelled) {
  const std::vector<TriangleMesh> box{test::box_mesh({-.1, 0, -.1}, {.1, .2, .1})};
  const auto scene = Scene::create(box);
  const ScannerModel model = scanner();
  const auto poses = around(12, looking(0.9, 0.5, 0.07));
  for (const char* phase : {"coverage", "reasons"}) {
    RunContext context;
    context.set_listener([&](const Progress& p) {
      if (p.phase == phase) context.cancel();
    });
    const auto map = coverage_map(*scene, box, {&model, 1}, poses, coarse(), context);
    context.set_listener({});
    ASSERT_FALSE(map);
    EXPECT_EQ(map.error().code, ErrorCode::kCancelled);
  }
}

/// A box upright, and on its head 20 mm beside the axis.
TEST(CoverageMap, OfTwoPassesIsThatOfBothOnTheSameSurface) {
  const std::vector<TriangleMesh> box{test::box_mesh({-.05, 0, -.05}, {.05, .1, .05})};
  Pose T_second_first = Pose::Identity();
  T_second_first.linear() = Eigen::AngleAxisd(kPi, Vec3d::UnitX()).toRotationMatrix();
  T_second_first.translation() = Vec3d(0.02, 0.1, 0.0);
  std::vector<TriangleMesh> turned = box;
  for (Vec3f& p : turned[0].vertices) p = (T_second_first * p.cast<double>()).cast<float>();
  const auto scene = Scene::create(box, 0.3), second = Scene::create(turned, 0.3);
  ASSERT_TRUE(scene && second);
  const ScannerModel model = scanner();
  std::vector<CoveragePose> poses = around(24, looking(0.9, 0.4, 0.05));
  const CoverageMap once = map_of(box, model, poses), other = map_of(turned, model, poses);
  for (int i = 0; i < 24; ++i) {
    poses.push_back(poses[std::size_t(i)]);
    poses.back().pass = 1;
  }
  const std::vector<CoveragePass> further{{&*second, T_second_first.inverse()}};
  const auto both =
      coverage_map(*scene, box, {&model, 1}, poses, coarse(), RunContext(), nullptr, further);
  ASSERT_TRUE(both) << both.error().text();
  EXPECT_EQ(both->samples, once.samples + other.samples);
  EXPECT_NEAR(once.covered(), 5.0 / 6.0, 0.01);
  EXPECT_NEAR(both->covered(), 1.0, 0.001);
  EXPECT_GT(once.state_m2[std::size_t(CoverageState::kUnreachable)], 0.0095);
  EXPECT_EQ(both->state_m2[std::size_t(CoverageState::kUnreachable)], 0.0);
  // A second pass without frames still reaches nothing new; one that is not there is refused.
  poses.resize(24);
  const auto idle =
      coverage_map(*scene, box, {&model, 1}, poses, coarse(), RunContext(), nullptr, further);
  ASSERT_TRUE(idle);
  EXPECT_EQ(idle->state_m2, once.state_m2);
  poses.back().pass = 2;
  EXPECT_FALSE(
      coverage_map(*scene, box, {&model, 1}, poses, coarse(), RunContext(), nullptr, further));
}

/// The room stands still: turned with the table's frame, it hides from that frame only.
TEST(CoverageMap, FindsWhatTheRoomHides) {
  const std::vector<TriangleMesh> box{test::box_mesh({-.1, 0, -.1}, {.1, .15, .1})};
  // Before the scanner, as wide as the box's lower half.
  const std::vector<TriangleMesh> shelf{test::box_mesh({-.5, -.01, -.45}, {.5, .075, -.44})};
  const auto scene = Scene::create(box), room = Scene::create(shelf);
  ASSERT_TRUE(scene && room);
  const ScannerModel model = scanner();
  std::vector<CoveragePose> poses;
  for (int i = 0; i < 24; ++i) {
    const Pose T = rotation_about_y(-2.0 * kPi * i / 24);
    poses.push_back({0, T * looking(0.9, 0.0, 0.075), T});
  }
  const auto covered = [&](const Scene* standing) {
    const auto map =
        coverage_map(*scene, box, {&model, 1}, poses, coarse(), RunContext(), standing);
    EXPECT_TRUE(map);
    return std::pair(area_with(*map,
                               [](const CoverageCell& c) {
                                 return c.samples > 0 && std::abs(c.center.y() - .03) < .02;
                               }),
                     *map);
  };
  EXPECT_GT(covered(nullptr).first, 0.8 * 0.2 * 0.04 * 4);
  const auto [low, map] = covered(&*room);
  EXPECT_EQ(low, 0.0);
  const double hidden = area_with(map, [](const CoverageCell& c) {
    return c.reason == Miss::kReceiverBlocked && c.state == CoverageState::kMissed;
  });
  EXPECT_NEAR(hidden, 4 * 0.2 * 0.075, 0.15 * 4 * 0.2 * 0.075);
}

}  // namespace
}  // namespace turnscan
