#include <algorithm>
#include <set>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/obj_material.hpp>
#include <turnscan/io/mesh/texture_budget.hpp>
#include <turnscan/io/text/number_text.hpp>

namespace turnscan::mesh_io {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMaxMaterialBytes = 1 << 20;
constexpr std::uint64_t kMaxTextureFileBytes = std::uint64_t(256) << 20;

std::string without_spaces_about(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == text.npos) return {};
  const auto end = text.find_last_not_of(" \t\r");
  return std::string(text.substr(begin, end - begin + 1));
}

fs::path picture_beside(const fs::path& obj, std::size_t number, std::size_t of) {
  const std::string suffix = of > 1 ? fmt::format("-{}", number + 1) : "";
  return obj.parent_path() / (obj.stem().string() + suffix + ".png");
}

}  // namespace

std::map<std::string, std::string> pictures_of_materials(std::string_view mtl) {
  std::map<std::string, std::string> out;
  std::string material;
  while (!mtl.empty()) {
    const auto end = std::min(mtl.find('\n'), mtl.size());
    const std::string line = without_spaces_about(mtl.substr(0, end));
    mtl.remove_prefix(std::min(end + 1, mtl.size()));
    if (line.starts_with("newmtl ")) material = without_spaces_about(line.substr(7));
    // Options precede the name: "-clamp on".
    if (line.starts_with("map_Kd ") && line.find(" -") == line.npos)
      out[material] = without_spaces_about(line.substr(7));
  }
  return out;
}

fs::path file_beside(const fs::path& file, const std::string& name) {
  const fs::path relative = fs::path(name).lexically_normal();
  if (name.empty() || relative.is_absolute() || *relative.begin() == "..") return {};
  return file.parent_path() / relative;
}

std::string material_name(std::size_t mesh) { return fmt::format("texture{}", mesh + 1); }

std::vector<fs::path> files_beside_obj(const fs::path& obj, std::span<const TriangleMesh> meshes) {
  std::vector<fs::path> out;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (has_texture(meshes[i])) out.push_back(picture_beside(obj, i, meshes.size()));
  if (!out.empty()) out.insert(out.begin(), fs::path(obj).replace_extension(".mtl"));
  return out;
}

Result<> write_files_beside_obj(const fs::path& obj, std::span<const TriangleMesh> meshes) {
  std::string mtl = "# turnscan\n";
  bool any = false;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (!has_texture(meshes[i])) continue;
    const fs::path picture = picture_beside(obj, i, meshes.size());
    TURNSCAN_TRY(write_color_png(picture, meshes[i].texture->image));
    mtl += fmt::format("newmtl {}\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {}\n",
                       material_name(i), picture.filename().string());
    any = true;
  }
  if (!any) return {};
  return write_file_atomically(fs::path(obj).replace_extension(".mtl"), mtl);
}

Meshes read_obj(const fs::path& path, std::string_view bytes) {
  TURNSCAN_ASSIGN(ObjObjects objects, parse_obj(bytes));
  std::map<std::string, std::string> pictures;
  // The file may name the same ones any number of times.
  const file::ReadBudget budget(bytes.size());
  std::set<fs::path> seen;
  for (const std::string& library : objects.libraries) {
    const fs::path file = file_beside(path, library);
    if (file.empty() || !seen.insert(file).second) continue;
    const auto mtl = read_file(file, kMaxMaterialBytes);
    if (mtl) pictures.merge(pictures_of_materials(*mtl));
  }
  TextureBudget shown;
  for (std::size_t i = 0; i < objects.meshes.size(); ++i) {
    ObjTexCoords& uvs = objects.uvs[i];
    const auto picture = pictures.find(uvs.material);
    if (uvs.corners.empty() || picture == pictures.end()) continue;
    const fs::path file = file_beside(path, picture->second);
    if (file.empty()) continue;
    const auto picture_bytes = read_file(file, kMaxTextureFileBytes);
    if (!picture_bytes) continue;
    if (!seen.insert(file).second) TURNSCAN_TRY(budget.unpack(picture_bytes->size()));
    auto image = shown.decode(*picture_bytes);
    if (!image) continue;
    auto texture = std::make_shared<MeshTexture>();
    texture->image = std::move(*image);
    texture->corners = std::move(uvs.corners);
    objects.meshes[i].texture = std::move(texture);
  }
  return std::move(objects.meshes);
}

}  // namespace turnscan::mesh_io
