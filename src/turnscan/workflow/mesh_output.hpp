#pragma once
// Checks the meshes of a reconstruction, and writes them.

#include <string>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <vector>

namespace turnscan {

/// Succeeds if a mesh can be written with these options under this name. Fails with kInvalidOption
/// for an unknown extension, else as check_mesh_output().
Result<> check_mesh_file(const std::string& path, const WriteMeshOptions& options = {});

/// The same for a mesh with a texture, if one is requested: fails with kInvalidOption for formats
/// without textures.
Result<> check_textured_mesh_file(const std::string& path, const TextureOptions& texture,
                                  const WriteMeshOptions& options = {});

/// The extra files that a texture adds next to a mesh file of that name, if one is requested.
std::vector<std::string> texture_files_of(const std::string& path, const TextureOptions& options);

/// Succeeds if every mesh is closed, 2-manifold and oriented consistently outward. Fails with
/// kLibrary, naming the first object that is not and the reason.
Result<> check_watertight(const Reconstruction& reconstruction);

/// Whether write_objects() writes one file per object if there are several: OUT-1, OUT-2, ...
/// before the extension.
bool numbers_objects(const std::string& path);

/// Writes the meshes: all objects into one 3MF or GLB file, else one file per object, numbered -1,
/// -2, ... before the extension if there are several. Returns the names of the files. Fails as
/// write_mesh() does; files already written are kept.
Result<std::vector<std::string>> write_objects(const std::string& path,
                                               const Reconstruction& reconstruction,
                                               const WriteMeshOptions& options = {});

}  // namespace turnscan
