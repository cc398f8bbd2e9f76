#pragma once
// Text files made of lines and fields, as recordings and importers read them.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::text {

struct TextLine {
  std::string_view text;   ///< without its end (LF or CR LF)
  std::size_t number = 0;  ///< counts from 1
  bool ended = true;       ///< false: the file ends without a line end here
};

/// Walks over the lines of a text without keeping them. A byte order mark is skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);
  /// The next line, or nothing at the end.
  std::optional<TextLine> next();
  /// As next(), but leaves out lines that are empty or begin with '#'.
  std::optional<TextLine> next_content();

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

std::string_view trimmed(std::string_view text);
std::vector<std::string_view> words_of(std::string_view text);

/// Fields between commas, trimmed; "..." may hold commas, "" in it is a quote. Fails with kFormat
/// when a quote is not closed.
Result<std::vector<std::string>> csv_fields(std::string_view line);

/// One field as csv_fields() reads it back, quoted where it has to be. No line ends in it.
std::string csv_field(std::string_view text);

/// Columns by name. Unknown names are allowed; a name twice is not.
class CsvColumns {
 public:
  static Result<CsvColumns> parse(std::string_view header_line);
  bool has(std::string_view name) const;
  /// The column's number, or size() when there is none.
  std::size_t position(std::string_view name) const;
  /// The field of that column; empty when there is no such column.
  std::string_view field(const std::vector<std::string>& fields, std::string_view name) const;
  std::size_t size() const { return names_.size(); }

 private:
  std::vector<std::string> names_;
};

/// Whole number in [0, max].
Result<std::uint32_t> parse_index(std::string_view text, std::uint32_t max);

/// Finite numbers separated by white space or commas, exactly `count` of them. Fails with kFormat.
Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

/// Fails with kFormat unless name is a relative path that stays inside its folder.
Result<> check_inside(std::string_view name);

/// 4x4 row by row, 16 numbers. Fails with kFormat as pose_from does.
Result<Pose> pose_from_rows(const std::vector<double>& numbers);

}  // namespace turnscan::text
