#include <gtest/gtest.h>

#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

TriangleMesh without(TriangleMesh mesh, const std::function<bool(const Vec3f&)>& where) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return where((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0f);
  });
  mesh::compact_vertices(mesh);
  return mesh;
}

TriangleMesh expect_closed(const TriangleMesh& mesh, const FillHolesOptions& options = {}) {
  const auto filled = fill_holes(mesh, options, RunContext());
  if (!filled) {
    ADD_FAILURE() << filled.error().text();
    return {};
  }
  const MeshReport report = check_mesh(filled->mesh);
  EXPECT_TRUE(report.closed && report.manifold && report.oriented) << report.text();
  return filled->mesh;
}

TEST(FillHoles, AClosedMeshStaysAsItIs) {
  const auto filled = fill_holes(sphere(1.0, 3), {}, RunContext());
  ASSERT_TRUE(filled);
  EXPECT_EQ(filled->holes, 0u);
  EXPECT_EQ(filled->mesh.vertices, sphere(1.0, 3).vertices);
  EXPECT_EQ(filled->mesh.triangles, sphere(1.0, 3).triangles);
  EXPECT_TRUE(fill_holes(TriangleMesh(), {}, RunContext())->mesh.empty());
}

TEST(FillHoles, ReplacesTheMissingCapOfASphereSmoothly) {
  const TriangleMesh whole = sphere(1.0, 5);
  const Vec3f pole = Vec3f(1, 1, 1).normalized();
  const TriangleMesh open = without(whole, [&](const Vec3f& p) { return p.dot(pole) > 0.9f; });
  const auto filled = fill_holes(open, {}, RunContext());
  ASSERT_TRUE(filled);
  EXPECT_EQ(filled->holes, 1u);
  EXPECT_TRUE(check_mesh(filled->mesh).watertight());
  EXPECT_NEAR(check_mesh(filled->mesh).volume_m3, check_mesh(whole).volume_m3, 0.01);
  const auto added = double(filled->mesh.triangles.size() - open.triangles.size());
  const auto missing = double(whole.triangles.size() - open.triangles.size());
  EXPECT_NEAR(added / missing, 1.0, 0.5) << "as dense as around";
  for (std::size_t t = 0; t < filled->filled.size(); ++t) {
    ASSERT_EQ(filled->filled[t], t >= open.triangles.size());
    if (filled->filled[t] == 0) continue;
    for (const std::uint32_t v : filled->mesh.triangles[t]) {
      ASSERT_NEAR(filled->mesh.vertices[v].norm(), 1.0f, 0.03f);
    }
  }
}

TEST(FillHoles, AFlatHoleStaysFlat) {
  TriangleMesh box = subdivided(cube(), 4);
  const TriangleMesh open = without(box, [](const Vec3f& p) {
    return p.z() == 1.0f && (p.head<2>() - Vec3f(0.5f, 0.5f, 0).head<2>()).norm() < 0.3f;
  });
  const TriangleMesh filled = expect_closed(open);
  EXPECT_NEAR(check_mesh(filled).volume_m3, 1.0, 1e-5);
  EXPECT_NEAR(check_mesh(filled).area_m2, 6.0, 1e-5);
}

TEST(FillHoles, AConcaveHoleIsNotOverlapped) {
  // A flat star-shaped hole of 600 edges: more than are triangulated at once.
  TriangleMesh box = subdivided(cube(), 6);
  const TriangleMesh open = without(box, [](const Vec3f& p) {
    const float x = p.x() - 0.5f, y = p.y() - 0.5f;
    return p.z() == 1.0f && std::hypot(x, y) < 0.25f + 0.15f * std::cos(7.0f * std::atan2(y, x));
  });
  EXPECT_GT(check_mesh(open).boundary_edges, 200u);
  const TriangleMesh filled = expect_closed(open, {.refine = false, .fair = false});
  EXPECT_NEAR(check_mesh(filled).area_m2, 6.0, 1e-3);
  const TriangleMesh fine = expect_closed(open);
  EXPECT_NEAR(check_mesh(fine).area_m2, 6.0, 1e-3);
}

