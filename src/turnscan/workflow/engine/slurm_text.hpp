#pragma once
// Parses the output of Slurm's programs and formats their input.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace turnscan::engine {

/// State of an element of a job array: PENDING, RUNNING, COMPLETED, ... as squeue and sacct name
/// it.
struct SlurmState {
  std::string state;
  std::string reason;
};

/// Our own state for an element that Slurm no longer knows.
inline constexpr const char* kForgotten = "FORGOTTEN";

/// "123_4" -> array 123, element 4.
struct SlurmElement {
  std::string job;
  int index = 0;
  auto operator<=>(const SlurmElement&) const = default;
};

/// Parses lines "JOB_INDEX|STATE|REASON" of squeue -r -o '%i|%T|%r' or sacct -P -o
/// JobID,State,Reason; skips steps ("12_3.batch") and other lines.
std::map<SlurmElement, SlurmState> parse_slurm_states(std::string_view text);

/// Whether the element is pending, running, or being requeued.
bool is_live(const SlurmState& state);
/// Whether the machine failed or the element was taken away, rather than the task having failed.
bool is_lost(const SlurmState& state);
/// Human-readable reason; empty for COMPLETED.
std::string reason_of(const SlurmState& state);

/// Job number in the output of sbatch --parsable ("123" or "123;cluster").
std::optional<std::string> parse_job_number(std::string_view text);
/// The value of "Name = value" in the output of scontrol show config.
std::optional<std::string> config_value(std::string_view text, std::string_view name);

/// Splits into words at spaces; quotes ('...', "...") keep spaces together. nullopt: unterminated
/// quote.
std::optional<std::vector<std::string>> split_words(std::string_view text);

/// Quotes a word for the shell.
std::string quoted_word(const std::string& word);

}  // namespace turnscan::engine
