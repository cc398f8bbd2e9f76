#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <thread>
#include <turnscan/reconstruction/child_process.hpp>

namespace turnscan {

namespace {

constexpr int kWorkFailed = 3;

bool write_all(int fd, const void* data, std::size_t size) {
  const char* p = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(fd, p, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    p += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

[[noreturn]] void run_child(const std::function<Result<Bytes>()>& work, int out, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  // Ctrl-C reaches the whole process group; the parent decides what becomes of the child.
  ::signal(SIGINT, SIG_IGN);
  const int null = ::open("/dev/null", O_WRONLY);
  if (null >= 0) {
    ::dup2(null, STDOUT_FILENO);
    ::dup2(null, STDERR_FILENO);
  }
  std::string error;
  try {
    auto result = work();
    if (result) ::_exit(write_all(out, result->data(), result->size()) ? 0 : 1);
    error = result.error().message;
  } catch (const std::exception& e) {
    error = e.what();
  }
  write_all(out, error.data(), error.size());
  ::_exit(kWorkFailed);
}

Result<Bytes> read_back(int fd) {
  struct stat info {};
  if (::fstat(fd, &info) != 0)
    return fail(ErrorCode::kIo, "child process: {}", std::strerror(errno));
  Bytes bytes(static_cast<std::size_t>(info.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::pread(fd, bytes.data() + done, bytes.size() - done, off_t(done));
    if (n <= 0) return fail(ErrorCode::kIo, "child process: its result cannot be read");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

Result<int> wait_for(pid_t child, const RunContext& context) {
  int status = 0;
  while (true) {
    const pid_t done = ::waitpid(child, &status, WNOHANG);
    if (done == child) return status;
    if (done < 0 && errno != EINTR)
      return fail(ErrorCode::kLibrary, "child process: {}", std::strerror(errno));
    if (context.cancelled()) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return fail(ErrorCode::kCancelled, "cancelled");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

Result<Bytes> run_in_child(const std::function<Result<Bytes>()>& work, const RunContext& context) {
  TURNSCAN_TRY(context.check());
  const int out = ::memfd_create("turnscan-result", MFD_CLOEXEC);
  if (out < 0) return fail(ErrorCode::kIo, "child process: {}", std::strerror(errno));
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) run_child(work, out, parent);
  if (child < 0) {
    ::close(out);
    return fail(ErrorCode::kIo, "child process: {}", std::strerror(errno));
  }
  const auto status = wait_for(child, context);
  if (!status) {
    ::close(out);
    return tl::unexpected<Error>(status.error());
  }
  auto bytes = read_back(out);
  ::close(out);
  if (!bytes || (WIFEXITED(*status) && WEXITSTATUS(*status) == 0)) return bytes;
  if (WIFEXITED(*status) && WEXITSTATUS(*status) == kWorkFailed)
    return fail(ErrorCode::kLibrary, "{}",
                std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
  if (WIFSIGNALED(*status))
    return fail(ErrorCode::kLibrary, "the library crashed with signal {}", WTERMSIG(*status));
  return fail(ErrorCode::kLibrary, "the child process ended with status {}", WEXITSTATUS(*status));
}

}  // namespace turnscan
