#pragma once
// What a subcommand is to the program: it declares its options, then runs.

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

/// What a run says of itself beside its phase while it goes on: one line, which replaces the last.
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

/// One run of a subcommand: how it is watched and cancelled, and what it has to say. Text goes to
/// standard output when the command has ended, so that it never mixes with the progress bar.
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

  /// Puts a question to whoever sits before standard error and takes a line of standard input,
  /// while no progress is shown. nullopt: standard input has ended. Fails with kCancelled.
  Result<std::optional<std::string>> ask(const std::string& question);
  /// What shows progress; called with true before a question, with false behind it.
  void on_question(std::function<void(bool)> pause) { pause_ = std::move(pause); }

  /// States the phases that are still to come, from which one percentage and one time left follow.
  /// Without a plan each phase has its clock.
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

/// Of --overwrite-unfinished, in every command that makes a recording.
inline constexpr const char* kOverwriteUnfinishedHelp =
    "Remove what lies at RECORDING when it is a recording that was not finished";

class Command {
 public:
  virtual ~Command() = default;
  virtual void declare(CommandLine& line) = 0;
  /// What run() will read and write; the program refuses outputs over inputs.
  virtual FileRoles files() const = 0;
  /// kInvalidOption means wrong usage, kCancelled that the user stopped it; anything else failed.
  virtual Result<> run(Session& session) = 0;
};

}  // namespace turnscan::cli
