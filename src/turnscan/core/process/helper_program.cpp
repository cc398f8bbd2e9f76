#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <turnscan/core/process/helper_program.hpp>
#include <turnscan/core/process/program_folders.hpp>

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

/// Fails if there is one that cannot be executed, or if that cannot be determined.
Result<bool> is_program(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none)
    return fail_at(path.string(), ErrorCode::kIo,
                   "the program cannot be looked at ({}); check permissions", error.message());
  if (!fs::is_regular_file(status)) return false;
  if (::access(path.c_str(), X_OK) == 0) return true;
  return fail_at(path.string(), ErrorCode::kIo, "the program cannot be run ({}); check permissions",
                 std::generic_category().message(errno));
}

/// The program in the first of the folders that has it. Fails if it is not trusted there.
Result<std::optional<fs::path>> find_in(const std::vector<fs::path>& folders,
                                        const std::string& name) {
  for (const fs::path& folder : folders) {
    TURNSCAN_ASSIGN(const bool there, is_program(folder / name));
    if (!there) continue;
    TURNSCAN_ASSIGN(const fs::path whole, trusted(folder / name));
    return std::optional<fs::path>(whole);
  }
  return std::optional<fs::path>();
}

/// hard: limit at which the process is killed outright, without any message.
void limit(int resource, rlim_t value, rlim_t hard) {
  const rlimit both{value, hard};
  (void)::setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

}  // namespace

Result<fs::path> find_helper_program(const std::string& name) {
  TURNSCAN_ASSIGN(const auto given, folders_of_variable("TURNSCAN_LIBEXEC"));
  if (!given.empty()) {
    TURNSCAN_ASSIGN(const auto program, find_in(given, name));
    if (program) return *program;
    return fail(ErrorCode::kMissingData, "there is no program {}; set TURNSCAN_LIBEXEC right",
                (given.front() / name).string());
  }
  std::vector<fs::path> folders = own_folders("libexec/turnscan");
  folders.emplace_back(TURNSCAN_LIBEXEC_DIR);
  TURNSCAN_ASSIGN(const auto program, find_in(folders, name));
  if (program) return *program;
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
  if (limits.memory_bytes && !kSanitized)
    limit(RLIMIT_AS, *limits.memory_bytes, *limits.memory_bytes);
  if (limits.file_bytes) limit(RLIMIT_FSIZE, *limits.file_bytes, *limits.file_bytes);
  if (limits.cpu_seconds) limit(RLIMIT_CPU, *limits.cpu_seconds, *limits.cpu_seconds + 2);
  limit(RLIMIT_CORE, 0, 0);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

}  // namespace turnscan::process
