// The input gives vertices and triangles: every format is written and read again.

#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/mesh_from.hpp"
#include "tests/fuzz/scratch_folder.hpp"

namespace {

using namespace turnscan;

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
  const TriangleMesh mesh = fuzz::mesh_from(data, size);
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
