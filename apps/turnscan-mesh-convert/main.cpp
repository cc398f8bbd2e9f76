// turnscan-mesh-convert FILE [METRES_PER_UNIT]
// Reads FILE (3MF, GLB, or whatever assimp knows) and writes its objects in metres to standard
// output, as one binary PLY after another, each with its texture behind it. On failure: exit 1 and
// one line on standard error, "CODE: SENTENCE", where CODE is the name of a turnscan::ErrorCode.

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>
#include <turnscan/core/process/helper_program.hpp>
#include <turnscan/core/process/process_setup.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/file_name.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>
#include <turnscan/io/mesh/texture_block.hpp>

#include "assimp_mesh.hpp"

namespace {

using namespace turnscan;

constexpr std::uint64_t kGiB = std::uint64_t(1) << 30;

Result<mesh_io::MeshesWithUnit> read(const std::filesystem::path& path) {
  const std::string extension = file::lower_extension(path);
  if (extension == "3mf" || extension == "glb") {
    TURNSCAN_ASSIGN(const std::string bytes, read_file(path));
    if (extension == "3mf") return mesh_io::decode_3mf(bytes);
    TURNSCAN_ASSIGN(auto meshes, mesh_io::decode_glb(bytes));
    return mesh_io::MeshesWithUnit{std::move(meshes), 1.0};
  }
  TURNSCAN_ASSIGN(auto meshes, read_with_assimp(path));
  return mesh_io::MeshesWithUnit{std::move(meshes.meshes), meshes.metres_per_unit};
}

Result<> convert(int argc, char** argv) {
  if (argc < 2 || argc > 3)
    return fail(ErrorCode::kInvalidOption, "usage: turnscan-mesh-convert FILE [METRES_PER_UNIT]");
  TURNSCAN_ASSIGN(auto read_meshes, read(argv[1]));
  double unit = read_meshes.metres_per_unit;
  if (argc == 3) {
    TURNSCAN_ASSIGN(unit, parse_number(argv[2]));
  }
  for (TriangleMesh& mesh : read_meshes.meshes)
    for (Vec3f& p : mesh.vertices) p = (p.cast<double>() * unit).cast<float>();
  return write_file_atomically("/dev/stdout", [&](FileSink& sink) -> Result<> {
    for (const TriangleMesh& mesh : read_meshes.meshes)
      if (!mesh.empty()) {
        TURNSCAN_TRY(mesh_io::write_ply_mesh(sink, std::span(&mesh, 1)));
        TURNSCAN_TRY(mesh_io::write_texture_block(sink, mesh));
      }
    return {};
  });
}

int report(std::string_view code, std::string_view sentence) {
  fmt::print(stderr, "{}: {}\n", code, sentence.substr(0, sentence.find('\n')));
  return 1;
}

/// The exit status.
int run(int argc, char** argv) {
  try {
    const Result<> result = convert(argc, argv);
    if (result) return 0;
    return report(name_of(result.error().code), result.error().message);
  } catch (const std::bad_alloc&) {
    return report(name_of(ErrorCode::kResourceLimit), "reading it takes too much memory");
  } catch (const std::exception& error) {
    return report(name_of(ErrorCode::kFormat), error.what());
  }
}

}  // namespace

// Ends at once: what the libraries would still do at the exit, after a file that may have been made
// to harm them, can only spoil what has been written. Standard error is not buffered.
int main(int argc, char** argv) {
  process::set_up_process();
  std::error_code error;
  const std::uint64_t bytes = argc > 1 ? std::filesystem::file_size(argv[1], error) : 0;
  process::limit_this_process({.memory_bytes = 2 * kGiB,
                               .file_bytes = 2 * kGiB,
                               .cpu_seconds = mesh_io::most_convert_seconds(error ? 0 : bytes)});
  ::_exit(run(argc, argv));
}
