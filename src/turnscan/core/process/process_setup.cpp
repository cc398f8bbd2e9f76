#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <turnscan/core/process/process_setup.hpp>

namespace turnscan::process {

void set_up_process() {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    const int opened = ::open("/dev/null", O_RDWR);  // the lowest free one
    if (opened != descriptor && opened >= 0) (void)::dup2(opened, descriptor);
  }
  (void)::signal(SIGPIPE, SIG_IGN);
  (void)::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace turnscan::process