TEST(FillHoles, ClosesTheEndsOfATube) {
  TriangleMesh tube;
  const std::uint32_t n = 500;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n;
    const double wave = 0.2 * std::sin(3.0 * u);  // its ends are not flat
    for (const double z : {0.0, 0.02, 0.98, 1.0}) {
      tube.vertices.push_back(Vec3d(0.3 * std::cos(u), 0.3 * std::sin(u), z + wave).cast<float>());
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = 4 * i + k, b = 4 * ((i + 1) % n) + k;
      tube.triangles.push_back({a, b, b + 1});
      tube.triangles.push_back({a, b + 1, a + 1});
    }
  }
  const TriangleMesh filled = expect_closed(tube);
  EXPECT_TRUE(check_mesh(filled).outward);
  EXPECT_GT(check_mesh(filled).volume_m3, 0.2827) << "the walls go on into domes";
  EXPECT_LT(check_mesh(filled).volume_m3, 0.2827 + 4.0 / 3.0 * std::numbers::pi * 0.027);
  EXPECT_EQ(check_mesh(filled).euler, 2);
}

TEST(FillHoles, HolesThatTouchAtAVertexAreClosedOneByOne) {
  TriangleMesh open = sphere(1.0, 3);
  // Remove two opposite triangles of one vertex's fan.
  std::vector<std::size_t> around;
  for (std::size_t t = 0; t < open.triangles.size(); ++t) {
    for (const std::uint32_t v : open.triangles[t]) {
      if (v == 20) around.push_back(t);
    }
  }
  ASSERT_EQ(around.size(), 6u);
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < 6; ++i) {
    std::size_t shared = 0;
    for (const std::uint32_t v : open.triangles[around[i]]) {
      for (const std::uint32_t w : open.triangles[around[0]]) shared += v == w;
    }
    if (shared == 1) opposite = i;
  }
  open.triangles.erase(open.triangles.begin() + std::ptrdiff_t(around[opposite]));
  open.triangles.erase(open.triangles.begin() + std::ptrdiff_t(around[0]));
  EXPECT_EQ(check_mesh(open).non_manifold_vertices, 1u);
  EXPECT_EQ(fill_holes(open, {}, RunContext()).error().code, ErrorCode::kFormat);
  const TriangleMesh filled = expect_closed(*make_manifold(open));
  EXPECT_TRUE(check_mesh(filled).watertight());
  EXPECT_NEAR(check_mesh(filled).area_m2, check_mesh(sphere(1.0, 3)).area_m2, 0.01);
}

TEST(FillHoles, NoEdgeIsUsedTwice) {
  // A tetrahedron without two triangles: both diagonals of the loop of four are mesh edges or
  // chords that would be.
  TriangleMesh open = tetrahedron();
  open.triangles.resize(2);
  const TriangleMesh filled = expect_closed(open, {.refine = false, .fair = false});
  EXPECT_EQ(check_mesh(filled).non_manifold_edges, 0u);
  // Every mesh edge whose removal leaves such loops, over many random holes.
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    TriangleMesh holey = sphere(1.0, 1 + int(seed % 3));
    std::size_t i = 0;
    const double keep = 0.6 - 0.01 * double(seed % 100);
    std::erase_if(holey.triangles, [&](const auto&) { return random_value(seed, ++i) > keep; });
    const auto cut = make_manifold(holey);
    ASSERT_TRUE(cut);
    expect_closed(*cut, {.refine = false, .fair = false});
    expect_closed(*cut);
  }
}

TEST(FillHoles, LeavesLoopsThatAreTooLong) {
  const TriangleMesh open = without(sphere(1.0, 4), [](const Vec3f& p) {
    return std::abs(p.z()) > 0.95f && (p.z() > 0 || p.x() < 0);
  });
  const auto filled = fill_holes(open, {.max_edges = 5}, RunContext());
  ASSERT_TRUE(filled);
  EXPECT_EQ(filled->holes, 0u);
  EXPECT_EQ(filled->mesh.triangles, open.triangles);
}

