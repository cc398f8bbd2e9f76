#include <algorithm>
#include <stdexcept>
#include <turnscan/reconstruction/passes/pass_surface.hpp>
#include <turnscan/reconstruction/seen_space.hpp>

namespace turnscan::passes {

namespace {

constexpr std::size_t kMinPoints = 200;
/// The volume's surface is ragged where it has less than this share of the usual measurements.
constexpr float kMinConfidence = 0.1f;
constexpr int kRagRings = 2;

/// Also marks the corners of triangles that contain a marked vertex.
void widen(const TriangleMesh& mesh, std::vector<bool>& marked) {
  const std::vector<bool> before = marked;
  for (const auto& t : mesh.triangles) {
    if (before[t[0]] || before[t[1]] || before[t[2]])
      for (const std::uint32_t v : t) marked[v] = true;
  }
}

std::vector<bool> unmeasured(const ObjectResult& object) {
  const TriangleMesh& mesh = object.mesh;
  std::vector<bool> out(mesh.vertices.size(), false);
  for (std::size_t i = 0; i < object.evidence.size(); ++i) {
    if (object.evidence[i] == Evidence::kMeasured) continue;
    for (const std::uint32_t v : mesh.triangles[i]) out[v] = true;
  }
  for (std::size_t v = 0; v < object.confidence.size(); ++v)
    if (object.confidence[v] < kMinConfidence) out[v] = true;
  for (int ring = 0; ring < kRagRings; ++ring) widen(mesh, out);
  return out;
}

}  // namespace

Result<> check_surface(const PassSurface& surface) {
  const std::size_t points = surface.points.size();
  if (points < kMinPoints)
    return fail(ErrorCode::kTooFewPoints, "{} points of it were measured, {} are needed", points,
                kMinPoints);
  if (surface.normals.size() != points || surface.areas.size() != points ||
      surface.weights.size() != points ||
      (!surface.colors.empty() && surface.colors.size() != points))
    throw std::invalid_argument("a pass's normals, areas, weights and colours must fit its points");
  return {};
}

PassSurface measured_surface(const ObjectResult& object) {
  const TriangleMesh& mesh = object.mesh;
  std::vector<Vec3f> twice_area(mesh.vertices.size(), Vec3f::Zero());
  std::vector<float> areas(mesh.vertices.size(), 0.0f);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f normal =
        (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    for (const std::uint32_t v : {a, b, c}) {
      twice_area[v] += normal;
      areas[v] += normal.norm() / 6.0f;
    }
  }
  const std::vector<bool> left_out = unmeasured(object);
  PassSurface out;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const float length = twice_area[v].norm();
    if (left_out[v] || !(length > 0.0f)) continue;
    out.points.push_back(mesh.vertices[v]);
    out.normals.push_back(twice_area[v] / length);
    out.areas.push_back(areas[v]);
    out.weights.push_back(object.confidence.empty() ? 1.0f : object.confidence[v]);
  }
  return out;
}

PassSurface measured_surface(const ObjectResult& object,
                             const std::shared_ptr<const SeenSpace>& seen) {
  PassSurface out = measured_surface(object);
  out.views = SharedViews(seen, &seen->views);
  out.floor_m = seen->floor_m;
  out.noise_m = seen->noise_m;
  out.spacing_m = seen->spacing_m;
  out.filtered = seen->filtered;
  return out;
}

}  // namespace turnscan::passes
