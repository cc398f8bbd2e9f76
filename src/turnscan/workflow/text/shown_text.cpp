#include <turnscan/workflow/text/shown_text.hpp>

#include <fmt/format.h>

namespace turnscan {

namespace {

/// C1 control characters are U+0080 to U+009F: the bytes c2 80 to c2 9f.
bool is_c1(std::string_view text, std::size_t i) {
  if (text[i] != '\xc2' || i + 1 == text.size()) return false;
  const auto next = static_cast<unsigned char>(text[i + 1]);
  return next >= 0x80 && next <= 0x9f;
}

bool is_c0(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

std::string escaped(std::string_view text, std::string_view allowed) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool c1 = is_c1(text, i);
    if (c1) ++i;
    if (c1 || (is_c0(text[i]) && allowed.find(text[i]) == std::string_view::npos))
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(text[i]));
    else
      out += text[i];
  }
  return out;
}

}  // namespace

std::string shown_text(std::string_view text) { return escaped(text, "\n\t"); }

std::string shown_line(std::string_view text, std::size_t most) {
  if (text.size() <= most) return escaped(text, "");
  return escaped(text.substr(0, most / 2), "") + " ... " +
         escaped(text.substr(text.size() - most / 2), "");
}

}  // namespace turnscan
