#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tests/reconstruction/mesh_refinement/ball_mesh.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {
namespace {

using namespace turnscan::testing;

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
  float most = 0.0f;  // the poles, where one vertex has 180 neighbours, are left out
  for (std::size_t v = all.size() / 4; v < 3 * all.size() / 4; ++v)
    most = std::max(most, std::abs(all[v]));
  EXPECT_LT(most, 1e-6f);
}

TEST(Stiffening, GrowsWithNoiseAndFallsWithMeasurementsWithinBounds) {
  const auto of = [](double noise_m, float support) {
    return stiffening(noise_m, 1.0, 0.002, 0.001, support);
  };
  EXPECT_GT(of(0.002, 2.0f), of(0.001, 2.0f));
  EXPECT_GT(of(0.001, 1.0f), of(0.001, 2.0f));
  EXPECT_EQ(of(0.001, 1e6f), 1.0);
  EXPECT_EQ(of(0.0, 1.0f), 1.0);
  EXPECT_EQ(of(0.1, 0.0f), of(1.0, 0.0f));
  EXPECT_GT(stiffening(0.001, 1.0, 0.002, 0.001, 2.0f),
            stiffening(0.001, 1.0, 0.002, 0.0012, 2.0f));
}

TEST(Stiffening, CountsErrorsInCommonForMoreTheLargerTheyAre) {
  const auto times_more = [](double noise_m) {
    return stiffening(noise_m, 3.0, 0.002, 0.001, 4.0f) /
           stiffening(noise_m, 1.0, 0.002, 0.001, 4.0f);
  };
  EXPECT_GE(times_more(0.001), 3.0);
  EXPECT_GT(times_more(0.0015), 1.5 * times_more(0.001));
  EXPECT_EQ(stiffening(0.0, 3.0, 0.002, 0.001, 4.0f), 1.0);
  EXPECT_EQ(stiffening(0.1, 3.0, 0.002, 0.001, 4.0f), stiffening(1.0, 3.0, 0.002, 0.001, 4.0f));
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

}  // namespace
}  // namespace turnscan::mesh_refinement
