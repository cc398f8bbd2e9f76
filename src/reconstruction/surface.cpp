#include <pcl/point_types.h>
#include <pcl/surface/concave_hull.h>

#include <cstring>
#include <turnscan/reconstruction/child_process.hpp>
#include <turnscan/reconstruction/surface.hpp>

namespace turnscan {

namespace {

Bytes pack(const TriangleMesh& mesh) {
  const std::uint64_t sizes[2] = {mesh.vertices.size(), mesh.triangles.size()};
  const std::size_t vertex_bytes = sizes[0] * sizeof(Vec3f), face_bytes = sizes[1] * 12;
  Bytes bytes(sizeof sizes + vertex_bytes + face_bytes);
  std::memcpy(bytes.data(), sizes, sizeof sizes);
  if (vertex_bytes) std::memcpy(bytes.data() + sizeof sizes, mesh.vertices.data(), vertex_bytes);
  if (face_bytes)
    std::memcpy(bytes.data() + sizeof sizes + vertex_bytes, mesh.triangles.data(), face_bytes);
  return bytes;
}

TriangleMesh unpack(const Bytes& bytes) {
  std::uint64_t sizes[2];
  std::memcpy(sizes, bytes.data(), sizeof sizes);
  TriangleMesh mesh;
  mesh.vertices.resize(sizes[0]);
  mesh.triangles.resize(sizes[1]);
  if (mesh.empty()) return mesh;
  const std::byte* p = bytes.data() + sizeof sizes;
  std::memcpy(mesh.vertices.data()->data(), p, sizes[0] * sizeof(Vec3f));
  std::memcpy(mesh.triangles.data(), p + sizes[0] * sizeof(Vec3f), sizes[1] * 12);
  return mesh;
}

/// Library coordinates are turned back to the table frame here.
TriangleMesh from_polygons(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                           const std::vector<pcl::Vertices>& polygons, const Vec3f& origin) {
  TriangleMesh mesh;
  for (const auto& p : cloud.points) mesh.vertices.emplace_back(p.getVector3fMap() + origin);
  for (const auto& polygon : polygons) {
    if (polygon.vertices.size() != 3) continue;
    mesh.triangles.push_back({static_cast<std::uint32_t>(polygon.vertices[0]),
                              static_cast<std::uint32_t>(polygon.vertices[1]),
                              static_cast<std::uint32_t>(polygon.vertices[2])});
  }
  return mesh;
}

Result<TriangleMesh> run(const std::function<Result<Bytes>()>& work, const char* name,
                         const RunContext& context) {
  auto bytes = run_in_child(work, context);
  if (!bytes && bytes.error().code == ErrorCode::kLibrary)
    return fail(ErrorCode::kLibrary, "{}: {}", name, bytes.error().message);
  if (!bytes) return tl::unexpected<Error>(bytes.error());
  TriangleMesh mesh = unpack(*bytes);
  if (mesh.empty()) return fail(ErrorCode::kLibrary, "{}: the result has no triangles", name);
  return mesh;
}

}  // namespace

OptionTable describe(SurfaceOptions& o) {
  OptionTable table;
  table
      .choice("method", o.method, {"poisson", "concave-hull", "volumetric"},
              "Surface: volumetric (signed distances of all frames, with what their rays passed "
              "through), or from points: Poisson (smooth, closed) or concave hull (alpha shape)")
      .number("poisson-depth", o.poisson_depth, {2, 13}, "Depth of Poisson's octree")
      .number("poisson-samples", o.samples_per_node, Quantity::kNone, {1.0, 100.0},
              "Samples per node of Poisson's octree; the thesis used 3 to 5 on noisier candidates")
      .number("poisson-scale", o.poisson_scale, Quantity::kNone, {1.0, 10.0},
              "Poisson's cube relative to the bounding cube of the points")
      .number("poisson-point-weight", o.point_weight, Quantity::kNone, {0.0, 100.0},
              "Weight of the points in screened Poisson; 0 is the unscreened method")
      .number("alpha", o.alpha_m, Quantity::kLength, {1e-5, 1.0},
              "Concave hull's alpha; automatic: from the spacing of the candidates")
      .flag("repair", o.repair, "Make each mesh closed, 2-manifold and outward");
  return table;
}

Result<TriangleMesh> concave_hull(const PointCloud& points, double alpha_m,
                                  const RunContext& context) {
  if (points.size() < 10)
    return fail(ErrorCode::kTooFewPoints, "concave hull: {} points are too few", points.size());
  const Vec3f origin = bounds(points.points).center().cast<float>();
  const auto work = [&]() -> Result<Bytes> {
    auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (const Vec3f& p : points.points)
      cloud->emplace_back(p.x() - origin.x(), p.y() - origin.y(), p.z() - origin.z());
    pcl::ConcaveHull<pcl::PointXYZ> hull;
    hull.setInputCloud(cloud);
    hull.setAlpha(alpha_m);
    hull.setDimension(3);
    pcl::PointCloud<pcl::PointXYZ> vertices;
    std::vector<pcl::Vertices> polygons;
    hull.reconstruct(vertices, polygons);
    return pack(from_polygons(vertices, polygons, origin));
  };
  return run(work, "concave hull", context);
}

}  // namespace turnscan
