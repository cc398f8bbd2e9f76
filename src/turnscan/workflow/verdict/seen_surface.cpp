#include <algorithm>
#include <cmath>
#include <turnscan/core/frame_samples.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/rays/coverage.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/verdict/seen_surface.hpp>

namespace turnscan {

namespace {

constexpr std::size_t kMaxVertices = 20000, kMaxViews = 256;

Result<std::vector<CoverageView>> views_of_sources(const std::vector<MeshFrames>& sources) {
  std::vector<CoverageView> out;
  for (const MeshFrames& source : sources) {
    const SequenceHeader& header = source.frames->header();
    const auto& infos = source.frames->frames();
    TURNSCAN_ASSIGN(const FramePoses poses, frame_poses(header, infos, source.speed_rad_s));
    for (const std::size_t i : usable_frames(*source.frames, {.pass = source.pass}))
      out.push_back(view_of(header.sensors.at(infos[i].sensor),
                            source.T_mesh_table * poses.T_table_sensor[i]));
  }
  return out;
}

}  // namespace

Result<SeenVertices> seen_vertices(const TriangleMesh& mesh, const std::vector<MeshFrames>& sources,
                                   const RunContext& context) {
  SeenVertices out;
  if (mesh.triangles.empty()) return out;
  TURNSCAN_ASSIGN(const std::vector<CoverageView> all, views_of_sources(sources));
  const std::vector<CoverageView> views = evenly_spread(all, kMaxViews);
  const double share = double(views.size()) / double(std::max<std::size_t>(1, all.size()));
  CoverageOptions options;
  options.enough = share * kSeenInformation;
  const auto all_normals = vertex_normals(mesh);
  std::vector<Vec3f> points, normals;
  const std::size_t stride = std::max<std::size_t>(1, mesh.vertices.size() / kMaxVertices);
  for (std::size_t v = 0; v < mesh.vertices.size(); v += stride) {
    out.vertices.push_back(std::uint32_t(v));
    points.push_back(mesh.vertices[v]);
    normals.push_back(all_normals[v]);
  }
  TURNSCAN_ASSIGN(const Scene scene, Scene::create(std::span(&mesh, 1), std::nullopt, context));
  TURNSCAN_ASSIGN(const auto sums,
                  view_information(scene, views, points, normals, options, context));
  for (const float sum : sums) out.seen.push_back(std::uint8_t(double(sum) >= options.enough));
  return out;
}

}  // namespace turnscan
