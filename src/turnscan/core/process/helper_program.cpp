#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <turnscan/core/process/helper_program.hpp>

namespace turnscan::process {

namespace fs = std::filesystem;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
#else
constexpr bool kSanitized = false;
#endif

bool is_program(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

/// PREFIX/libexec/turnscan for PREFIX/bin/program; a build tree has it in the same place.
std::optional<fs::path> near_executable(const std::string& name) {
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (int level = 0; level < 4 && !error && folder.has_relative_path(); ++level) {
    const fs::path candidate = folder / "libexec/turnscan" / name;
    if (is_program(candidate)) return candidate;
    folder = folder.parent_path();
  }
  return std::nullopt;
}

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  (void)::setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

}  // namespace

Result<fs::path> find_helper_program(const std::string& name) {
  if (const char* folder = std::getenv("TURNSCAN_LIBEXEC"); folder != nullptr && *folder != '\0') {
    const fs::path program = fs::path(folder) / name;
    if (is_program(program)) return program;
    return fail(ErrorCode::kMissingData, "there is no program {}; set TURNSCAN_LIBEXEC right",
                program.string());
  }
  if (const auto program = near_executable(name)) return *program;
  const fs::path installed = fs::path(TURNSCAN_LIBEXEC_DIR) / name;
  if (is_program(installed)) return installed;
  return fail(ErrorCode::kMissingData,
              "the program {} is not installed; set TURNSCAN_LIBEXEC to the folder that it is in",
              name);
}

std::optional<Error> helper_error(const ChildResult& child) {
  const std::string line = child.errors.substr(0, child.errors.find('\n'));
  for (const ErrorCode code :
       {ErrorCode::kNotFound, ErrorCode::kIo, ErrorCode::kFormat, ErrorCode::kUnsupported,
        ErrorCode::kTooFewPoints, ErrorCode::kResourceLimit, ErrorCode::kLibrary}) {
    const std::string start = std::string(name_of(code)) + ": ";
    if (line.starts_with(start)) return Error{code, line.substr(start.size()), {}};
  }
  return std::nullopt;
}

void limit_this_process(const ProcessLimits& limits) {
  if (limits.memory_bytes && !kSanitized) limit(RLIMIT_AS, *limits.memory_bytes);
  if (limits.file_bytes) limit(RLIMIT_FSIZE, *limits.file_bytes);
  if (limits.cpu_seconds) limit(RLIMIT_CPU, *limits.cpu_seconds);
  limit(RLIMIT_CORE, 0);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

}  // namespace turnscan::process
