#include <signal.h>

#include <turnscan/core/process/helper_program.hpp>
#include <turnscan/io/mesh/mesh_convert.hpp>
#include <turnscan/io/mesh/mesh_formats.hpp>

namespace turnscan::mesh_io {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> error_from(const process::ChildResult& child) {
  if (auto error = process::helper_error(child); error && error->code != ErrorCode::kLibrary)
    return tl::unexpected<Error>(std::move(*error));
  return fail(ErrorCode::kLibrary, "the mesh reader failed: {}",
              child.errors.substr(0, child.errors.find('\n')));
}

Result<std::vector<TriangleMesh>> meshes_from(const process::ChildResult& child) {
  if (child.signal == SIGXCPU)
    return fail(ErrorCode::kResourceLimit,
                "reading it took more time than a sound file of its length needs; write it with "
                "another program");
  if (child.signal == SIGKILL || child.signal == SIGXFSZ)
    return fail(ErrorCode::kResourceLimit, "reading it took too much memory");
  if (child.signal != 0)
    return fail(ErrorCode::kFormat, "damaged file: its reader crashed (signal {})", child.signal);
  if (child.exit_code != 0) return error_from(child);
  return decode_ply_sequence(child.output);
}

}  // namespace

Result<std::vector<TriangleMesh>> read_in_child(const fs::path& path,
                                                std::optional<double> metres_per_unit,
                                                const RunContext& ctx, double seconds) {
  TURNSCAN_ASSIGN(const fs::path program, process::find_helper_program(kMeshConverter));
  std::vector<std::string> arguments{fs::absolute(path).string()};
  if (metres_per_unit) arguments.push_back(fmt::format("{}", *metres_per_unit));
  TURNSCAN_ASSIGN(const process::ChildResult child,
                  process::run_child(program, arguments, seconds, ctx));
  return meshes_from(child);
}

}  // namespace turnscan::mesh_io
