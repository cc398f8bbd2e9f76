#pragma once
// Locale-independent parsing of numbers in text files.

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace turnscan::text {

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
inline bool is_space(char c) { return is_blank(c) || c == '\n' || c == '\v' || c == '\f'; }

/// Reads numbers sequentially. After an error the cursor is at the start of the invalid text.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text, std::size_t position = 0)
      : begin_(text.data()), at_(begin_ + position), end_(begin_ + text.size()) {}

  std::size_t position() const { return static_cast<std::size_t>(at_ - begin_); }
  bool at_end() const { return at_ == end_; }
  bool at_line_end() const { return at_ == end_ || *at_ == '\n'; }
  /// Counts from 1. Scans the text: for error messages.
  std::size_t line_number() const {
    std::size_t lines = 1;
    for (const char* c = begin_; c != at_; ++c) lines += *c == '\n' ? 1 : 0;
    return lines;
  }

  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }
  void skip_space() {
    while (at_ != end_ && is_space(*at_)) ++at_;
  }
  /// Advances past the end of the line.
  void skip_line() {
    while (at_ != end_ && *at_ != '\n') ++at_;
    if (at_ != end_) ++at_;
  }
  /// Advances past `c` if it is next.
  bool skip(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
  }
  /// The text up to the next space; may be empty.
  std::string_view word() {
    const char* first = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
  }
  /// The text up to the end of the line, without surrounding blanks.
  std::string_view rest_of_line() {
    skip_blanks();
    const char* first = at_;
    while (!at_line_end()) ++at_;
    const char* last = at_;
    while (last != first && is_blank(last[-1])) --last;
    return {first, static_cast<std::size_t>(last - first)};
  }

  /// A floating-point number after blanks; "nan" and "inf" are numbers, and values too small for T
  /// are 0. False if there is none on this line, or if it runs into other text.
  template <class T>
  bool floating(T& value) {
    skip_blanks();
    const char* first = behind_plus();
    const auto [last, error] = std::from_chars(first, end_, value);
    if (error == std::errc::result_out_of_range)
      value = beyond_range<T>({first, static_cast<std::size_t>(last - first)});
    else if (error != std::errc())
      return false;
    return accept(last);
  }

  /// An integer after blanks, also if written as "3.0"; otherwise as floating().
  bool integer(std::int64_t& value) {
    skip_blanks();
    const char* first = behind_plus();
    const auto [last, error] = std::from_chars(first, end_, value);
    if (error == std::errc() && accept(last)) return true;
    double number = 0.0;
    const char* start = at_;
    if (!floating(number) || std::abs(number) > 9e15 || number != std::floor(number)) {
      at_ = start;
      return false;
    }
    value = static_cast<std::int64_t>(number);
    return true;
  }

 private:
  /// std::from_chars accepts no plus sign; "+-1" stays invalid.
  const char* behind_plus() const {
    return end_ - at_ > 1 && *at_ == '+' && at_[1] != '-' ? at_ + 1 : at_;
  }

  bool accept(const char* last) {
    if (last != end_ && !is_space(*last)) return false;
    at_ = last;
    return true;
  }

  /// The value of a number outside the range of T: 0 or infinity.
  template <class T>
  static T beyond_range(std::string_view text) {
    const auto exponent = text.find_first_of("eE");
    const bool tiny = exponent != std::string_view::npos
                          ? text.substr(exponent + 1, 1) == "-"
                          : text.find_first_of("123456789") > text.find('.');
    return tiny ? T(0) : std::numeric_limits<T>::infinity();
  }

  const char* begin_;
  const char* at_;
  const char* end_;
};

}  // namespace turnscan::text
