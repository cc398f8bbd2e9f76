#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <turnscan/core/process/child_process.hpp>
#include <vector>

namespace turnscan::process {

namespace {

using Clock = std::chrono::steady_clock;

/// A file in memory: unlike a pipe, it never blocks the child.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(::memfd_create(name, MFD_CLOEXEC)) {}
  ~MemoryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }

  /// Sets the content of the file, to be read from the start. Call once.
  bool fill(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::lseek(descriptor_, 0, SEEK_SET) == 0;
  }

  std::string content(std::size_t max_bytes) const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) return {};
    std::string text(std::min(static_cast<std::size_t>(status.st_size), max_bytes), '\0');
    std::size_t used = 0;
    while (used < text.size()) {
      const ssize_t got =
          ::pread(descriptor_, text.data() + used, text.size() - used, static_cast<off_t>(used));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      used += static_cast<std::size_t>(got);
    }
    text.resize(used);
    return text;
  }

 private:
  int descriptor_;
};

/// Settings of posix_spawn for the child: its own process group, so that Ctrl-C in the terminal
/// reaches only this process, and no blocked or ignored signals.
class SpawnSettings {
 public:
  SpawnSettings(int input, int output, int errors) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions_, errors, STDERR_FILENO);
    sigset_t none;
    sigset_t all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
  }
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

std::vector<char*> argument_pointers(std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  return pointers;
}

void kill_and_reap(pid_t child) {
  ::kill(-child, SIGKILL);
  ::kill(child, SIGKILL);
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

/// The status from waitpid once the child has ended by itself.
Result<int> wait_for(pid_t child, const std::filesystem::path& program, double seconds,
                     const RunContext& ctx) {
  const auto start = Clock::now();
  auto pause = std::chrono::microseconds(200);
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR)
      return fail_at(program.string(), ErrorCode::kIo, "the program was lost: {}",
                     std::generic_category().message(errno));
    if (auto go_on = ctx.check(); !go_on) {
      kill_and_reap(child);
      return tl::unexpected<Error>(std::move(go_on).error());
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) {
      kill_and_reap(child);
      return fail(ErrorCode::kResourceLimit, "it took more than {} s and was ended", seconds);
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::microseconds(20000));
  }
}

}  // namespace

Result<ChildResult> run_child(const std::filesystem::path& program,
                              std::span<const std::string> arguments, double seconds,
                              const RunContext& ctx, std::string_view input_bytes) {
  // A short program may end before the first poll.
  TURNSCAN_TRY(ctx.check());
  MemoryFile input("input");
  if (!input.fill(input_bytes))
    return fail_at(program.string(), ErrorCode::kIo, "cannot pass its input to the program: {}",
                   std::generic_category().message(errno));
  const MemoryFile output("output");
  const MemoryFile errors("errors");
  const SpawnSettings settings(input.descriptor(), output.descriptor(), errors.descriptor());
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  pid_t child = -1;
  const int error = ::posix_spawn(&child, program.c_str(), settings.actions(),
                                  settings.attributes(), argument_pointers(words).data(), environ);
  if (error != 0)
    return fail_at(program.string(), ErrorCode::kIo, "cannot start the program: {}",
                   std::generic_category().message(error));
  TURNSCAN_ASSIGN(const int status, wait_for(child, program, seconds, ctx));
  ChildResult result;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.output = output.content(~std::size_t(0));
  result.errors = errors.content(std::size_t(1) << 16);
  return result;
}

}  // namespace turnscan::process
