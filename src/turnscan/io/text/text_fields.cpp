#include <algorithm>
#include <charconv>
#include <turnscan/core/units.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

namespace {

constexpr std::size_t kMaxFields = 1000;  // per line, which limits the memory for a line of commas
constexpr std::size_t kMaxFieldBytes = 4096;  // the longest that a field holds is a path
constexpr std::string_view kBlanks = " \t\r\n\f\v";

tl::unexpected<Error> too_long() {
  return fail(ErrorCode::kFormat, "a field has more than {} bytes", kMaxFieldBytes);
}

/// Removes one field from the front of rest, up to the delimiter after it.
Result<std::string> take_field(std::string_view& rest, char delimiter) {
  std::string field;
  const std::size_t begin =
      std::min(rest.find_first_not_of(delimiter == '\t' ? " " : " \t"), rest.size());
  if (begin < rest.size() && rest[begin] == '"') {
    std::size_t i = begin + 1;
    for (;; ++i) {
      if (i >= rest.size()) return fail(ErrorCode::kFormat, "a quote is not closed");
      if (field.size() > kMaxFieldBytes) return too_long();
      if (rest[i] != '"') {
        field += rest[i];
      } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
        field += rest[i++];
      } else {
        break;
      }
    }
    const std::size_t comma = std::min(rest.find(delimiter, i), rest.size());
    if (!trimmed(rest.substr(i + 1, comma - i - 1)).empty())
      return fail(ErrorCode::kFormat, "there is text after a closing quote");
    rest.remove_prefix(comma);
    return field;
  }
  const std::size_t comma = std::min(rest.find(delimiter), rest.size());
  const std::string_view text = trimmed(rest.substr(0, comma));
  if (text.size() > kMaxFieldBytes) return too_long();
  field = text;
  rest.remove_prefix(comma);
  return field;
}

}  // namespace

LineReader::LineReader(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

std::optional<TextLine> LineReader::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = rest_.find('\n');
  TextLine line{rest_.substr(0, end), ++number_, end != std::string_view::npos};
  rest_.remove_prefix(line.ended ? end + 1 : rest_.size());
  if (line.text.ends_with('\r')) line.text.remove_suffix(1);
  return line;
}

std::optional<TextLine> LineReader::next_content() {
  while (auto line = next()) {
    const std::string_view text = trimmed(line->text);
    if (!text.empty() && text.front() != '#') return line;
  }
  return std::nullopt;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return words;
}

Result<std::vector<std::string>> csv_fields(std::string_view line, char delimiter) {
  std::vector<std::string> fields;
  const auto delimiters = std::size_t(std::count(line.begin(), line.end(), delimiter));
  fields.reserve(std::min(delimiters + 1, kMaxFields));
  for (;;) {
    TURNSCAN_ASSIGN(std::string field, take_field(line, delimiter));
    fields.push_back(std::move(field));
    if (line.empty()) return fields;
    if (fields.size() == kMaxFields)
      return fail(ErrorCode::kFormat, "there are more than {} fields", kMaxFields);
    line.remove_prefix(1);
  }
}

std::string csv_field(std::string_view text) {
  const bool plain = text.find_first_of(",\"") == std::string_view::npos && trimmed(text) == text;
  if (plain) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out.append(c == '"' ? 2 : 1, c);
  return out + '"';
}

Result<CsvColumns> CsvColumns::parse(std::string_view header_line) {
  CsvColumns columns;
  TURNSCAN_ASSIGN(columns.names_, csv_fields(header_line));
  std::vector<std::string> sorted = columns.names_;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    return fail(ErrorCode::kFormat, "the header line names the column '{}' twice", *twice);
  return columns;
}

bool CsvColumns::has(std::string_view name) const { return position(name) < size(); }

std::size_t CsvColumns::position(std::string_view name) const {
  return static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
}

std::string_view CsvColumns::field(const std::vector<std::string>& fields,
                                   std::string_view name) const {
  const std::size_t i = position(name);
  return i < std::min(fields.size(), size()) ? std::string_view(fields[i]) : std::string_view();
}

Result<std::uint32_t> parse_index(std::string_view text, std::uint32_t max) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > max)
    return fail(ErrorCode::kFormat, "'{}' is not a whole number from 0 to {}", text, max);
  return value;
}

Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    if (numbers.size() == count)
      return fail(ErrorCode::kFormat, "there are more than {} numbers", count);
    const std::size_t end = std::min(text.find_first_of(" \t\r\n\f\v,"), text.size());
    const auto value = parse_number(text.substr(0, end));
    if (!value) return fail(ErrorCode::kFormat, "{}", value.error().message);
    numbers.push_back(*value);
    text = trimmed(text.substr(end));
    if (text.starts_with(',')) text.remove_prefix(1);
  }
  if (numbers.size() != count)
    return fail(ErrorCode::kFormat, "there are {} numbers, not {}", numbers.size(), count);
  return numbers;
}

Result<> check_inside(std::string_view name) {
  bool climbs = false;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    climbs = climbs || name.substr(begin, end - begin) == "..";
    begin = end + 1;
  }
  if (name.empty() || name.front() == '/' || climbs || name.find('\0') != std::string_view::npos)
    return fail(ErrorCode::kFormat, "'{}' does not name a file inside the folder", name);
  return {};
}

Result<Pose> pose_from_rows(const std::vector<double>& numbers) {
  if (numbers.size() != 16)
    return fail(ErrorCode::kFormat, "pose has {} numbers, not 16", numbers.size());
  return pose_from(Eigen::Matrix4d(
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(numbers.data())));
}

}  // namespace turnscan::text
