#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <turnscan/workflow/text/text_table.hpp>
#include <turnscan/workflow/text/verdict_text.hpp>

namespace turnscan {

std::string verdict_text(const Verdict& verdict) {
  std::string colour(verdict.colour());
  std::transform(colour.begin(), colour.end(), colour.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  workflow::TextTable table({0, 1, 2});
  for (const VerdictSentence& s : verdict.sentences)
    table.add({s.topic, std::string(name_of(s.level)), s.text});
  return fmt::format("Verdict: {}\n{}", colour, table.text(2));
}

}  // namespace turnscan
