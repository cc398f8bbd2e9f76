#pragma once
// Text files made of lines and fields, as used by recordings and importers.

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
  std::string_view text;   ///< without its line end (LF or CR LF)
  std::size_t number = 0;  ///< counts from 1
  bool ended = true;       ///< false: the file ends here without a line end
};

/// Iterates over the lines of a text without copying them. A byte order mark is skipped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);
  /// The next line, or nullopt at the end.
  std::optional<TextLine> next();
  /// As next(), but skips lines that are empty or begin with '#'.
  std::optional<TextLine> next_content();

 private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

std::string_view trimmed(std::string_view text);
std::vector<std::string_view> words_of(std::string_view text);

/// Fields between delimiters, trimmed; "..." may contain them, "" inside is a quote. Fails with
/// kFormat if a quote is not closed.
Result<std::vector<std::string>> csv_fields(std::string_view line, char delimiter = ',');

/// A field as csv_fields() reads it back, quoted if necessary. Must not contain line ends.
std::string csv_field(std::string_view text);

/// Columns by name. Unknown names are allowed, duplicates are not.
class CsvColumns {
 public:
  static Result<CsvColumns> parse(std::string_view header_line);
  bool has(std::string_view name) const;
  /// The column's index, or size() if there is none.
  std::size_t position(std::string_view name) const;
  /// The field of that column; empty if there is no such column.
  std::string_view field(const std::vector<std::string>& fields, std::string_view name) const;
  std::size_t size() const { return names_.size(); }

 private:
  std::vector<std::string> names_;
};

/// Integer in [0, max].
Result<std::uint32_t> parse_index(std::string_view text, std::uint32_t max);

/// Finite numbers separated by white space or commas, exactly `count` of them. Fails with kFormat.
Result<std::vector<double>> parse_numbers(std::string_view text, std::size_t count);

/// Fails with kFormat unless name is a relative path that stays inside its folder.
Result<> check_inside(std::string_view name);

/// 4x4 matrix row by row, 16 numbers. Fails with kFormat as pose_from does.
Result<Pose> pose_from_rows(const std::vector<double>& numbers);

}  // namespace turnscan::text
