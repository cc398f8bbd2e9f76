#pragma once
// The formats of meshes, one function each.

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

// Readers: coordinates in the file's own unit, y up where the file says what is; indices are in
// range; objects may be empty and coordinates not finite. Fail with kFormat or kUnsupported.

Meshes decode_ply_mesh(std::string_view bytes);
/// Several PLY files, one directly behind the other, each with a texture block behind it or none.
Meshes decode_ply_sequence(std::string_view bytes);
Meshes decode_stl(std::string_view bytes);
Meshes decode_obj(std::string_view bytes);

/// Places of an object's triangles in the picture of a material, as MeshTexture has them; empty
/// where not all have one, or they have several materials.
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
/// The same with the textures that lie beside the file; what is missing or damaged there is left
/// out: the shape is whole without it.
Meshes read_obj(const std::filesystem::path& path, std::string_view bytes);
Meshes decode_off(std::string_view bytes);

struct MeshesWithUnit {
  std::vector<TriangleMesh> meshes;
  double metres_per_unit = 1.0;
};

// These two rest on libraries that were not made for hostile files: read_meshes runs them in a
// child process.

Result<MeshesWithUnit> decode_3mf(std::string_view bytes);
/// In metres.
Meshes decode_glb(std::string_view bytes);

// Writers: meshes in metres, already checked, in the file's frame, which is marked in the file.

Result<> write_ply_mesh(FileSink& sink, std::span<const TriangleMesh> meshes,
                        const file::FileFrame& frame = {});
Result<> write_ply_mesh_with(FileSink& sink, const TriangleMesh& mesh,
                             std::span<const float> confidence, const file::FileFrame& frame);
Result<> write_stl(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);
/// Without textures.
Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);
/// With those of files_beside_obj(), of which `library` is the MTL's name; none if that is empty.
Result<> write_obj(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame, const std::string& library);
Result<> write_3mf(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);
/// Always y up.
Result<> write_glb(FileSink& sink, std::span<const TriangleMesh> meshes,
                   const file::FileFrame& frame);

/// Of processor, which no sound file of that length needs: some libraries take the square of it for
/// files that were made for that.
inline std::uint64_t most_convert_seconds(std::uint64_t bytes) { return 5 + bytes / 1000000; }

}  // namespace turnscan::mesh_io
