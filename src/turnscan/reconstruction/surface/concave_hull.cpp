#include <limits>
#include <turnscan/core/process/child_process.hpp>
#include <turnscan/core/process/helper_program.hpp>
#include <turnscan/reconstruction/surface/concave_hull.hpp>
#include <turnscan/reconstruction/surface/hull_bytes.hpp>

namespace turnscan::surface {

namespace {

/// Its duration is not limited, and it may be cancelled.
constexpr double kNoTimeLimit = std::numeric_limits<double>::infinity();

Result<TriangleMesh> hull_from(const process::ChildResult& child) {
  if (child.signal != 0)
    return fail(ErrorCode::kLibrary, "concave hull: the library crashed with signal {}",
                child.signal);
  if (child.exit_code != 0) {
    if (auto error = process::helper_error(child))
      return fail(error->code, "concave hull: {}", error->message);
    return fail(ErrorCode::kLibrary, "concave hull: the child process ended with status {}",
                child.exit_code);
  }
  auto mesh = mesh_from_bytes(child.output);
  if (!mesh) return fail(ErrorCode::kLibrary, "concave hull: the result cannot be read");
  if (mesh->empty()) return fail(ErrorCode::kLibrary, "concave hull: the result has no triangles");
  return std::move(*mesh);
}

}  // namespace

Result<TriangleMesh> concave_hull(const PointCloud& points, double alpha_m,
                                  const RunContext& context) {
  if (points.size() < 10)
    return fail(ErrorCode::kTooFewPoints, "concave hull: {} points are too few", points.size());
  TURNSCAN_ASSIGN(const auto program, process::find_helper_program(kConcaveHullProgram));
  // Single precision is most accurate around the origin.
  const Vec3f origin = bounds(points.points).center().cast<float>();
  std::vector<Vec3f> centred;
  centred.reserve(points.size());
  for (const Vec3f& p : points.points) centred.emplace_back(p - origin);
  const std::string arguments[] = {fmt::format("{}", alpha_m)};
  TURNSCAN_ASSIGN(
      const process::ChildResult child,
      process::run_child(program, arguments, kNoTimeLimit, context, bytes_of_points(centred)));
  TURNSCAN_ASSIGN(TriangleMesh mesh, hull_from(child));
  for (Vec3f& v : mesh.vertices) v += origin;
  return mesh;
}

}  // namespace turnscan::surface
