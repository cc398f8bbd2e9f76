// The input is m.obj, a zero byte, and m.mtl, beside two pictures and a file that is none.

#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(obj_materials) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = [] {
    fuzz::require(bool(write_color_png(folder / "p.png", ColorImage(4, 3))), "a picture");
    fuzz::require(bool(write_color_png(folder / "q.png", ColorImage(1, 1))), "a picture");
    folder.put("r.png", "none");
    return true;
  }();
  (void)laid_out;
  const auto [obj, mtl] = fuzz::split(fuzz::text_of(data, size));
  folder.put("m.mtl", mtl);
  const auto read = mesh_io::read_obj(folder / "m.obj", obj);
  if (!read) return 0;
  fuzz::check(*read);
  for (const TriangleMesh& mesh : *read) {
    if (!mesh.texture) continue;
    fuzz::require(has_texture(mesh), "a texture that fits its triangles");
    for (const auto& corners : mesh.texture->corners)
      for (const Eigen::Vector2f& place : corners) fuzz::require(place.allFinite(), "finite uvs");
    (void)split_at_seams(mesh);
  }
  return 0;
}
