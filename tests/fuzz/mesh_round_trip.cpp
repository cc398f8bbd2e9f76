// The input gives vertices and triangles: every format is written and read again.

#include <cstring>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace {

using namespace turnscan;

/// A tenth of the bytes are vertices of up to 1 km, the rest triangles of different vertices.
TriangleMesh mesh_from(const std::uint8_t* data, std::size_t size) {
  TriangleMesh mesh;
  const std::size_t vertices = std::min<std::size_t>(3 + size / 20, 200);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::array<std::int16_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = static_cast<std::int16_t>(data[(6 * v + 2 * k) % size] << 8 |
                                       data[(6 * v + 2 * k + 1) % size]);
    mesh.vertices.push_back(Vec3f(c[0], c[1], c[2]) / 32.0f);
  }
  for (std::size_t i = 0; i + 2 < size && mesh.triangles.size() < 400; i += 3) {
    const auto n = static_cast<std::uint32_t>(vertices);
    const std::array<std::uint32_t, 3> t{data[i] % n, data[i + 1] % n, data[i + 2] % n};
    if (t[0] != t[1] && t[1] != t[2] && t[0] != t[2]) mesh.triangles.push_back(t);
  }
  return mesh;
}

Result<std::vector<TriangleMesh>> read_back(const std::string& ending, const std::string& bytes) {
  if (ending == "ply") return mesh_io::decode_ply_mesh(bytes);
  if (ending == "obj") return mesh_io::decode_obj(bytes);
  if (ending == "stl") return mesh_io::decode_stl(bytes);
  return mesh_io::decode_glb(bytes);
}

}  // namespace

TURNSCAN_FUZZ_TARGET(mesh_round_trip) {
  if (size < 12) return 0;
  static const fuzz::ScratchFolder folder;
  const TriangleMesh mesh = mesh_from(data, size);
  if (mesh.triangles.empty()) return 0;
  for (const std::string ending : {"ply", "obj", "stl", "glb"}) {
    const auto path = folder / ("m." + ending);
    fuzz::require(bool(write_mesh(path, mesh)), "a mesh that can be written");
    const auto again = read_back(ending, *read_file(path));
    fuzz::require(again && again->size() == 1, "read again");
    fuzz::check(*again);
    fuzz::require(again->front().triangles.size() == mesh.triangles.size(), "all triangles");
    if (ending != "ply") continue;
    fuzz::require(
        again->front().vertices == mesh.vertices && again->front().triangles == mesh.triangles,
        "PLY bit by bit");
  }
  return 0;
}
