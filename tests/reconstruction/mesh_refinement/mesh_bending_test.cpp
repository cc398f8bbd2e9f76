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
  std::vector<float> offsets(const std::vector<std::vector<float>>& errors = {}) const {
    const std::vector<float> known(errors.empty() ? 0 : mesh.vertices.size(), 3.0f);
    return fitted_offsets(mesh, MeshNeighbours(mesh), normals, measured, scale, errors, known)
        .offset;
  }
  /// Offsets along the ridge, its ends left out.
  std::vector<double> ridge() const {
    const std::vector<float> all = offsets();
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

/// Noise of the measurements of the upper sheet, alike in so many vertices each way.
std::vector<float> noise_of(std::uint64_t sample, std::uint32_t alike) {
  std::vector<float> out(2 * kRows * kColumns, 0.0f);
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c)
      out[r * kColumns + c] =
          0.0005f * float(standard_normal(hash_key(r / alike, c / alike, sample)));
  return out;
}

/// Root mean square of the offsets on a side of the roof, over that of a fit that knows no errors.
double noise_left(std::uint32_t alike, float truth_m) {
  Roof roof;
  roof.measured.offset = noise_of(1, alike);
  std::vector<std::vector<float>> errors;
  for (const std::uint64_t sample : {2u, 3u, 4u}) errors.push_back(noise_of(sample, alike));
  const auto wave = [&](std::uint32_t r, std::uint32_t c) {
    return truth_m * std::sin(float(r) * 0.5f) * std::sin(float(c) * 0.5f);
  };
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c)
      roof.measured.offset[r * kColumns + c] += wave(r, c);
  const auto wrong = [&](const std::vector<float>& fitted) {
    double squares = 0.0;
    for (std::uint32_t r = 10; r + 10 < kRows; ++r)
      for (std::uint32_t c = 5; c < 14; ++c)
        squares += std::pow(double(fitted[r * kColumns + c] - wave(r, c)), 2);
    return std::sqrt(squares);
  };
  return wrong(roof.offsets(errors)) / wrong(roof.offsets());
}

TEST(FittedOffsets, WhatErrorsExplainIsAveragedOverMoreOfTheSurface) {
  EXPECT_LT(noise_left(1, 0.0f), 0.6);
  EXPECT_LT(noise_left(3, 0.0f), 0.8) << "errors that neighbours have in common";
}

TEST(FittedOffsets, WhatErrorsDoNotExplainIsNoWorseThanWithTheLeastStiffness) {
  EXPECT_LT(noise_left(1, 0.002f), 1.05);
}

TEST(FittedOffsets, NoiseAFewEdgesWideThatTheMeshBeganWithIsAveragedAway) {
  Roof roof;
  std::vector<float> noise;
  for (std::uint32_t r = 0; r < kRows; ++r)
    for (std::uint32_t c = 0; c < kColumns; ++c)
      noise.push_back(0.0001f * float(standard_normal(hash_key(r / 3, c / 3, 3))));
  for (std::size_t v = 0; v < noise.size(); ++v)  // of the upper sheet
    roof.mesh.vertices[v] += noise[v] * roof.normals[v];
  const std::vector<float> all = roof.offsets({noise_of(5, 3), noise_of(6, 3), noise_of(7, 3)});
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
      fitted_offsets(mesh, MeshNeighbours(mesh), vertex_normals(mesh), measured, scale, {}, {})
          .offset;
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
      fitted_offsets(mesh, MeshNeighbours(mesh), vertex_normals(mesh), measured, scale, {}, {})
          .offset;
  float most = 0.0f;  // the poles, where one vertex has 180 neighbours, are left out
  for (std::size_t v = all.size() / 4; v < 3 * all.size() / 4; ++v)
    most = std::max(most, std::abs(all[v]));
  EXPECT_LT(most, 1e-6f);
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
  const std::vector<float> all = roof.offsets();
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
  const std::vector<float> all = roof.offsets();
  const std::size_t middle = kRows / 2 * kColumns + kRidge / 2;
  EXPECT_NEAR(all[middle], depth[middle], 0.25f * depth[middle]);
}

}  // namespace
}  // namespace turnscan::mesh_refinement
