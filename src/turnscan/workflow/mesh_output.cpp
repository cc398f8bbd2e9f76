#include <turnscan/workflow/mesh_output.hpp>

#include <turnscan/workflow/output_file.hpp>

namespace turnscan {

namespace {

void add_texture_files(const std::string& path, std::span<const TriangleMesh> meshes,
                       std::vector<std::string>& files) {
  for (const auto& file : texture_files(path, meshes)) files.push_back(file.string());
}

}  // namespace

Result<> check_mesh_file(const std::string& path, const WriteMeshOptions& options) {
  auto good = check_mesh_output(path, options);
  if (good) return good;
  Error error = std::move(good).error();
  if (error.code == ErrorCode::kUnsupported) error.code = ErrorCode::kInvalidOption;
  return tl::unexpected<Error>(std::move(error));
}

Result<> check_textured_mesh_file(const std::string& path, const TextureOptions& texture,
                                  const WriteMeshOptions& options) {
  TURNSCAN_TRY(check_mesh_file(path, options));
  if (!texture.texture || holds_textures(path)) return {};
  return fail_at(path, ErrorCode::kInvalidOption,
                 "a {} file holds no texture; write .glb, .obj or .3mf, or leave --texture out "
                 "(--colour gives the vertices colours)",
                 ending_of(path));
}

std::vector<std::string> texture_files_of(const std::string& path, const TextureOptions& options) {
  if (!options.texture || ending_of(path) != ".obj") return {};
  const std::string stem = path.substr(0, path.size() - 4);
  return {stem + ".mtl", stem + ".png"};
}

Result<> check_watertight(const Reconstruction& r) {
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    if (r.objects[i].check.watertight() || r.objects[i].left_open) continue;
    return fail(ErrorCode::kLibrary,
                "object {}: the mesh is not watertight ({}); allow the repair, or take it as it is "
                "with --allow-open",
                i + 1, r.objects[i].check.text());
  }
  return {};
}

bool numbers_objects(const std::string& path) {
  const std::string ending = ending_of(path);
  return !path.empty() && ending != ".3mf" && ending != ".glb";
}

Result<std::vector<std::string>> write_objects(const std::string& path, const Reconstruction& r,
                                               const WriteMeshOptions& options) {
  std::vector<TriangleMesh> meshes;
  for (const ObjectResult& object : r.objects) meshes.push_back(object.mesh);
  if (meshes.size() == 1 || !numbers_objects(path)) {
    TURNSCAN_TRY(meshes.size() == 1 ? write_mesh(path, meshes[0], r.objects[0].confidence, options)
                                    : write_meshes(path, meshes, options));
    std::vector<std::string> files{path};
    add_texture_files(path, meshes, files);
    return files;
  }
  std::vector<std::string> files;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::string file = with_suffix(path, fmt::format("-{}", i + 1));
    TURNSCAN_TRY(write_mesh(file, meshes[i], r.objects[i].confidence, options));
    files.push_back(file);
    add_texture_files(file, std::span(&meshes[i], 1), files);
  }
  return files;
}

}  // namespace turnscan
