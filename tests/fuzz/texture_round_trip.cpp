// The input gives a mesh, the places of its corners in a picture, and the picture: every format
// that takes textures is written and read again.

#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/mesh_from.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace {

using namespace turnscan;

std::shared_ptr<const MeshTexture> texture_from(const std::uint8_t* data, std::size_t size,
                                                std::size_t triangles) {
  auto texture = std::make_shared<MeshTexture>();
  texture->image = ColorImage(1 + data[0] % 16, 1 + data[1] % 16);
  for (std::size_t i = 0; i < texture->image.pixels.size(); ++i)
    texture->image.pixels[i] = {data[i % size], data[(i + 1) % size], data[(i + 2) % size]};
  texture->corners.resize(triangles);
  for (std::size_t t = 0; t < triangles; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      texture->corners[t][k] = {float(data[(6 * t + 2 * k) % size]) / 255.0f,
                                float(data[(6 * t + 2 * k + 1) % size]) / 255.0f};
  return texture;
}

Result<std::vector<TriangleMesh>> read_textured(const std::filesystem::path& path,
                                                const std::string& ending) {
  const std::string bytes = *read_file(path);
  if (ending == "obj") return mesh_io::read_obj(path, bytes);
  if (ending == "glb") return mesh_io::decode_glb(bytes);
  auto read = mesh_io::decode_3mf(bytes);
  if (!read) return tl::unexpected(read.error());
  return std::move(read->meshes);
}

}  // namespace

TURNSCAN_FUZZ_TARGET(texture_round_trip) {
  if (size < 12) return 0;
  static const fuzz::ScratchFolder folder;
  TriangleMesh mesh = fuzz::mesh_from(data, size);
  if (mesh.triangles.empty()) return 0;
  // A mesh may have both a texture and colours, or neither.
  if (data[2] & 1) mesh.texture = texture_from(data, size, mesh.triangles.size());
  if (data[2] & 2) mesh.colors.assign(mesh.vertices.size(), Rgb{data[3], data[4], data[5]});
  for (const std::string ending : {"obj", "glb", "3mf"}) {
    const auto path = folder / ("m." + ending);
    const auto written = write_mesh(path, mesh);
    fuzz::require(bool(written), "a mesh that can be written");
    const auto again = read_textured(path, ending);
    fuzz::require(again && again->size() == 1, "read again");
    fuzz::check(*again);
    const TriangleMesh& read = again->front();
    fuzz::require(read.triangles.size() == mesh.triangles.size(), "all triangles");
    fuzz::require(has_texture(read) == has_texture(mesh), "the texture");
    if (has_texture(read))
      fuzz::require(read.texture->image.pixels == mesh.texture->image.pixels, "the picture");
  }
  return 0;
}
