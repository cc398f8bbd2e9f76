#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "cli/command.hpp"

namespace turnscan::cli {

namespace {

constexpr int kPoll_ms = 100;

/// A line without its end; nullopt: end of input.
Result<std::optional<std::string>> read_line(const RunContext& context) {
  std::string line;
  for (;;) {
    TURNSCAN_TRY(context.check());
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    if (::poll(&ready, 1, kPoll_ms) <= 0) continue;
    char c = 0;
    const ssize_t n = ::read(STDIN_FILENO, &c, 1);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return line.empty() ? std::nullopt : std::optional(line);
    if (c == '\n') return std::optional(line);
    line += c;
  }
}

}  // namespace

Result<std::optional<std::string>> Session::ask(const std::string& question) {
  if (pause_) pause_(true);
  std::fputs(question.c_str(), stderr);
  std::fflush(stderr);
  auto line = read_line(context_);
  if (pause_) pause_(false);
  return line;
}

}  // namespace turnscan::cli