TEST(FillHoles, ColoursAndNormalsComeAlong) {
  TriangleMesh open = without(sphere(1.0, 4), [](const Vec3f& p) { return p.z() > 0.8f; });
  open.colors.assign(open.vertices.size(), {10, 20, 30});
  open.normals = vertex_normals(open);
  const TriangleMesh filled = expect_closed(open);
  ASSERT_EQ(filled.colors.size(), filled.vertices.size());
  ASSERT_EQ(filled.normals.size(), filled.vertices.size());
  EXPECT_GT(filled.vertices.size(), open.vertices.size());
  for (std::size_t v = open.vertices.size(); v < filled.vertices.size(); ++v) {
    ASSERT_EQ(filled.colors[v], (Rgb{10, 20, 30}));
    ASSERT_GT(filled.normals[v].z(), 0.5f);
  }
}

TEST(FillHoles, IsTheSameForOneAndTwoThreads) {
  const TriangleMesh open =
      without(sphere(1.0, 5), [](const Vec3f& p) { return std::abs(p.z()) > 0.8f; });
  set_thread_count(1);
  const auto one = fill_holes(open, {}, RunContext());
  set_thread_count(2);
  const auto two = fill_holes(open, {}, RunContext());
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->mesh.vertices, two->mesh.vertices);
  EXPECT_EQ(one->mesh.triangles, two->mesh.triangles);
}

TEST(FillHoles, FailsByName) {
  const RunContext context;
  context.cancel();
  EXPECT_EQ(fill_holes(plane(3), {}, context).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(fill_holes(plane(3), {.tension = 2.0}, RunContext()).error().code,
            ErrorCode::kInvalidOption);
  TriangleMesh broken = cube();
  broken.triangles[0][0] = 8;
  EXPECT_EQ(fill_holes(broken, {}, RunContext()).error().code, ErrorCode::kFormat);
}

TEST(Repair, MakesAnySoupWatertightOrSaysWhyNot) {
  std::size_t watertight = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const TriangleMesh soup = random_soup(4 + seed % 40, 1 + 5 * (seed % 50), seed);
    const auto repaired = repair(soup, {}, RunContext());
    if (!repaired) {
      ASSERT_EQ(repaired.error().code, ErrorCode::kTooFewPoints) << repaired.error().text();
      continue;
    }
    ASSERT_TRUE(check_mesh(*repaired).watertight()) << check_mesh(*repaired).text();
    ++watertight;
  }
  EXPECT_GT(watertight, 250u);
}

TEST(Repair, ClosesAPuncturedStlSoupOfSeveralFlippedPieces) {
  TriangleMesh mesh = sphere(1.0, 4);
  TriangleMesh other = torus(0.5, 0.1, 30, 20);
  move(other, Vec3f(3, 0, 0));
  flip(other);
  append(mesh, other);
  std::size_t i = 0;
  std::erase_if(mesh.triangles, [&](const auto&) { return random_value(1, ++i) > 0.95; });
  const auto repaired = repair(as_soup(mesh), {}, RunContext());
  ASSERT_TRUE(repaired) << repaired.error().text();
  EXPECT_TRUE(check_mesh(*repaired).watertight());
  EXPECT_EQ(check_mesh(*repaired).components, 2);
  EXPECT_NEAR(check_mesh(*repaired).volume_m3, 4.279, 0.05);
}

TEST(Repair, FailsByNameWhenNothingEnclosesAVolume) {
  EXPECT_EQ(repair(TriangleMesh(), {}, RunContext()).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(repair(plane(3), {}, RunContext()).error().code, ErrorCode::kTooFewPoints);
  TriangleMesh mesh = cube();
  mesh.vertices[2].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(repair(mesh, {}, RunContext()).error().code, ErrorCode::kFormat);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(repair(cube(), {}, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
