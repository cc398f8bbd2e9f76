#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/io/mesh/texture_block.hpp>
#include <turnscan/io/ply/ply_read.hpp>
#include <turnscan/io/ply/ply_write.hpp>

namespace turnscan::mesh_io {

namespace {

TriangleMesh mesh_from(ply::PlyContent content) {
  TriangleMesh mesh;
  mesh.vertices = std::move(content.cloud.points);
  mesh.normals = std::move(content.cloud.normals);
  mesh.colors = std::move(content.cloud.colors);
  mesh.triangles = std::move(content.triangles);
  mesh.name = std::move(content.name);
  return mesh;
}

}  // namespace

Meshes decode_ply_mesh(std::string_view bytes) {
  TURNSCAN_ASSIGN(auto content, ply::parse_ply(bytes, ply::PlyParts::kFaces));
  std::vector<TriangleMesh> meshes;
  meshes.push_back(mesh_from(std::move(content)));
  return meshes;
}

Meshes decode_ply_sequence(std::string_view bytes) {
  std::vector<TriangleMesh> meshes;
  while (!bytes.empty()) {
    TURNSCAN_ASSIGN(auto content, ply::parse_ply(bytes, ply::PlyParts::kFaces));
    bytes.remove_prefix(content.end);
    meshes.push_back(mesh_from(std::move(content)));
    TURNSCAN_TRY(take_texture_block(bytes, meshes.back()));
  }
  return meshes;
}

Result<> write_ply_mesh(FileSink& sink, std::span<const TriangleMesh> meshes,
                        const file::FileFrame& frame) {
  TriangleMesh joined;
  if (meshes.size() > 1) joined = join_meshes(meshes);
  return write_ply_mesh_with(sink, meshes.size() > 1 ? joined : meshes.front(), {}, frame);
}

Result<> write_ply_mesh_with(FileSink& sink, const TriangleMesh& mesh,
                             std::span<const float> confidence, const file::FileFrame& frame) {
  ply::PlyJob job;
  job.points = mesh.vertices;
  job.normals = mesh.normals;
  job.colors = mesh.colors;
  job.confidence = confidence;
  job.triangles = mesh.triangles;
  job.name = mesh.name;
  job.frame_mark = file::mark_of(frame);
  return ply::write_ply(sink, job);
}

}  // namespace turnscan::mesh_io
