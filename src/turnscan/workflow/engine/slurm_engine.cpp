#include <turnscan/workflow/engine/slurm_engine.hpp>

#include <algorithm>
#include <chrono>
#include <set>
#include <system_error>
#include <thread>
#include <turnscan/io/file/sha256.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/workflow/engine/job_log.hpp>
#include <turnscan/workflow/engine/slurm_client.hpp>

namespace turnscan::engine {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kSleep = std::chrono::milliseconds(100);
constexpr auto kNoAnswer = std::chrono::hours(1);      // after which the engine is considered lost
constexpr auto kCancelled = std::chrono::seconds(40);  // KillWait is 30 s
constexpr double kMemoryMargin = 1.3;

/// A path in a file name pattern of sbatch, where %% stands for %.
std::string file_pattern(const fs::path& path) {
  std::string pattern;
  for (const char c : path.string()) pattern.append(c == '%' ? 2 : 1, c);
  return pattern;
}

class SlurmEngine : public Engine {
 public:
  SlurmEngine(JobCommand command, SlurmSettings settings, std::vector<std::string> options,
              file::Folder folder, const RunContext& context)
      : command_(std::move(command)),
        settings_(std::move(settings)),
        options_(std::move(options)),
        folder_(std::move(folder)),
        client_(context) {}

  Result<std::vector<std::string>> adopt() override {
    std::vector<std::string> names;
    for (int number = 1; folder_.has(list_file(number)); ++number) {
      next_ = number + 1;
      TURNSCAN_ASSIGN(const std::vector<std::string> jobs, client_.live_jobs(job_name(number)));
      for (const std::string& job : jobs) {
        TURNSCAN_TRY(take(job, number));
        jobs_.push_back(job);
      }
    }
    if (jobs_.empty()) return names;
    TURNSCAN_ASSIGN(const auto states, client_.states(jobs_));
    for (auto element = open_.begin(); element != open_.end();) {
      const auto state = states.find(element->first);
      const bool live = state != states.end() && is_live(state->second);
      if (live) names.insert(names.end(), element->second.begin(), element->second.end());
      element = live ? std::next(element) : open_.erase(element);
    }
    return names;
  }

  Result<> submit(const std::vector<Job>& jobs) override {
    const std::size_t per_element = static_cast<std::size_t>(settings_.tasks_per_job);
    const std::size_t most = static_cast<std::size_t>(client_.largest_array()) * per_element;
    for (std::size_t begin = 0; begin < jobs.size(); begin += most) {
      const auto first = jobs.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto count = static_cast<std::ptrdiff_t>(std::min(most, jobs.size() - begin));
      TURNSCAN_TRY(submit_array({first, first + count}));
    }
    return {};
  }

  Result<std::vector<Ended>> poll() override {
    std::vector<Ended> ended;
    if (open_.empty()) return ended;
    const auto interval = std::chrono::duration<double>(settings_.poll_s) + 10 * last_call_;
    const auto begin = Clock::now();
    if (begin - asked_ < interval) {
      std::this_thread::sleep_for(kSleep);
      return ended;
    }
    const auto states = client_.states(jobs_);
    asked_ = Clock::now();
    last_call_ = asked_ - begin;
    if (!states) {
      TURNSCAN_TRY(note_no_answer(states.error()));
      return ended;
    }
    answered_ = asked_;
    answers_ = true;
    collect(*states, ended);
    return ended;
  }

  void cancel() override {
    if (open_.empty()) return;
    const SlurmClient client{RunContext()};  // our own context is already cancelled
    (void)client.call("scancel", jobs_);
    const auto begin = Clock::now();
    while (Clock::now() - begin < kCancelled) {
      const auto states = client.states(jobs_);
      if (states && std::none_of(states->begin(), states->end(),
                                 [](const auto& one) { return is_live(one.second); }))
        break;
      std::this_thread::sleep_for(5 * kSleep);
    }
    open_.clear();
  }

  std::string status() const override {
    if (!answers_) return "Slurm does not answer; waiting for it";
    std::string text = fmt::format("{} running, {} queued", running_, queued_);
    if (!pending_reason_.empty()) text += fmt::format(" ({})", pending_reason_);
    return text;
  }

 private:
  static std::string list_file(int number) { return fmt::format("slurm-{}.list", number); }

  /// Identifies a job whose number was lost with its submitter.
  std::string job_name(int number) const {
    file::Sha256 sum;
    sum.add(folder_.path().string());
    return fmt::format("turnscan-{}-{}", file::hex_of(sum.finish()).substr(0, 12), number);
  }

  /// Adds the elements of a job from its list file.
  Result<> take(const std::string& job, int number) {
    TURNSCAN_ASSIGN(const std::string text, folder_.read(list_file(number)));
    text::LineReader lines(text);
    for (int index = 0; const auto line = lines.next(); ++index)
      for (const std::string_view name : text::words_of(line->text))
        open_[{job, index}].emplace_back(name);
    return {};
  }

