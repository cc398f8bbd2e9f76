#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <turnscan/io/child_process.hpp>
#include <turnscan/io/mesh_convert.hpp>
#include <turnscan/io/mesh_formats.hpp>

namespace turnscan::detail {

namespace fs = std::filesystem;

namespace {

bool is_program(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

/// PREFIX/libexec/turnscan for PREFIX/bin/program, or apps/ of a build tree.
std::optional<fs::path> near_executable() {
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (int level = 0; level < 4 && !error && folder.has_relative_path(); ++level) {
    for (const fs::path& candidate : {folder / "libexec/turnscan" / kMeshConverter,
                                      folder / "apps" / kMeshConverter / kMeshConverter})
      if (is_program(candidate)) return candidate;
    folder = folder.parent_path();
  }
  return std::nullopt;
}

Result<fs::path> find_converter() {
  if (const char* folder = std::getenv("TURNSCAN_LIBEXEC"); folder != nullptr && *folder != '\0') {
    const fs::path program = fs::path(folder) / kMeshConverter;
    if (is_program(program)) return program;
    return fail(ErrorCode::kMissingData, "there is no program {}; set TURNSCAN_LIBEXEC right",
                program.string());
  }
  if (const auto program = near_executable()) return *program;
  const fs::path installed = fs::path(TURNSCAN_LIBEXEC_DIR) / kMeshConverter;
  if (is_program(installed)) return installed;
  return fail(ErrorCode::kMissingData,
              "the program {} is not installed; set TURNSCAN_LIBEXEC to the folder that it is in",
              kMeshConverter);
}

/// The program's message begins with the name of an error code and ": ".
tl::unexpected<Error> error_from(const ChildResult& child) {
  const std::string line = child.errors.substr(0, child.errors.find('\n'));
  for (const ErrorCode code :
       {ErrorCode::kNotFound, ErrorCode::kIo, ErrorCode::kFormat, ErrorCode::kUnsupported,
        ErrorCode::kTooFewPoints, ErrorCode::kResourceLimit}) {
    const std::string start = std::string(name_of(code)) + ": ";
    if (line.starts_with(start)) return fail(code, "{}", line.substr(start.size()));
  }
  return fail(ErrorCode::kLibrary, "the mesh reader failed: {}", line);
}

Result<std::vector<TriangleMesh>> meshes_from(const ChildResult& child) {
  if (child.signal == SIGXCPU)
    return fail(ErrorCode::kResourceLimit, "reading it took too much time");
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
  TURNSCAN_ASSIGN(const fs::path program, find_converter());
  std::vector<std::string> arguments{fs::absolute(path).string()};
  if (metres_per_unit) arguments.push_back(fmt::format("{}", *metres_per_unit));
  TURNSCAN_ASSIGN(const ChildResult child, run_child(program, arguments, seconds, ctx));
  return meshes_from(child);
}

}  // namespace turnscan::detail
