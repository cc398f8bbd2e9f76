#include <algorithm>
#include <charconv>
#include <optional>
#include <turnscan/io/text/json_bytes.hpp>

namespace turnscan::text {

namespace {

/// The closing quote of the string that begins at `open`, or the end of the text.
std::size_t end_of_string(std::string_view text, std::size_t open) {
  std::size_t i = open + 1;
  while (i < text.size() && text[i] != '"') i += text[i] == '\\' ? 2 : 1;
  return std::min(i, text.size());
}

/// Bytes that the parser's value (nlohmann, 16 bytes) takes in memory for this mark, with what the
/// allocator adds: a list is a vector on the heap, a member a node of a map beside its name.
std::uint64_t held_for(char mark) {
  constexpr std::uint64_t kElement = 16, kList = 48, kObject = 64, kMember = 48;
  if (mark == ',') return kElement;
  if (mark == '[') return kList;
  if (mark == '{') return kObject;
  return mark == ':' ? kMember : 0;
}

/// The same for a text or a name: an object on the heap, and another one if it is long.
std::uint64_t held_for_text(std::size_t length) {
  constexpr std::uint64_t kText = 48, kOverhead = 24;
  constexpr std::size_t kInPlace = 15;
  return kText + (length > kInPlace ? length + kOverhead : 0);
}

bool is_white(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Descends into a valid JSON text.
class JsonWalk {
 public:
  explicit JsonWalk(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    skip_white();
  }

  std::size_t at() const { return at_; }

  /// Steps from the beginning of a list or an object to that of one of its values; false, without a
  /// step, if it does not exist.
  bool enter_member(std::string_view key) {
    return enter('{', [&](std::size_t) {
      const std::size_t open = at_;
      at_ = end_of_string(text_, open) + 1;
      const bool wanted = text_.substr(open + 1, at_ - open - 2) == key;
      skip_white();
      ++at_;  // the colon
      skip_white();
      return wanted;
    });
  }
  bool enter_element(std::size_t index) {
    return enter('[', [&](std::size_t i) { return i == index; });
  }

 private:
  /// is_wanted(i): advances to the i-th value and returns whether it is the one.
  template <class IsWanted>
  bool enter(char open, const IsWanted& is_wanted) {
    const std::size_t begin = at_;
    std::optional<std::size_t> found;
    if (at_ < text_.size() && text_[at_] == open) {
      step_over_mark();
      for (std::size_t i = 0; at_ < text_.size() && text_[at_] != ']' && text_[at_] != '}'; ++i) {
        if (is_wanted(i)) found = at_;
        skip_value();
        skip_white();
        if (at_ < text_.size() && text_[at_] == ',') step_over_mark();
      }
    }
    at_ = found.value_or(begin);
    return found.has_value();
  }

  void skip_white() {
    while (at_ < text_.size() && is_white(text_[at_])) ++at_;
  }
  void step_over_mark() {
    ++at_;
    skip_white();
  }
  void skip_value() {
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (depth == 0 && (c == ',' || c == ']' || c == '}')) return;
      if (c == '"') at_ = end_of_string(text_, at_);
      if (c == '{' || c == '[') ++depth;
      if (c == '}' || c == ']') --depth;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Walks over the members of the outermost object.
class MemberScan {
 public:
  MemberScan(std::string_view text, std::string_view key) : text_(text), key_(key) { scan(); }

  struct Span {
    std::size_t begin = 0, end = 0;
  };
  std::optional<Span> value() const { return value_; }  ///< of the last member with the key
  std::size_t last_end() const { return last_end_; }    ///< after the last member, or the brace
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

  std::string_view text_, key_, name_;
  int depth_ = 0;
  std::optional<std::size_t> begin_;  ///< of the value of the current member
  std::optional<Span> value_;
  std::size_t last_end_ = 0;
  bool empty_ = true;
};

}  // namespace

Result<> check_json_shape(std::string_view text, const file::ReadBudget& budget) {
  int depth = 0;
  std::uint64_t held = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    held += held_for(c);
    if (c == '"') {
      const std::size_t end = end_of_string(text, i);
      held += held_for_text(end - i - 1);
      i = end;
    }
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > kMaxJsonDepth)
      return fail(ErrorCode::kFormat, "line {}: lists and objects are nested more than {} deep",
                  1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n'),
                  kMaxJsonDepth);
  }
  return budget.hold(held);
}

std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t begin = before.rfind('\n') + 1;  // 0 if there is none
  const auto is_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return fmt::format(
      "line {}, column {}", 1 + std::count(before.begin(), before.end(), '\n'),
      1 + std::count_if(before.begin() + std::ptrdiff_t(begin), before.end(), is_character));
}

std::size_t json_offset(std::string_view text, std::string_view path) {
  JsonWalk walk(text);
  bool there = true;
  while (there && !path.empty()) {
    const bool element = path.front() == '[';
    if (element || path.front() == '.') path.remove_prefix(1);
    const std::size_t end = std::min(path.find_first_of(element ? "]" : ".["), path.size());
    std::size_t index = 0;
    if (element) std::from_chars(path.data(), path.data() + end, index);
    there = element ? walk.enter_element(index) : walk.enter_member(path.substr(0, end));
    path.remove_prefix(std::min(path.size(), end + (element ? 1 : 0)));
  }
  return walk.at();
}

std::string with_json_member(std::string text, std::string_view key, std::string_view value) {
  const MemberScan scan(text, key);
  if (const auto span = scan.value())
    return text.replace(span->begin, span->end - span->begin, value);
  return text.insert(scan.last_end(),
                     fmt::format("{}\n  \"{}\": {}", scan.empty() ? "" : ",", key, value));
}

}  // namespace turnscan::text
