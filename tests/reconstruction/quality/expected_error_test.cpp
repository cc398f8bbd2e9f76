#include <gtest/gtest.h>

#include <turnscan/reconstruction/quality/expected_error.hpp>

namespace turnscan::quality {
namespace {

constexpr int kAcross = 41;
constexpr float kStep_m = 0.001f;

/// A square of vertices a millimetre apart; folded by so much along its middle.
TriangleMesh sheet(float fold) {
  TriangleMesh mesh;
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i) {
      const float x = kStep_m * float(i), fall = fold * std::abs(x - kStep_m * float(kAcross / 2));
      mesh.vertices.emplace_back(x, -fall, kStep_m * float(j));
    }
  for (std::uint32_t j = 0; j + 1 < kAcross; ++j)
    for (std::uint32_t i = 0; i + 1 < kAcross; ++i) {
      const std::uint32_t v = j * kAcross + i;
      mesh.triangles.push_back({v, v + kAcross, v + 1});
      mesh.triangles.push_back({v + 1, v + kAcross, v + kAcross + 1});
    }
  return mesh;
}

std::size_t at(int i, int j) { return std::size_t(j * kAcross + i); }
const ErrorScale kScale{0.0015, 0.002, 0.0009};

TEST(ExpectedErrors, FallWithTheNumberOfMeasurements) {
  const TriangleMesh mesh = sheet(0.0f);
  std::vector<float> support(mesh.vertices.size(), 2.0f);
  const float few = expected_errors(mesh, support, kScale)[at(20, 20)];
  support.assign(support.size(), 200.0f);
  const float many = expected_errors(mesh, support, kScale)[at(20, 20)];
  EXPECT_LT(many, 0.7f * few);
  EXPECT_GT(many, 0.0f);
}

TEST(ExpectedErrors, AreLargerWhereTheSurfaceBends) {
  const TriangleMesh mesh = sheet(0.5f);
  const auto errors =
      expected_errors(mesh, std::vector<float>(mesh.vertices.size(), 50.0f), kScale);
  EXPECT_GT(errors[at(20, 20)], 1.3f * errors[at(5, 20)]);
}

TEST(ExpectedErrors, GrowWithTheWayToWhatWasMeasured) {
  const TriangleMesh mesh = sheet(0.0f);
  std::vector<float> support(mesh.vertices.size(), 50.0f);
  for (int j = 0; j < kAcross; ++j)
    for (int i = 21; i < kAcross; ++i) support[at(i, j)] = 0.0f;
  const auto errors = expected_errors(mesh, support, kScale);
  EXPECT_GT(errors[at(30, 20)], errors[at(25, 20)]);
  EXPECT_GT(errors[at(25, 20)], errors[at(10, 20)]);
  EXPECT_LT(errors[at(30, 20)], 0.010f) << "no more than the way";
}

TEST(ExpectedErrors, ScaleWithTheNoise) {
  const TriangleMesh mesh = sheet(0.0f);
  const std::vector<float> support(mesh.vertices.size(), 10.0f);
  ErrorScale twice = kScale;
  twice.noise_m *= 2.0;
  EXPECT_NEAR(expected_errors(mesh, support, twice)[at(20, 20)],
              2.0f * expected_errors(mesh, support, kScale)[at(20, 20)], 1e-6f);
}

/// A slab of so much thickness, its corners apart.
TriangleMesh slab(float thickness_m) {
  TriangleMesh mesh = sheet(0.0f), below = mesh;
  for (Vec3f& p : below.vertices) p.y() -= thickness_m;
  const auto first = std::uint32_t(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), below.vertices.begin(), below.vertices.end());
  for (const auto& [a, b, c] : below.triangles)
    mesh.triangles.push_back({first + a, first + c, first + b});
  return mesh;
}

TEST(ExpectedErrors, AreLargerAtWallsThatAFilterCannotTellApart) {
  const ErrorScale filtered{0.0015, 0.002, 0.0009, true};
  const auto middle_of = [](const TriangleMesh& mesh, const ErrorScale& scale) {
    return expected_errors(mesh, std::vector<float>(mesh.vertices.size(), 50.0f),
                           scale)[at(20, 20)];
  };
  const TriangleMesh thick = slab(0.010f), thin = slab(0.003f);
  EXPECT_EQ(middle_of(thick, kScale), middle_of(thin, kScale));
  EXPECT_GT(middle_of(thin, filtered), 1.3f * middle_of(thick, filtered));
}

}  // namespace
}  // namespace turnscan::quality
