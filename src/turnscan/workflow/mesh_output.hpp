#pragma once
// Checks that the meshes of a reconstruction are what they claim to be, and writes them.

#include <string>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <vector>

namespace turnscan {

/// Succeeds when a mesh can be written so under this name. Fails with kInvalidOption for an ending
/// that is no mesh format's, else as check_mesh_output().
Result<> check_mesh_file(const std::string& path, const WriteMeshOptions& options = {});

/// The same for a mesh with a texture, if one is asked for: fails with kInvalidOption for formats
/// that have none.
Result<> check_textured_mesh_file(const std::string& path, const TextureOptions& texture,
                                  const WriteMeshOptions& options = {});

/// The files that a texture adds beside a mesh file of that name, if one is asked for.
std::vector<std::string> texture_files_of(const std::string& path, const TextureOptions& options);

/// Succeeds when every mesh is closed, 2-manifold and consistently outward. Fails with kLibrary,
/// naming the first object that is not and why.
Result<> check_watertight(const Reconstruction& reconstruction);

/// Whether write_objects() gives every object a file of its own when there are several: OUT-1,
/// OUT-2,
/// ... before the ending.
bool numbers_objects(const std::string& path);

/// Writes the meshes: all objects into one 3MF or GLB file, else one file an object, numbered -1,
/// -2, ... before the ending when there are several. Returns the names of the files. Fails as
/// write_mesh() does; files that were written before stay.
Result<std::vector<std::string>> write_objects(const std::string& path,
                                               const Reconstruction& reconstruction,
                                               const WriteMeshOptions& options = {});

}  // namespace turnscan
