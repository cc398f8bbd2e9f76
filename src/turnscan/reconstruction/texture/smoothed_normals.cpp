#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/texture/smoothed_normals.hpp>

namespace turnscan::texture {

namespace {

constexpr double kSmooth_m = 1.2e-3;  // standard deviation
constexpr int kMaxSmoothRounds = 30;
// Variance of the position of one of six neighbours or of the vertex itself, along one axis, in
// squared edges.
constexpr double kRoundVariance = 3.0 / 7.0;

double mean_edge(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += double((mesh.vertices[t[0]] - mesh.vertices[t[1]]).norm());
  return sum / double(std::max<std::size_t>(1, mesh.triangles.size()));
}

}  // namespace

std::vector<Vec3f> smoothed_normals(const TriangleMesh& mesh) {
  std::vector<Vec3f> normals = vertex_normals(mesh);
  const double edges = kSmooth_m / std::max(mean_edge(mesh), 1e-9);
  const int rounds =
      int(std::lround(std::min(edges * edges / kRoundVariance, double(kMaxSmoothRounds))));
  std::vector<Vec3f> sum;
  for (int round = 0; round < rounds; ++round) {
    sum = normals;
    // Each neighbour is in two triangles.
    for (const auto& t : mesh.triangles) {
      const Vec3f a = 0.5f * normals[t[0]], b = 0.5f * normals[t[1]], c = 0.5f * normals[t[2]];
      sum[t[0]] += b + c, sum[t[1]] += c + a, sum[t[2]] += a + b;
    }
    parallel_for(sum.size(), 8192, [&](std::size_t v) {
      const float length = sum[v].norm();
      if (length > 0.0f) normals[v] = sum[v] / length;
    });
  }
  return normals;
}

}  // namespace turnscan::texture
