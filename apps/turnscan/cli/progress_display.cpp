#include "cli/progress_display.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace turnscan::cli {

namespace {

constexpr auto kTick = std::chrono::milliseconds(250);
constexpr int kBarCells = 24;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

// Not fmt::print: it throws if standard error is closed or full, which must not end a run. And a
// pipe that nobody reads must not block a recording: what does not fit is dropped.
void put(const std::string& text) {
  pollfd ready{STDERR_FILENO, POLLOUT, 0};
  if (poll(&ready, 1, 0) == 1) std::fputs(text.c_str(), stderr);
}

std::string duration_text(double s) {
  const int whole = static_cast<int>(std::ceil(s));
  if (whole < 60) return fmt::format("{} s", whole);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace

ProgressDisplay::ProgressDisplay(RunContext context, const StatusLine& status, bool quiet)
    : context_(std::move(context)),
      status_(status),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1) {
  if (quiet_) return;
  context_.set_listener([this](const Progress& progress) { on_progress(progress); });
  ticker_ = std::thread([this] { tick(); });
}

void ProgressDisplay::finish(RunEnd end) {
  if (!ticker_.joinable()) return;
  context_.set_listener({});
  {
    std::lock_guard lock(mutex_);
    finished_ = true;
  }
  wake_.notify_all();
  ticker_.join();
  if (terminal_)
    put("\r\033[K");
  else if (end == RunEnd::kDone && progress_.phase_number > 0)
    put(fmt::format("100 % done: {}\n", duration_text(seconds(Clock::now() - begin_))));
}

void ProgressDisplay::pause(bool paused) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  paused_ = paused;
  if (paused_)
    paused_at_ = Clock::now();
  else
    begin_ += Clock::now() - paused_at_;  // excludes the time that the user took to answer
  if (paused_ && terminal_) put("\r\033[K");
}

void ProgressDisplay::plan(PhasePlan phases) {
  const std::lock_guard lock(mutex_);
  overall_.plan(std::move(phases));
}

void ProgressDisplay::update() { overall_.update(progress_, seconds(Clock::now() - begin_)); }

void ProgressDisplay::on_progress(const Progress& progress) {
  std::lock_guard lock(mutex_);
  const bool begins = progress.phase_number != progress_.phase_number;
  progress_ = progress;
  update();
  if (begins) {
    phase_begin_ = last_line_ = Clock::now();
    last_fraction_ = overall_.fraction().value_or(last_fraction_);
    if (!terminal_ && !paused_) put(phase_text() + "\n");
  }
  if (terminal_ && !paused_) draw_bar();
}

// Some phases cannot report their progress; the ticker updates their elapsed time.
void ProgressDisplay::tick() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kTick, [this] { return finished_; })) {
    if (progress_.phase_number == 0 || paused_) continue;
    update();
    if (terminal_) {
      draw_bar();
    } else {
      write_line();
    }
  }
}

void ProgressDisplay::write_line() {
  const auto now = Clock::now();
  const double since = seconds(now - last_line_),
               fraction = overall_.fraction().value_or(last_fraction_);
  const bool tenth = fraction >= last_fraction_ + 0.1 && since >= 1.0;
  if (since < 10.0 && !tenth) return;
  last_line_ = now;
  last_fraction_ = fraction;
  put(fmt::format("{}: {}\n", phase_text(), state_text()));
}

std::string ProgressDisplay::phase_text() const {
  const auto fraction = overall_.fraction();
  if (!fraction) return progress_.phase;
  return fmt::format("{:3.0f} % {}", std::floor(100.0 * *fraction), progress_.phase);
}

std::string ProgressDisplay::state_text() const {
  const auto left = overall_.seconds_left();
  const std::string status = status_.text();
  if (left)
    return fmt::format("{} left{}{}", duration_text(std::max(*left, 1.0)),
                       status.empty() ? "" : ", ", status);
  return status.empty() ? duration_text(seconds(Clock::now() - phase_begin_)) : status;
}

void ProgressDisplay::draw_bar() const {
  const int cells = static_cast<int>(overall_.fraction().value_or(last_fraction_) * kBarCells);
  std::string line = fmt::format("{:<34.34} [{:#<{}}{:-<{}}] {}", phase_text(), "", cells, "",
                                 kBarCells - cells, state_text());
  line.resize(std::min(line.size(), terminal_width() - 1));
  put("\r" + line + "\033[K");
}

}  // namespace turnscan::cli