  Result<> submit_array(const std::vector<Job>& jobs) {
    const std::size_t per_element = static_cast<std::size_t>(settings_.tasks_per_job);
    std::string list;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      list += jobs[i].name + ((i + 1) % per_element == 0 || i + 1 == jobs.size() ? "\n" : " ");
    while (folder_.has(list_file(next_))) ++next_;
    const int number = next_++;
    TURNSCAN_TRY(folder_.write(list_file(number), list));
    const std::size_t elements = (jobs.size() + per_element - 1) / per_element;
    TURNSCAN_ASSIGN(const std::string text,
                    client_.call("sbatch", arguments(jobs, number, elements), script(number)));
    const auto job = parse_job_number(text);
    if (!job) return fail(ErrorCode::kLibrary, "sbatch: '{}' is no number of a job", text);
    jobs_.push_back(*job);
    asked_ = answered_ = Clock::now();
    return take(*job, number);
  }

  std::vector<std::string> arguments(const std::vector<Job>& jobs, int number,
                                     std::size_t elements) const {
    std::vector<std::string> words{
        "--parsable",
        "--requeue",
        "--open-mode=append",
        "--job-name=" + job_name(number),
        fmt::format("--array=0-{}", elements - 1),
        fmt::format("--cpus-per-task={}", command_.threads),
        "--chdir=" + folder_.path().string(),
        "--output=" + file_pattern(folder_.path() / "slurm-") + "%A_%a.log"};
    std::uint64_t peak = 0;
    for (const Job& job : jobs) peak = std::max(peak, job.peak_bytes);
    const auto megabytes =
        static_cast<std::uint64_t>(kMemoryMargin * static_cast<double>(peak) / (1 << 20)) + 1;
    // A cluster whose nodes' memory is not configured (1 MB then) rejects every memory request.
    if (client_.node_megabytes() >= megabytes) words.push_back(fmt::format("--mem={}M", megabytes));
    words.insert(words.end(), options_.begin(), options_.end());
    return words;
  }

  std::string script(int number) const {
    std::string words = quoted_word(command_.program.string());
    for (const std::string& argument : command_.arguments) words += " " + quoted_word(argument);
    return fmt::format("#!/bin/sh\nexec {} $(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" {})\n", words,
                       quoted_word((folder_.path() / list_file(number)).string()));
  }

  Result<> note_no_answer(const Error& error) {
    if (error.code == ErrorCode::kCancelled) return tl::unexpected<Error>(error);
    answers_ = false;
    if (Clock::now() - answered_ < kNoAnswer) return {};
    return fail(ErrorCode::kLibrary,
                "Slurm has not answered for an hour ({}); its jobs go on, run the batch again to "
                "follow them",
                error.message);
  }

  void collect(const std::map<SlurmElement, SlurmState>& states, std::vector<Ended>& ended) {
    running_ = queued_ = 0;
    pending_reason_.clear();
    std::map<SlurmElement, SlurmState> accounts;
    bool asked_accounts = false;
    for (auto element = open_.begin(); element != open_.end();) {
      auto state = states.find(element->first);
      if (state != states.end() && is_live(state->second)) {
        count(state->second);
        ++element;
        continue;
      }
      SlurmState last = state != states.end() ? state->second : SlurmState{kForgotten, ""};
      bool vanished = state == states.end();
      if (state == states.end()) {
        if (!std::exchange(asked_accounts, true)) accounts = client_.accounted(jobs_);
        if (const auto kept = accounts.find(element->first); kept != accounts.end())
          last = kept->second, vanished = false;
      }
      for (const std::string& name : element->second)
        ended.push_back({name, end_reason(element->first, last), is_lost(last) || vanished});
      element = open_.erase(element);
    }
  }

  void count(const SlurmState& state) {
    const bool pending = state.state == "PENDING";
    ++(pending ? queued_ : running_);
    const bool usual = state.reason == "Resources" || state.reason == "Priority" ||
                       state.reason == "None" || state.reason == "BeginTime";
    if (pending && !usual) pending_reason_ = state.reason;
  }

  /// The message of the task's own process; Slurm only knows its exit code.
  std::string end_reason(const SlurmElement& element, const SlurmState& state) const {
    const std::string log = fmt::format("slurm-{}_{}.log", element.job, element.index);
    const auto text = folder_.read(log);
    if (state.state == "COMPLETED" && text && text->empty()) (void)folder_.remove(log);
    if (state.state == "FAILED") return last_line_of(folder_, log);
    return reason_of(state);
  }

  const JobCommand command_;
  const SlurmSettings settings_;
  const std::vector<std::string> options_;
  const file::Folder folder_;
  const SlurmClient client_;
  std::vector<std::string> jobs_;
  std::map<SlurmElement, std::vector<std::string>> open_;  ///< names of tasks
  int next_ = 1;
  Clock::time_point asked_{}, answered_ = Clock::now();
  Clock::duration last_call_{};
  bool answers_ = true;
  int running_ = 0, queued_ = 0;
  std::string pending_reason_;
};

}  // namespace

Result<std::unique_ptr<Engine>> make_slurm_engine(const JobCommand& command,
                                                  const SlurmSettings& settings,
                                                  file::Folder folder, const RunContext& context) {
  auto options = split_words(settings.options);
  if (!options)
    return fail(ErrorCode::kInvalidOption, "--engine-options {}: a quote is not closed",
                settings.options);
  const SlurmClient client(context);
  TURNSCAN_TRY(client.call("sbatch", {"--version"}));
  return std::make_unique<SlurmEngine>(command, settings, std::move(*options), std::move(folder),
                                       context);
}

}  // namespace turnscan::engine
