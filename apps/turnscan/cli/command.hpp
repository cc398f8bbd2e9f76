#pragma once
// Interface of a subcommand: it declares its options, then runs.

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/workflow/file_roles.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <utility>
#include <vector>

namespace turnscan::cli {

class CommandLine;

/// Status text of a run, shown next to its phase: one line, which replaces the previous one.
class StatusLine {
 public:
  void set(std::string text) {
    const std::lock_guard lock(mutex_);
    text_ = std::move(text);
  }
  std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

/// One run of a subcommand: its context and its output. Text goes to standard output after the
/// command has ended, so that it never mixes with the progress bar.
class Session {
 public:
  explicit Session(RunContext context) : context_(std::move(context)) {}

  const RunContext& context() const { return context_; }
  StatusLine& status() { return *status_; }

  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    text_ += fmt::format(format, std::forward<Args>(args)...);
  }
  const std::string& text() const { return text_; }

  /// Prints a question to standard error and reads a line from standard input, with the progress
  /// display paused. nullopt: standard input has ended. Fails with kCancelled.
  Result<std::optional<std::string>> ask(const std::string& question);
  /// Sets the callback that pauses the progress display; called with true before a question, with
  /// false after it.
  void on_question(std::function<void(bool)> pause) { pause_ = std::move(pause); }

  /// States the remaining phases, so that one percentage and one remaining time can be shown.
  /// Without a plan each phase shows its own elapsed time.
  void plan(PhasePlan phases) {
    if (take_plan_) take_plan_(std::move(phases));
  }
  void on_plan(std::function<void(PhasePlan)> take) { take_plan_ = std::move(take); }

 private:
  std::function<void(bool)> pause_;
  std::function<void(PhasePlan)> take_plan_;
  RunContext context_;
  std::unique_ptr<StatusLine> status_ = std::make_unique<StatusLine>();
  std::string text_;
};

/// Help of --overwrite-unfinished, for every command that makes a recording.
inline constexpr const char* kOverwriteUnfinishedHelp =
    "Replace RECORDING if it holds a recording that was not finished";

class Command {
 public:
  virtual ~Command() = default;
  virtual void declare(CommandLine& line) = 0;
  /// What run() will read and write; the program rejects outputs that would overwrite inputs.
  virtual FileRoles files() const = 0;
  /// kInvalidOption means wrong usage, kCancelled that the user stopped it; anything else is a
  /// failure.
  virtual Result<> run(Session& session) = 0;
};

}  // namespace turnscan::cli
