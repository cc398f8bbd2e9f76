#include <turnscan/workflow/batch/thumbnail.hpp>

#include <algorithm>
#include <system_error>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/simulator/rendering/picture.hpp>
#include <vector>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

constexpr int kSizePx = 192;

/// The meshes of a reconstruction, or the ground truth of a simulation.
std::vector<fs::path> meshes_in(const fs::path& result) {
  std::vector<fs::path> meshes;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(result, error))
    if (entry.path().extension() == ".ply") meshes.push_back(entry.path());
  const fs::path truth = result / "recording" / "truth" / "object.ply";
  if (fs::exists(truth, error)) meshes.push_back(truth);
  std::sort(meshes.begin(), meshes.end());
  return meshes;
}

}  // namespace

void draw_thumbnail(const fs::path& result) {
  std::vector<TriangleMesh> meshes;
  for (const fs::path& path : meshes_in(result)) {
    auto mesh = read_mesh(path, {}, RunContext());
    if (mesh) meshes.push_back(std::move(*mesh));
  }
  if (meshes.empty()) return;
  PictureOptions options;
  options.width = options.height = kSizePx;
  options.ambient_samples = 2;
  const auto picture = render_picture(meshes, options);
  if (picture) (void)write_color_png(result / "thumbnail.png", *picture, Durability::kNamed);
}

}  // namespace turnscan::batch
