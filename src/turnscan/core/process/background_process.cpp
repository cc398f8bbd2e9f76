#include <turnscan/core/process/background_process.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace turnscan::process {

namespace {

constexpr int kCannotStart = 127;  // the shells' convention

/// In the child, between fork and exec: must not take locks or allocate memory.
[[noreturn]] void become(char* const* words, const char* log, const char* folder, pid_t parent) {
  ::setpgid(0, 0);
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kCannotStart);  // it ended before the line above
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  const int input = ::open("/dev/null", O_RDONLY);
  const int output = ::open(log, O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW, 0666);
  if (input < 0 || output < 0 || ::dup2(input, STDIN_FILENO) < 0 ||
      ::dup2(output, STDOUT_FILENO) < 0 || ::dup2(output, STDERR_FILENO) < 0)
    ::_exit(kCannotStart);
  if (*folder != '\0' && ::chdir(folder) != 0) ::_exit(kCannotStart);
  if (input > STDERR_FILENO) ::close(input);
  if (output > STDERR_FILENO) ::close(output);
  ::execv(words[0], words);
  constexpr std::string_view kText = "turnscan: the program of a task cannot be started\n";
  (void)!::write(STDERR_FILENO, kText.data(), kText.size());
  ::_exit(kCannotStart);
}

double process_seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Result<BackgroundProcess> BackgroundProcess::start(const std::filesystem::path& program,
                                                   std::span<const std::string> arguments,
                                                   const std::filesystem::path& log,
                                                   const std::filesystem::path& folder) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) become(pointers.data(), log.c_str(), folder.c_str(), parent);
  if (child < 0)
    return fail_at(program.string(), ErrorCode::kIo, "cannot start the program: {}",
                   std::generic_category().message(errno));
  return BackgroundProcess(child);
}

BackgroundProcess::BackgroundProcess(BackgroundProcess&& other) noexcept
    : child_(std::exchange(other.child_, -1)) {}

BackgroundProcess& BackgroundProcess::operator=(BackgroundProcess&& other) noexcept {
  std::swap(child_, other.child_);
  return *this;
}

BackgroundProcess::~BackgroundProcess() {
  if (child_ < 0) return;
  stop(true);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<ProcessEnd> BackgroundProcess::poll() {
  int status = 0;
  rusage used{};
  const pid_t ended = child_ < 0 ? -1 : ::wait4(child_, &status, WNOHANG, &used);
  if (ended == 0 || (ended < 0 && errno == EINTR)) return std::nullopt;
  child_ = -1;
  ProcessEnd end;
  if (ended < 0) return end;
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  end.peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  end.cpu_seconds = process_seconds(used.ru_utime) + process_seconds(used.ru_stime);
  return end;
}

void BackgroundProcess::stop(bool now) const {
  if (child_ < 0) return;
  // SIGTERM only to the program, which terminates its own children in order.
  if (now) ::kill(-child_, SIGKILL);
  ::kill(child_, now ? SIGKILL : SIGTERM);
}

}  // namespace turnscan::process
