#pragma once
// Material libraries (MTL) beside OBJ files, as far as they name pictures.

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh_io {

/// Of each material the picture of its diffuse colour (map_Kd), by the material's name.
std::map<std::string, std::string> pictures_of_materials(std::string_view mtl);

/// A file beside another one, by a name that this one gives: in the same folder or below it.
/// Empty where the name leads elsewhere.
std::filesystem::path file_beside(const std::filesystem::path& file, const std::string& name);

/// The names of the files that write_obj's meshes with textures need beside the OBJ file: the MTL,
/// and a PNG of each texture. Empty without textures.
std::vector<std::filesystem::path> files_beside_obj(const std::filesystem::path& obj,
                                                    std::span<const TriangleMesh> meshes);

/// Writes them.
Result<> write_files_beside_obj(const std::filesystem::path& obj,
                                std::span<const TriangleMesh> meshes);

/// In the MTL and the OBJ.
std::string material_name(std::size_t mesh);

}  // namespace turnscan::mesh_io
