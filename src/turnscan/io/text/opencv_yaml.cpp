#include <algorithm>
#include <turnscan/core/units.hpp>
#include <turnscan/io/text/opencv_yaml.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

namespace {

/// Beginning of the line "name: ..."; npos: there is none.
std::size_t line_of(std::string_view text, std::string_view name) {
  const std::string key = fmt::format("{}:", name);
  for (auto at = text.find(key); at != text.npos; at = text.find(key, at + 1)) {
    if (at == 0 || text[at - 1] == '\n') return at;
  }
  return text.npos;
}

}  // namespace

Result<std::vector<double>> opencv_matrix(std::string_view text, std::string_view name,
                                          std::size_t least, std::size_t most) {
  const auto start = line_of(text, name);
  const auto open = start == text.npos ? text.npos : text.find('[', start);
  const auto close = open == text.npos ? text.npos : text.find(']', open);
  if (close == text.npos) return fail(ErrorCode::kFormat, "there is no matrix {}", name);
  std::string numbers(text.substr(open + 1, close - open - 1));
  for (char& c : numbers) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  const auto commas = std::size_t(std::count(numbers.begin(), numbers.end(), ','));
  const std::size_t count = trimmed(numbers).empty() ? 0 : commas + 1;
  if (count < least || count > most)
    return fail(ErrorCode::kFormat, "the matrix {} has {} numbers, not {}", name, count, least);
  // OpenCV writes integers with a trailing point.
  std::string clean;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    clean += numbers[i];
    const char next = i + 1 < numbers.size() ? numbers[i + 1] : ' ';
    if (numbers[i] == '.' && (next < '0' || next > '9')) clean += '0';
  }
  return parse_numbers(clean, count);
}

bool opencv_has(std::string_view text, std::string_view name) {
  return line_of(text, name) != text.npos;
}

Result<double> opencv_number(std::string_view text, std::string_view name) {
  const auto start = line_of(text, name);
  if (start == text.npos) return fail(ErrorCode::kFormat, "there is no line '{}: ...'", name);
  const std::string_view line = text.substr(start, text.find('\n', start) - start);
  return parse_number(trimmed(line.substr(name.size() + 1)));
}

}  // namespace turnscan::text
