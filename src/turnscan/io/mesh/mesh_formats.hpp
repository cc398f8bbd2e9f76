#pragma once
// Mesh formats, one function each.

#include <filesystem>
#include <span>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/file_frame.hpp>
#include <vector>

namespace turnscan::mesh_io {

using Meshes = Result<std::vector<TriangleMesh>>;

// Readers: coordinates are in the file's own unit, y up if the file states its frame; indices are
// in range; objects may be empty and coordinates not finite. Fail with kFormat or kUnsupported.

Meshes decode_ply_mesh(std::string_view bytes);
/// Several concatenated PLY files, each optionally followed by a texture block.
Meshes decode_ply_sequence(std::string_view bytes);
Meshes decode_stl(std::string_view bytes);
Meshes decode_obj(std::string_view bytes);

/// Texture coordinates of an object's triangles in the image of its material, as in MeshTexture;
/// empty if not all triangles have them, or they have several materials.
struct ObjTexCoords {
  std::vector<std::array<Eigen::Vector2f, 3>> corners;
  std::string material;
};
struct ObjObjects {
  std::vector<TriangleMesh> meshes;
  std::vector<ObjTexCoords> uvs;       ///< per mesh
  std::vector<std::string> libraries;  ///< names of material libraries
};
Result<ObjObjects> parse_obj(std::string_view bytes);
/// The same with textures from files next to it; missing or damaged ones are skipped, since the
/// shape is complete without them.
Meshes read_obj(const std::filesystem::path& path, std::string_view bytes);
Meshes decode_off(std::string_view bytes);

struct MeshesWithUnit {
  std::vector<TriangleMesh> meshes;
  double metres_per_unit = 1.0;
};

// These two use libraries that are not hardened against malicious files: read_meshes runs them in a
// child process.

Result<MeshesWithUnit> decode_3mf(std::string_view bytes);
/// In metres.
Meshes decode_glb(std::string_view bytes);

// Writers: meshes are in metres and already checked; the file's frame is recorded in the file.

Result<> write_ply_mesh(FileSink& sink, std::span<const TriangleMesh> meshes,
                        const file::FileFrame& frame = {});
Result<> write_ply_mesh_with(FileSink& sink, const TriangleMesh& mesh,
                             std::span<const float> confidence, const file::FileFrame& frame);
Result<> write_stl(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);
/// Without textures.
Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);
/// With the textures written by files_beside_obj(); `library` is the file name of the MTL; empty:
/// no textures.
Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame, const std::string& library);
Result<> write_3mf(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);
/// Always y up.
Result<> write_glb(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);

/// Limit of processor time, which no valid file of that length needs: some libraries take quadratic
/// time for files crafted for that.
inline std::uint64_t most_convert_seconds(std::uint64_t bytes) { return 5 + bytes / 1000000; }

}  // namespace turnscan::mesh_io
