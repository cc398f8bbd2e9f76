#include <turnscan/workflow/engine/slurm_client.hpp>

#include <algorithm>
#include <charconv>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/workflow/installed_program.hpp>

namespace turnscan::engine {

namespace {

constexpr double kLongestCall_s = 120.0;
constexpr int kDefaultArray = 1001;  // MaxArraySize if it cannot be queried

std::string joined_with_commas(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ","));
}

std::uint64_t whole_number(std::string_view text) {
  std::uint64_t value = 0;
  (void)std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

Result<std::string> SlurmClient::call(const std::string& program,
                                      const std::vector<std::string>& arguments,
                                      std::string_view input) const {
  const std::string missing = fmt::format(
      "{}: there is no such program; install Slurm's (slurm-client), or use --engine local",
      program);
  return run_installed(program, arguments, missing, kLongestCall_s, context_, input);
}

Result<std::map<SlurmElement, SlurmState>> SlurmClient::states(
    const std::vector<std::string>& jobs) const {
  const auto text = call("squeue", {"--noheader", "--array", "--states=all",
                                    "--jobs=" + joined_with_commas(jobs), "--format=%i|%T|%r"});
  if (text) return parse_slurm_states(*text);
  // squeue's message when it no longer knows the only job asked for.
  if (text.error().message.find("Invalid job id") != std::string::npos)
    return std::map<SlurmElement, SlurmState>();
  return tl::unexpected<Error>(text.error());
}

std::map<SlurmElement, SlurmState> SlurmClient::accounted(
    const std::vector<std::string>& jobs) const {
  const auto text =
      call("sacct", {"--noheader", "--parsable2", "--jobs=" + joined_with_commas(jobs),
                     "--format=JobID,State,Reason"});
  return text ? parse_slurm_states(*text) : std::map<SlurmElement, SlurmState>();
}

Result<std::vector<std::string>> SlurmClient::live_jobs(const std::string& name) const {
  TURNSCAN_ASSIGN(const std::string text,
                  call("squeue", {"--noheader", "--me", "--name=" + name, "--format=%F"}));
  std::vector<std::string> jobs;
  for (const std::string_view word : text::words_of(text))
    if (std::find(jobs.begin(), jobs.end(), word) == jobs.end()) jobs.emplace_back(word);
  return jobs;
}

int SlurmClient::largest_array() const {
  const auto text = call("scontrol", {"show", "config"});
  const auto value = text ? config_value(*text, "MaxArraySize") : std::nullopt;
  const std::uint64_t most = value ? whole_number(*value) : 0;
  return most > 0 ? static_cast<int>(std::min<std::uint64_t>(most, 4000001)) : kDefaultArray;
}

std::uint64_t SlurmClient::node_megabytes() const {
  const auto text = call("sinfo", {"--noheader", "--format=%m"});
  std::uint64_t most = 0;
  if (!text) return 1;
  for (const std::string_view word : text::words_of(*text))
    most = std::max(most, whole_number(word));
  return most;
}

}  // namespace turnscan::engine
