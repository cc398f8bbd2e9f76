#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tests/reconstruction/turning_scan.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {
namespace {

using namespace turnscan::testing;

/// A ball of rings of quads, open at the poles.
TriangleMesh ball_mesh() {
  constexpr std::uint32_t kRings = 90, kAround = 180;
  TriangleMesh mesh;
  for (std::uint32_t r = 1; r < kRings; ++r) {
    for (std::uint32_t a = 0; a < kAround; ++a) {
      const double up = std::numbers::pi * r / kRings, turn = 2.0 * std::numbers::pi * a / kAround;
      const Vec3d n(std::sin(up) * std::cos(turn), std::cos(up), std::sin(up) * std::sin(turn));
      mesh.vertices.push_back((kCenter + kRadius * n).cast<float>());
      if (r + 1 == kRings) continue;
      const std::uint32_t v = (r - 1) * kAround + a, beside = v - a + (a + 1) % kAround;
      mesh.triangles.push_back({v, beside, v + kAround});
      mesh.triangles.push_back({beside, beside + kAround, v + kAround});
    }
  }
  return mesh;
}

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
  // A dark ball: its measurements scatter four times as far as the noise says.
  const std::vector<views::DepthView> views = views_of(scan(ball, {40, 0.004}));
  TriangleMesh mesh = ball_mesh();
  for (Vec3f& v : mesh.vertices) v += 0.005f * (v - kCenter.cast<float>()).normalized();
  MeshFitScale scale;
  scale.noise_m = 0.001;
  scale.reach_m = 0.003;
  scale.limit_m = 0.004;
  const auto fitted = fit_mesh(mesh, views, scale, RunContext());
  ASSERT_TRUE(fitted) << fitted.error().text();
  EXPECT_LT(median_error_to_ball(fitted->mesh), 0.0008);
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
    EXPECT_GE(least_turn(mesh, moved), kLeastTurn - 1e-4f) << size;
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

/// A roof: vertices 1 mm apart, a ridge along z at column kRidge, sides that fall by 45 degrees.
/// The same again 20 mm below, so that the mesh is closed.
constexpr std::uint32_t kRidge = 20, kColumns = 41, kRows = 60;
struct Roof {
  TriangleMesh mesh;
  std::vector<Vec3f> normals;
  VertexMeasurements measured;  ///< one of each vertex
  MeshFitScale scale;

  Roof() {
    add_sheet(0.0f, false);
    add_sheet(-0.02f, true);
    std::vector<std::uint32_t> border;
    for (std::uint32_t c = 0; c + 1 < kColumns; ++c) border.push_back(c);
    for (std::uint32_t r = 0; r + 1 < kRows; ++r) border.push_back((r + 1) * kColumns - 1);
    for (std::uint32_t c = kColumns - 1; c > 0; --c) border.push_back((kRows - 1) * kColumns + c);
    for (std::uint32_t r = kRows - 1; r > 0; --r) border.push_back(r * kColumns);
    for (std::size_t i = 0; i < border.size(); ++i) {
      const std::uint32_t a = border[i], b = border[(i + 1) % border.size()],
                          below = kRows * kColumns;
      mesh.triangles.push_back({a, b, a + below});
      mesh.triangles.push_back({b, b + below, a + below});
    }
    measured.support.assign(mesh.vertices.size(), 1.0f);
    measured.offset.assign(mesh.vertices.size(), 0.0f);
  }
  void add_sheet(float y, bool faces_down) {
    const auto first = std::uint32_t(mesh.vertices.size());
    for (std::uint32_t r = 0; r < kRows; ++r) {
      for (std::uint32_t c = 0; c < kColumns; ++c) {
        const float x = 0.001f * (float(c) - float(kRidge));
        mesh.vertices.emplace_back(x, y - std::abs(x), 0.001f * float(r));
        const Vec3f up(x == 0.0f ? 0.0f : std::copysign(1.0f, x), 1, 0);
        normals.push_back((faces_down ? -1.0f : 1.0f) * up.normalized());
        if (r + 1 == kRows || c + 1 == kColumns) continue;
        const std::uint32_t v = first + r * kColumns + c;
        for (std::array<std::uint32_t, 3> t : {std::array{v, v + kColumns, v + 1},
                                               std::array{v + 1, v + kColumns, v + kColumns + 1}}) {
          if (faces_down) std::swap(t[1], t[2]);
          mesh.triangles.push_back(t);
        }
      }
    }
  }
  /// Offsets along the ridge, its ends left out.
  std::vector<double> ridge() const {
    const std::vector<float> all =
        fitted_offsets(mesh, MeshNeighbours(mesh), normals, measured, scale);
    std::vector<double> out;
    for (std::uint32_t r = 10; r + 10 < kRows; ++r)
      out.push_back(double(all[r * kColumns + kRidge]));
    return out;
  }
};

double spread(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v, squares += v * v;
  const auto n = double(values.size());
  return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n));
}

