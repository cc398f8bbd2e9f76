#include <algorithm>
#include <optional>
#include <turnscan/io/text/json_bytes.hpp>

namespace turnscan::text {

namespace {

/// The closing quote of the string that begins at `open`, or the text's end.
std::size_t end_of_string(std::string_view text, std::size_t open) {
  std::size_t i = open + 1;
  while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
  return std::min(i, text.size());
}

/// Walks over the members of the outermost object.
class MemberScan {
 public:
  MemberScan(std::string_view text, std::string_view key) : text_(text), key_(key) { scan(); }

  struct Span {
    std::size_t begin = 0, end = 0;
  };
  std::optional<Span> value() const { return value_; }  ///< of the last member with the key
  std::size_t last_end() const { return last_end_; }    ///< behind the last member, or the brace
  bool empty() const { return empty_; }

 private:
  void scan() {
    for (std::size_t i = 0; i < text_.size(); ++i) {
      const char c = text_[i];
      if (c == '"') {
        const std::size_t end = end_of_string(text_, i);
        if (depth_ == 1 && !begin_) name_ = text_.substr(i + 1, end - i - 1);
        i = end;
      } else if (c == '{' || c == '[') {
        if (++depth_ == 1) last_end_ = i + 1;
      } else if (c == ':' && depth_ == 1) {
        begin_ = i + 1;
      } else if (c == ',' && depth_ == 1) {
        close_member(i);
      } else if (c == '}' || c == ']') {
        if (depth_-- == 1) close_member(i);
      }
    }
  }

  void close_member(std::size_t end) {
    if (!begin_) return;
    std::size_t begin = *begin_;
    while (begin < end && is_white(text_[begin])) ++begin;
    while (end > begin && is_white(text_[end - 1])) --end;
    if (name_ == key_) value_ = Span{begin, end};
    last_end_ = end;
    empty_ = false;
    begin_.reset();
  }

  static bool is_white(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  std::string_view text_, key_, name_;
  int depth_ = 0;
  std::optional<std::size_t> begin_;  ///< of the value of the member that is being walked over
  std::optional<Span> value_;
  std::size_t last_end_ = 0;
  bool empty_ = true;
};

}  // namespace

Result<> check_json_depth(std::string_view text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') i = end_of_string(text, i);
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > kMaxJsonDepth)
      return fail(ErrorCode::kFormat, "line {}: lists and objects are nested more than {} deep",
                  1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n'),
                  kMaxJsonDepth);
  }
  return {};
}

std::string with_json_member(std::string text, std::string_view key, std::string_view value) {
  const MemberScan scan(text, key);
  if (const auto span = scan.value())
    return text.replace(span->begin, span->end - span->begin, value);
  return text.insert(scan.last_end(),
                     fmt::format("{}\n  \"{}\": {}", scan.empty() ? "" : ",", key, value));
}

}  // namespace turnscan::text
