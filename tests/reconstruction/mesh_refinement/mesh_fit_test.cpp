#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tests/reconstruction/mesh_refinement/ball_mesh.hpp>
#include <tests/reconstruction/turning_scan.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {
namespace {

using namespace turnscan::testing;

/// The triangles within `rings` of the vertices, and where those are in what it gives.
TriangleMesh around(const TriangleMesh& mesh, std::vector<std::uint32_t>& vertices, int rings) {
  std::vector<bool> in(mesh.vertices.size(), false);
  for (const std::uint32_t v : vertices) in[v] = true;
  TriangleMesh out;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<bool> before = in;
    out.triangles.clear();
    for (const auto& t : mesh.triangles) {
      if (!before[t[0]] && !before[t[1]] && !before[t[2]]) continue;
      out.triangles.push_back(t);
      for (const std::uint32_t v : t) in[v] = true;
    }
  }
  std::vector<std::uint32_t> place(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (!in[v]) continue;
    place[v] = std::uint32_t(out.vertices.size());
    out.vertices.push_back(mesh.vertices[v]);
  }
  for (auto& t : out.triangles) t = {place[t[0]], place[t[1]], place[t[2]]};
  for (std::uint32_t& v : vertices) v = place[v];
  return out;
}

TEST(MeshFit, LeavesOutOnlyViewsThatSeeNothingOfAPatch) {
  const std::vector<views::DepthView> views = views_of(scan(ball, {24, 0.001}));
  const TriangleMesh mesh = ball_mesh();
  MeshFitScale scale;
  scale.iterations = 0;
  const auto all = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(all) << all.error().text();
  double total = 0.0;
  for (std::uint32_t probe = 900; probe < 7000; probe += 611) {
    // Two places on opposite sides: no view is turned away from both.
    std::vector<std::uint32_t> places{probe, probe + 8010};
    const TriangleMesh part = around(mesh, places, 5);
    ASSERT_LT(part.vertices.size(), 256u);
    const auto alone = fit_mesh(part, views, scale, RunContext());
    ASSERT_TRUE(alone) << alone.error().text();
    EXPECT_EQ(alone->support[places[0]], all->support[probe]) << probe;
    EXPECT_EQ(alone->support[places[1]], all->support[probe + 8010]) << probe;
    total += all->support[probe] + all->support[probe + 8010];
  }
  EXPECT_GT(total, 20.0);
}

