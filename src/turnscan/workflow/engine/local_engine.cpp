#include <turnscan/workflow/engine/local_engine.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <system_error>
#include <thread>
#include <turnscan/core/process/background_process.hpp>
#include <turnscan/workflow/engine/job_log.hpp>

namespace turnscan::engine {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kPoll = std::chrono::milliseconds(10);
constexpr auto kLongestPoll = std::chrono::milliseconds(500);
// For cancelled jobs to terminate their own children.
constexpr auto kGrace = std::chrono::seconds(15);

std::uint64_t number_in(const fs::path& file) {
  std::ifstream in(file);
  in.imbue(std::locale::classic());
  std::uint64_t value = 0;
  return in >> value ? value : 0;
}

/// MemAvailable of /proc/meminfo.
std::uint64_t available_bytes() {
  std::ifstream in("/proc/meminfo");
  in.imbue(std::locale::classic());
  std::string name, unit;
  for (std::uint64_t kilobytes = 0; in >> name >> kilobytes;) {
    if (name == "MemAvailable:") return kilobytes * 1024;
    std::getline(in, unit);
  }
  return std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGESIZE)) / 2;
}

class LocalEngine : public Engine {
 public:
  LocalEngine(JobCommand command, const LocalLimits& limits, file::Folder folder)
      : command_(std::move(command)), limits_(limits), folder_(std::move(folder)) {}

  Result<std::vector<std::string>> adopt() override { return std::vector<std::string>(); }

  Result<> submit(const std::vector<Job>& jobs) override {
    waiting_.insert(waiting_.end(), jobs.begin(), jobs.end());
    return start_what_fits();
  }

  Result<std::vector<Ended>> poll() override {
    const auto begin = Clock::now();
    for (;;) {
      std::vector<Ended> ended = reap();
      TURNSCAN_TRY(start_what_fits());
      if (!ended.empty() || running_.empty() || Clock::now() - begin > kLongestPoll) return ended;
      std::this_thread::sleep_for(kPoll);
    }
  }

  void cancel() override {
    waiting_.clear();
    for (const Running& job : running_) job.process.stop(false);
    const auto begin = Clock::now();
    while (!running_.empty() && Clock::now() - begin < kGrace) {
      (void)reap();
      std::this_thread::sleep_for(kPoll);
    }
    running_.clear();  // kills the remaining ones
  }

  std::string status() const override { return fmt::format("{} running", running_.size()); }

 private:
  struct Running {
    Job job;
    process::BackgroundProcess process;
  };

  bool fits(const Job& job) const {
    if (running_.empty()) return true;
    if (running_.size() >= static_cast<std::size_t>(limits_.jobs)) return false;
    std::uint64_t used = job.peak_bytes;
    for (const Running& running : running_) used += running.job.peak_bytes;
    return used <= limits_.memory_bytes;
  }

  static std::string log_of(const std::string& name) { return name + ".log"; }

  Result<> start_what_fits() {
    while (!waiting_.empty() && fits(waiting_.front())) {
      std::vector<std::string> arguments = command_.arguments;
      arguments.push_back(waiting_.front().name);
      const std::string log = log_of(waiting_.front().name);
      TURNSCAN_TRY(folder_.remove(log));
      TURNSCAN_ASSIGN(
          process::BackgroundProcess process,
          process::BackgroundProcess::start(command_.program, arguments, folder_.anchor() / log));
      running_.push_back({std::move(waiting_.front()), std::move(process)});
      waiting_.pop_front();
    }
    return {};
  }

  std::vector<Ended> reap() {
    std::vector<Ended> ended;
    for (auto job = running_.begin(); job != running_.end();) {
      const auto end = job->process.poll();
      if (!end) {
        ++job;
        continue;
      }
      ended.push_back(end_of(job->job.name, *end));
      job = running_.erase(job);
    }
    return ended;
  }

  Ended end_of(const std::string& name, const process::ProcessEnd& end) const {
    const std::string log = log_of(name);
    Ended ended{name, {}, end.signal != 0};
    if (end.signal != 0)
      ended.reason = fmt::format("its process was killed by signal {}", end.signal);
    if (end.signal == 0 && end.exit_code != 0) ended.reason = last_line_of(folder_, log);
    if (end.exit_code == 0) (void)folder_.remove(log);
    return ended;
  }

  const JobCommand command_;
  const LocalLimits limits_;
  const file::Folder folder_;
  std::deque<Job> waiting_;
  std::vector<Running> running_;
};

}  // namespace

std::uint64_t usable_memory_bytes() {
  std::uint64_t bytes = available_bytes();
  // 0: "max", or there is no such group.
  const std::uint64_t most = number_in("/sys/fs/cgroup/memory.max");
  const std::uint64_t used = number_in("/sys/fs/cgroup/memory.current");
  if (most > 0) bytes = std::min(bytes, most > used ? most - used : 0);
  return bytes / 10 * 9;
}

std::unique_ptr<Engine> make_local_engine(const JobCommand& command, const LocalLimits& limits,
                                          file::Folder folder) {
  return std::make_unique<LocalEngine>(command, limits, std::move(folder));
}

}  // namespace turnscan::engine
