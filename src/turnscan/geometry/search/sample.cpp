#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/search/sample.hpp>

namespace turnscan {
namespace {

constexpr std::size_t kGrain = 4096;

struct TriangleCorners {
  Vec3d a, b, c;
  TriangleCorners(const TriangleMesh& mesh, std::size_t t)
      : a(mesh.vertices[mesh.triangles[t][0]].cast<double>()),
        b(mesh.vertices[mesh.triangles[t][1]].cast<double>()),
        c(mesh.vertices[mesh.triangles[t][2]].cast<double>()) {}
  Vec3d doubled_area_normal() const { return (b - a).cross(c - a); }
};

std::vector<double> cumulative_area(const TriangleMesh& mesh) {
  std::vector<double> area(mesh.triangles.size());
  double sum = 0.0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    sum += 0.5 * TriangleCorners(mesh, t).doubled_area_normal().norm();
    area[t] = sum;
  }
  return area;
}

/// Uniform in the triangle: Turk, "Generating random points in triangles", Graphics Gems (1990).
Vec3d point_in(const TriangleCorners& corners, double u, double v) {
  const double s = std::sqrt(u);
  return (1.0 - s) * corners.a + s * (1.0 - v) * corners.b + s * v * corners.c;
}

}  // namespace

Result<SurfaceSamples> sample_surface(const TriangleMesh& mesh, std::size_t count,
                                      std::uint64_t seed, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  TURNSCAN_TRY(context.check());
  const std::vector<double> area = cumulative_area(mesh);
  const double total = area.empty() ? 0.0 : area.back();
  if (!(total > 0.0)) {
    return fail(ErrorCode::kTooFewPoints, "sample a surface: the mesh has no area; check the mesh");
  }
  // The first triangle that reaches the total area: used for a position that rounds up to it.
  const std::size_t last =
      std::size_t(std::lower_bound(area.begin(), area.end(), total) - area.begin());
  SurfaceSamples samples;
  samples.area_m2 = total;
  samples.points.resize(count);
  samples.normals.resize(count);
  samples.triangles.resize(count);
  TURNSCAN_TRY(parallel_for(count, kGrain, context, [&](std::size_t i) {
    const double position = total * ((double(i) + uniform01(hash_key(seed, i, 0))) / double(count));
    const std::size_t t = std::min(
        last, std::size_t(std::upper_bound(area.begin(), area.end(), position) - area.begin()));
    const TriangleCorners corners(mesh, t);
    const double u = uniform01(hash_key(seed, i, 1)), v = uniform01(hash_key(seed, i, 2));
    samples.points[i] = point_in(corners, u, v).cast<float>();
    samples.normals[i] = corners.doubled_area_normal().normalized().cast<float>();
    samples.triangles[i] = std::uint32_t(t);
  }));
  return samples;
}

}  // namespace turnscan
