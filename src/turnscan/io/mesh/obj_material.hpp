#pragma once
// Material libraries (MTL) of OBJ files, limited to texture images.

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

/// The diffuse texture image (map_Kd) of each material, by the material's name.
std::map<std::string, std::string> pictures_of_materials(std::string_view mtl);

/// Resolves a file name found in another file: must be in the same folder or below it. Empty if the
/// name leads elsewhere.
std::filesystem::path file_beside(const std::filesystem::path& file, const std::string& name);

/// Names of the additional files for an OBJ file with textures: the MTL, and a PNG of each texture.
/// Empty without textures.
std::vector<std::filesystem::path> files_beside_obj(const std::filesystem::path& obj,
                                                    std::span<const TriangleMesh> meshes);

/// Writes them.
Result<> write_files_beside_obj(const std::filesystem::path& obj,
                                std::span<const TriangleMesh> meshes);

/// As used in the MTL and the OBJ.
std::string material_name(std::size_t mesh);

}  // namespace turnscan::mesh_io
