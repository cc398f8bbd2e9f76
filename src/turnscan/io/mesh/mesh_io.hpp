#pragma once
// Triangle meshes on disk. In memory: metres, +Y up, counter-clockwise seen from outside.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/io/file/up_axis.hpp>
#include <vector>

namespace turnscan {

struct ReadMeshOptions {
  /// Length of the file's unit. Without it: 3MF, DAE and FBX say theirs, STL is in millimetres,
  /// everything else in metres.
  std::optional<double> metres_per_unit;
};

/// Objects of a mesh file, by the ending of its name: ply, obj, stl, off, 3mf, glb; any other
/// ending goes to assimp. Polygons are cut into fans; elements and properties other than
/// vertices, normals, colours and faces are skipped. Textures come along from OBJ (PNG or JPEG in
/// its folder), 3MF and GLB, where all of an object has the same picture; vertices are then joined
/// across the picture's seams. STL's vertices are merged where they are
/// exactly equal. What write_meshes() wrote comes back in its frame, whatever was up in the file;
/// other files are taken as they are, y up. 3MF, GLB and assimp's formats are read in a child
/// process with a limit on memory and time, which ends at once when ctx is cancelled. Fails with
/// kFormat (damaged; a count that the file's length cannot hold; an index out of range; a
/// coordinate that is not finite), kTooFewPoints (no triangles), kResourceLimit, kUnsupported,
/// kCancelled, or as read_file. Throws std::invalid_argument unless metres_per_unit is positive
/// and finite.
Result<std::vector<TriangleMesh>> read_meshes(const std::filesystem::path& path,
                                              const ReadMeshOptions& options = {},
                                              const RunContext& ctx = {});

/// All objects of the file joined into one mesh. An attribute is kept only if all of them have it.
Result<TriangleMesh> read_mesh(const std::filesystem::path& path,
                               const ReadMeshOptions& options = {}, const RunContext& ctx = {});

struct WriteMeshOptions {
  UpAxis up = UpAxis::kFormat;  ///< GLB is always y up
};
/// Field up.
OptionTable describe(WriteMeshOptions& options);

/// Writes by the ending of the name, atomically: ply (binary little-endian), obj (text), glb in
/// metres; stl (binary), 3mf in millimetres. OBJ, 3MF (each a build item) and GLB hold several
/// objects; PLY and STL get them joined. Colours are kept by PLY, OBJ (after the coordinates), 3MF
/// (a colour group) and GLB (COLOR_0); normals by PLY, OBJ and GLB. Textures are kept by GLB, by
/// 3MF, in place of colours there, and by OBJ in files beside it (texture_files()).
/// With z up the meshes are turned about x; in STL and 3MF the lowest point of all is then at z =
/// 0. The file says so, and how high that point was. Fails with kUnsupported (another ending),
/// kInvalidOption (GLB with z up), kTooFewPoints (no mesh, or one without triangles), kFormat (a
/// coordinate that is not finite), or as write_file_atomically. Throws std::invalid_argument when
/// an attribute's length does not fit or an index is out of range.
Result<> write_meshes(const std::filesystem::path& path, std::span<const TriangleMesh> meshes,
                      const WriteMeshOptions& options = {});
Result<> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                    const WriteMeshOptions& options = {});
/// The same with a confidence of each vertex (none if empty), which PLY keeps as the property that
/// Stanford's scans have: `confidence`. Throws std::invalid_argument when its length does not fit.
Result<> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh,
                    std::span<const float> confidence, const WriteMeshOptions& options = {});

/// The files that write_meshes() writes beside an OBJ file: its MTL, and a PNG for each texture.
std::vector<std::filesystem::path> texture_files(const std::filesystem::path& path,
                                                 std::span<const TriangleMesh> meshes);
/// Whether a file of this ending keeps textures.
bool holds_textures(const std::filesystem::path& path);

/// To be asked before long work: whether write_meshes could write there (ending known, folder
/// there and writable, not a directory; an axis that may be up in such a file).
Result<> check_mesh_output(const std::filesystem::path& path, const WriteMeshOptions& options = {});

/// Meshes as one. An attribute is kept only if all of them have it; the first name is kept.
TriangleMesh join_meshes(std::span<const TriangleMesh> meshes);

}  // namespace turnscan