TEST(MeshFit, BringsVerticesBackToWhatWasMeasured) {
  const MemorySequence sequence = scan(ball, {60, 0.001});
  ReconstructOptions options = volumetric();
  options.volumetric.fit = false;
  auto result = reconstruct(sequence, options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  TriangleMesh mesh = result->objects[0].mesh;
  for (Vec3f& v : mesh.vertices) v += 0.0007f * (v - kCenter.cast<float>()).normalized();
  const std::vector<views::DepthView> views = views_of(sequence);
  MeshFitScale scale;
  scale.noise_m = 0.001;
  scale.reach_m = 0.0015;
  const auto fitted = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  EXPECT_GT(median_error_to_ball(mesh), 0.0005);
  EXPECT_LT(median_error_to_ball(fitted->mesh), 0.0002);
}

TEST(MeshFit, FollowsAPlaceThatIsNoisierThanTheRest) {
  // A dark ball: its measurements scatter twice as far as the noise says.
  const std::vector<views::DepthView> views = views_of(scan(ball, {40, 0.002}));
  TriangleMesh mesh = ball_mesh();
  for (Vec3f& v : mesh.vertices) v += 0.003f * (v - kCenter.cast<float>()).normalized();
  MeshFitScale scale;
  scale.noise_m = 0.001;
  scale.reach_m = 0.003;
  scale.limit_m = 0.004;
  const auto fitted = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  EXPECT_LT(median_error_to_ball(fitted->mesh), 0.0008);
}

MeshFit fit_of_ball(const std::vector<views::DepthView>& views) {
  MeshFitScale scale;
  scale.noise_m = 0.001;
  scale.reach_m = 0.003;
  const auto fitted = fit_mesh(ball_mesh(), views, scale, RunContext());
  EXPECT_TRUE(fitted);
  return *fitted;
}

TEST(MeshFit, StatesTheNoiseThatItLeaves) {
  for (const int frames : {8, 24, 120}) {
    const MeshFit fitted = fit_of_ball(views_of(scan(ball, {frames, 0.001})));
    ASSERT_TRUE(fitted.noise_share);
    std::vector<double> ratios;
    for (std::size_t v = 0; v < fitted.support.size(); ++v) {
      const Vec3d arm = fitted.mesh.vertices[v].cast<double>() - kCenter;
      if (arm.y() < 0.0 || !(fitted.support[v] > 0.1f)) continue;
      const double stated =
          *fitted.noise_share * 0.001 / std::sqrt(1.0 + double(fitted.support[v]));
      ratios.push_back(std::abs(arm.norm() - kRadius) / stated);
    }
    const double ratio = median(ratios) / 0.6745;
    EXPECT_GT(ratio, 0.7) << frames;
    EXPECT_LT(ratio, 1.4) << frames;
  }
}

TEST(MeshFit, LeavesMoreWhereSidesDisagree) {
  std::vector<views::DepthView> views = views_of(scan(ball, {48, 0.001}));
  const auto before = fit_of_ball(views).noise_share;
  for (std::size_t i = 0; i < views.size(); ++i)
    views[i].translation.z() += i / 4 % 2 == 0 ? 0.001f : -0.001f;
  EXPECT_GT(fit_of_ball(views).noise_share.value(), 1.5 * before.value());
}

TEST(MeshFit, DoesNotKnowTheNoiseOfASingleView) {
  std::vector<views::DepthView> views = views_of(scan(ball, {48, 0.001}));
  views.resize(1);
  EXPECT_FALSE(fit_of_ball(views).noise_share);
}

TEST(MeshFit, WallsStandStraightOnThePlatter) {
  // An upright tube of rings 1 mm apart; every other vertex of the lower four stands out.
  constexpr std::uint32_t kRings = 20, kAround = 60;
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r < kRings; ++r) {
    for (std::uint32_t a = 0; a < kAround; ++a) {
      const double turn = 2.0 * std::numbers::pi * a / kAround;
      const double radius = 0.01 + (r < 4 && a % 2 == 0 ? 0.0006 : 0.0);
      mesh.vertices.push_back(
          Vec3d(radius * std::cos(turn), 0.001 * r, -radius * std::sin(turn)).cast<float>());
      if (r + 1 == kRings) continue;
      const std::uint32_t v = r * kAround + a, beside = v - a + (a + 1) % kAround;
      mesh.triangles.push_back({v, beside, v + kAround});
      mesh.triangles.push_back({beside, beside + kAround, v + kAround});
    }
  }
  MeshFitScale scale;
  scale.stiffness = 0.0;
  scale.limit_m = 0.002;
  scale.floor_height_m = 0.0035;
  const auto fitted = fit_mesh(mesh, {}, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  for (std::uint32_t v = 0; v < 4 * kAround; ++v) {
    const Vec3f& p = fitted->mesh.vertices[v];
    EXPECT_NEAR(std::hypot(p.x(), p.z()), 0.01, 0.0003) << v;
    EXPECT_EQ(p.y(), mesh.vertices[v].y());
  }
}

/// Smallest cosine between a triangle's normals in the two meshes.
float least_turn(const TriangleMesh& before, const TriangleMesh& after) {
  float least = 1.0f;
  for (const auto& t : before.triangles) {
    const auto normal = [&](const std::vector<Vec3f>& p) {
      return Vec3f((p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized());
    };
    least = std::min(least, normal(before.vertices).dot(normal(after.vertices)));
  }
  return least;
}

TEST(TakeSteps, NoneTurnsATriangleOverHoweverLarge) {
  const TriangleMesh mesh = ball_mesh();  // edges of 0.5 to 1 mm
  for (const float size : {0.0002f, 0.001f, 0.01f}) {
    std::vector<Vec3f> step(mesh.vertices.size());
    for (std::size_t v = 0; v < step.size(); ++v) {
      for (std::uint64_t a = 0; a < 3; ++a)
        step[v][int(a)] = size * float(standard_normal(hash_key(v, a, 3)));
    }
    TriangleMesh moved = mesh;
    take_steps(moved, step);
    EXPECT_GE(least_turn(mesh, moved), kMinTurn - 1e-4f) << size;
    EXPECT_NE(moved.vertices, mesh.vertices) << size;
  }
}

TEST(TakeSteps, ThatFoldNothingAreTakenWhole) {
  const TriangleMesh mesh = ball_mesh();
  TriangleMesh moved = mesh;
  take_steps(moved, std::vector<Vec3f>(mesh.vertices.size(), Vec3f(0.1f, -0.2f, 0.3f)));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_EQ(moved.vertices[v], Vec3f(mesh.vertices[v] + Vec3f(0.1f, -0.2f, 0.3f)));
}

/// Share of the edges whose two triangles face away from each other.
double folded_share(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3f> normals;
  for (const auto& t : mesh.triangles) {
    const auto& p = mesh.vertices;
    const Vec3f n = (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).normalized();
    for (std::size_t c = 0; c < 3; ++c) normals[{t[c], t[(c + 1) % 3]}] = n;
  }
  const auto folded = std::count_if(normals.begin(), normals.end(), [&](const auto& edge) {
    return edge.second.dot(normals.at({edge.first.second, edge.first.first})) < -0.2f;
  });
  return double(folded) / double(normals.size());
}

/// Distance to an upright disc around the axis.
double to_disc(const Vec3d& o, const Vec3d& d, double low, double high, double radius) {
  const double a = d.x() * d.x() + d.z() * d.z(), b = o.x() * d.x() + o.z() * d.z();
  const double q = b * b - a * (o.x() * o.x() + o.z() * o.z() - radius * radius);
  if (!(q > 0.0)) return 0.0;
  const double in = (high - o.y()) / d.y(), out = (low - o.y()) / d.y();
  const double near = std::max((-b - std::sqrt(q)) / a, std::min(in, out));
  return near < std::min((-b + std::sqrt(q)) / a, std::max(in, out)) ? near : 0.0;
}

TEST(MeshFit, TheBrimOfAHatIsNotFolded) {
  // Its rim scatters by what is measured beside it. Taken for a noisy place, so that measurements
  // count from farther away, one edge in 500 was folded.
  const auto hat = [](const Vec3d& o, const Vec3d& d) {
    return nearer(to_disc(o, d, 0.054, 0.058, 0.05),
                  to_box(o, d, Vec3d(-0.02, 0, -0.02), Vec3d(0.02, 0.08, 0.02)));
  };
  ReconstructOptions options = volumetric();
  options.finish.triangles = "all";
  const auto result = reconstruct(scan(hat, {60, 0.002}), options, {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT(folded_share(result->objects[0].mesh), 0.0005);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