TEST(FittedOffsets, AnEdgeIsNotAsRaggedAsItsMeasurements) {
  Roof roof;
  for (std::size_t v = 0; v < roof.measured.offset.size(); ++v)
    roof.measured.offset[v] = 0.001f * float(standard_normal(hash_key(v, 0, 1)));
  const double calm = spread(roof.ridge());
  roof.scale.crease_coupling = 0.0;
  EXPECT_GT(spread(roof.ridge()), 0.0005);
  EXPECT_LT(calm, 0.0003);
}

TEST(FittedOffsets, FewMeasurementsAreSmoothedMoreThanMany) {
  const auto left = [](float support) {
    Roof roof;
    for (std::size_t v = 0; v < roof.measured.offset.size(); ++v) {
      const double noise = 0.0005 / std::sqrt(double(support));
      roof.measured.support[v] = support;
      roof.measured.offset[v] = support * float(noise * standard_normal(hash_key(v, 0, 2)));
    }
    const std::vector<float> all = fitted_offsets(roof.mesh, MeshNeighbours(roof.mesh),
                                                  roof.normals, roof.measured, roof.scale);
    std::vector<double> flat;
    for (std::uint32_t r = 10; r + 10 < kRows; ++r) flat.push_back(double(all[r * kColumns + 8]));
    return spread(flat) * std::sqrt(double(support));  // 0.0005 without a bending term
  };
  EXPECT_LT(left(1.0f), 0.85 * left(100.0f));
  EXPECT_LT(left(100.0f), 0.0004);
}

TEST(FittedOffsets, ErrorsInCommonAreSmoothedMore) {
  const auto left = [](double correlation) {
    Roof roof;
    roof.scale.correlation = correlation;
    for (std::uint32_t r = 0; r < kRows; ++r)  // alike in three by three vertices
      for (std::uint32_t c = 0; c < kColumns; ++c)
        roof.measured.offset[r * kColumns + c] =
            0.0005f * float(standard_normal(hash_key(r / 3, c / 3, 4)));
    const std::vector<float> all = fitted_offsets(roof.mesh, MeshNeighbours(roof.mesh),
                                                  roof.normals, roof.measured, roof.scale);
    std::vector<double> flat;
    for (std::uint32_t r = 10; r + 10 < kRows; ++r) flat.push_back(double(all[r * kColumns + 8]));
    return spread(flat);
  };
  EXPECT_LT(left(3.0), 0.85 * left(1.0));
}

TEST(FittedOffsets, NoiseAFewEdgesWideThatTheMeshBeganWithIsAveragedAway) {
  Roof roof;
  std::vector<float> noise;
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c)
      noise.push_back(0.0001f * float(standard_normal(hash_key(r / 3, c / 3, 3))));
  for (std::size_t v = 0; v < noise.size(); ++v)  // of the upper sheet
    roof.mesh.vertices[v] += noise[v] * roof.normals[v];
  const std::vector<float> all =
      fitted_offsets(roof.mesh, MeshNeighbours(roof.mesh), roof.normals, roof.measured, roof.scale);
  std::vector<double> before, after;
  for (std::uint32_t r = 10; r + 10 < kRows; ++r) {
    for (std::uint32_t c = 6; c < kRidge - 6; ++c) {
      const std::size_t v = r * kColumns + c;
      before.push_back(double(noise[v]));
      after.push_back(double(noise[v] + all[v]));
    }
  }
  EXPECT_LT(spread(after), 0.6 * spread(before));
}

TEST(FittedOffsets, ABluntTipIsNotFlattened) {
  TriangleMesh mesh = ball_mesh();
  for (Vec3f& p : mesh.vertices) p = {4.0f * (p.x() - float(kCenter.x())), p.y(), p.z()};
  VertexMeasurements measured;
  measured.support.assign(mesh.vertices.size(), 1.0f);
  measured.offset.assign(mesh.vertices.size(), 0.0f);
  MeshFitScale scale;
  scale.noise_m = 0.003;  // much noise: the surface is as stiff as it can be
  const auto all =
      fitted_offsets(mesh, MeshNeighbours(mesh), vertex_normals(mesh), measured, scale);
  const auto tip = std::max_element(mesh.vertices.begin(), mesh.vertices.end(),
                                    [](const Vec3f& a, const Vec3f& b) { return a.x() < b.x(); });
  EXPECT_NEAR(all[std::size_t(tip - mesh.vertices.begin())], 0.0, 0.00006);
}

