#include <algorithm>
#include <turnscan/io/text/sheet_field.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

std::string sheet_field(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  const char first = text.empty() ? ' ' : text.front();
  // -5mm and +1e-3 stay what they are.
  constexpr std::string_view kOfNumbers = "0123456789abcdefghijklmnopqrstuvwxyzE.,;+-%_";
  const bool number = text.find_first_not_of(kOfNumbers) == std::string::npos;
  if (first == '=' || first == '@' || ((first == '+' || first == '-') && !number))
    text.insert(0, 1, '\'');
  return csv_field(text);
}

}  // namespace turnscan::text
