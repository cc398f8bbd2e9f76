#include <turnscan/workflow/engine/slurm_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace turnscan::engine {

namespace {

std::string_view next_part(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

bool is_digits(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::optional<SlurmElement> parse_element(std::string_view text) {
  const auto mark = text.find('_');
  if (mark == std::string_view::npos || !is_digits(text.substr(0, mark)) ||
      !is_digits(text.substr(mark + 1)))
    return std::nullopt;
  SlurmElement element{std::string(text.substr(0, mark)), 0};
  const std::string_view digits = text.substr(mark + 1);
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), element.index);
  if (read.ec != std::errc()) return std::nullopt;
  return element;
}

template <std::size_t kCount>
bool is_among(const std::string& state, const std::array<std::string_view, kCount>& names) {
  return std::find(names.begin(), names.end(), state) != names.end();
}

}  // namespace

std::map<SlurmElement, SlurmState> parse_slurm_states(std::string_view text) {
  std::map<SlurmElement, SlurmState> states;
  while (!text.empty()) {
    std::string_view line = next_part(text, '\n');
    const auto element = parse_element(next_part(line, '|'));
    if (!element) continue;
    std::string_view state = next_part(line, '|');
    // "CANCELLED by 1000"
    states[*element] = {std::string(state.substr(0, state.find(' '))),
                        std::string(next_part(line, '|'))};
  }
  return states;
}

bool is_live(const SlurmState& state) {
  constexpr std::array<std::string_view, 14> kLive{
      "PENDING",   "RUNNING",      "CONFIGURING", "COMPLETING",   "SUSPENDED",
      "REQUEUED",  "REQUEUE_HOLD", "REQUEUE_FED", "SPECIAL_EXIT", "STAGE_OUT",
      "SIGNALING", "RESIZING",     "STOPPED",     "RESV_DEL_HOLD"};
  return is_among(state.state, kLive);
}

bool is_lost(const SlurmState& state) {
  constexpr std::array<std::string_view, 4> kLost{"NODE_FAIL", "BOOT_FAIL", "PREEMPTED", "REVOKED"};
  return is_among(state.state, kLost);
}

std::string reason_of(const SlurmState& state) {
  if (state.state == "COMPLETED") return {};
  if (state.state == "OUT_OF_MEMORY")
    return "Slurm: out of memory; ask for more with --engine-options=--mem=...";
  if (state.state == "TIMEOUT")
    return "Slurm: out of time; ask for more with --engine-options=--time=...";
  if (state.state == kForgotten) return "Slurm no longer knows its job";
  const bool told = !state.reason.empty() && state.reason != "None";
  return fmt::format("Slurm: {}{}", state.state, told ? " (" + state.reason + ")" : "");
}

std::optional<std::string> parse_job_number(std::string_view text) {
  const std::string_view number = text.substr(0, text.find_first_of(";\n"));
  if (!is_digits(number)) return std::nullopt;
  return std::string(number);
}

std::optional<std::string> config_value(std::string_view text, std::string_view name) {
  while (!text.empty()) {
    std::string_view line = next_part(text, '\n');
    std::string_view key = next_part(line, '=');
    key = key.substr(0, key.find_last_not_of(' ') + 1);
    if (key != name) continue;
    const auto begin = std::min(line.find_first_not_of(' '), line.size());
    return std::string(line.substr(begin));
  }
  return std::nullopt;
}

std::optional<std::vector<std::string>> split_words(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  bool in_word = false;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      if (c == quote)
        quote = '\0';
      else
        word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
      in_word = true;
    } else if (c == ' ' || c == '\t') {
      if (in_word) words.push_back(std::exchange(word, {}));
      in_word = false;
    } else {
      word += c;
      in_word = true;
    }
  }
  if (quote != '\0') return std::nullopt;
  if (in_word) words.push_back(word);
  return words;
}

std::string quoted_word(const std::string& word) {
  std::string out = "'";
  for (const char c : word) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out + "'";
}

}  // namespace turnscan::engine