TEST(FittedOffsets, WhereLittleWasMeasuredABallStaysRound) {
  const TriangleMesh mesh = ball_mesh();
  VertexMeasurements measured;
  for (const Vec3f& p : mesh.vertices)
    measured.support.push_back(p.y() > float(kCenter.y()) ? 1.0f : 0.03f);
  measured.offset.assign(mesh.vertices.size(), 0.0f);
  MeshFitScale scale;
  scale.noise_m = 0.003;  // much noise: the surface is as stiff as it can be
  const auto all =
      fitted_offsets(mesh, MeshNeighbours(mesh), vertex_normals(mesh), measured, scale);
  float most = 0.0f;  // the poles, where the mesh ends, are left out
  for (std::size_t v = all.size() / 4; v < 3 * all.size() / 4; ++v)
    most = std::max(most, std::abs(all[v]));
  EXPECT_LT(most, 1e-6f);
}

TEST(Stiffening, GrowsWithNoiseAndFallsWithMeasurementsWithinBounds) {
  const auto of = [](double noise_m, float support) {
    return stiffening(noise_m, 0.002, 0.001, support);
  };
  EXPECT_GT(of(0.002, 2.0f), of(0.001, 2.0f));
  EXPECT_GT(of(0.001, 1.0f), of(0.001, 2.0f));
  EXPECT_EQ(of(0.001, 1e6f), 1.0);
  EXPECT_EQ(of(0.0, 1.0f), 1.0);
  EXPECT_EQ(of(0.1, 0.0f), of(1.0, 0.0f));
  EXPECT_GT(stiffening(0.001, 0.002, 0.001, 2.0f), stiffening(0.001, 0.002, 0.0012, 2.0f));
}

TEST(FittedOffsets, AnEdgeKeepsItsShape) {
  Roof roof;
  for (const double d : roof.ridge()) EXPECT_NEAR(d, 0.0, 0.00005);
  for (float& offset : roof.measured.offset) offset = 0.002f;
  for (const double d : roof.ridge()) EXPECT_GT(d, 0.001);  // most of the way in one step
}

TEST(FittedOffsets, ACliffWhereMeasurementsEndMovesNothing) {
  Roof roof;
  for (std::uint32_t r = 0; r < kRows; ++r) {
    for (std::uint32_t c = kRidge; c < kColumns; ++c)
      roof.measured.support[r * kColumns + c] = 0.0f;
  }
  const std::vector<float> all =
      fitted_offsets(roof.mesh, MeshNeighbours(roof.mesh), roof.normals, roof.measured, roof.scale);
  for (std::uint32_t r = 15; r + 15 < kRows; ++r)
    for (std::uint32_t c = 6; c < kRidge; ++c) EXPECT_NEAR(all[r * kColumns + c], 0.0f, 0.00008f);
}

TEST(FittedOffsets, AWideHollowIsFilled) {
  Roof roof;
  std::vector<float> depth(roof.mesh.vertices.size(), 0.0f);
  for (std::uint32_t r = 0; r < kRows; ++r) {
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const std::uint32_t v = r * kColumns + c;
      const double along = double(r) / double(kRows - 1), across = double(c) / double(kRidge);
      if (c < kRidge)
        depth[v] =
            0.0005f *
            float(std::pow(std::sin(std::numbers::pi * along) * std::sin(std::numbers::pi * across),
                           2));
      roof.mesh.vertices[v] -= depth[v] * roof.normals[v];
      roof.measured.support[v] = 5.0f;
      roof.measured.offset[v] = 5.0f * depth[v];
    }
  }
  const std::vector<float> all =
      fitted_offsets(roof.mesh, MeshNeighbours(roof.mesh), roof.normals, roof.measured, roof.scale);
  const std::size_t middle = kRows / 2 * kColumns + kRidge / 2;
  EXPECT_NEAR(all[middle], depth[middle], 0.25f * depth[middle]);
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
  const auto result = reconstruct(scan(hat, {60, 0.002}), volumetric(), {}, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT(folded_share(result->objects[0].mesh), 0.0005);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
