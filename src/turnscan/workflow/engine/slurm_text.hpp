#pragma once
// What Slurm's programs print, and what they are given.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace turnscan::engine {

/// Of an element of a job array: PENDING, RUNNING, COMPLETED, ... as squeue and sacct name it.
struct SlurmState {
  std::string state;
  std::string reason;
};

/// The state that we give an element of which Slurm knows nothing any more.
inline constexpr const char* kForgotten = "FORGOTTEN";

/// "123_4" -> array 123, element 4.
struct SlurmElement {
  std::string job;
  int index = 0;
  auto operator<=>(const SlurmElement&) const = default;
};

/// Lines "JOB_INDEX|STATE|REASON" of squeue -r -o '%i|%T|%r' or sacct -P -o JobID,State,Reason;
/// steps
/// ("12_3.batch") and lines of other kinds are left out.
std::map<SlurmElement, SlurmState> parse_slurm_states(std::string_view text);

/// Whether the element will run, runs, or is being put back into the queue.
bool is_live(const SlurmState& state);
/// Whether a machine failed, or took the element away, and not the task.
bool is_lost(const SlurmState& state);
/// For people; empty for COMPLETED.
std::string reason_of(const SlurmState& state);

/// The job's number in the output of sbatch --parsable ("123" or "123;cluster").
std::optional<std::string> parse_job_number(std::string_view text);
/// The value of "Name = value" in the output of scontrol show config.
std::optional<std::string> config_value(std::string_view text, std::string_view name);

/// Words between spaces; quotes ('...', "...") keep spaces together. nullopt: a quote is open.
std::optional<std::vector<std::string>> split_words(std::string_view text);

/// A word that a shell takes as it is.
std::string quoted_word(const std::string& word);

}  // namespace turnscan::engine
