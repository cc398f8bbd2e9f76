#include <turnscan/io/file/clean_name.hpp>

namespace turnscan::file {

namespace {

constexpr std::size_t kMaxBytes = 200;

/// Length of the UTF-8 sequence at the front, 0 if there is none (RFC 3629, section 4).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xc2 ? 0
                             : first < 0xe0 ? 2
                             : first < 0xf0 ? 3
                             : first < 0xf5 ? 4
                                            : 0;
  if (length == 0 || length > text.size()) return 0;
  unsigned code = length == 1 ? first : first & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool no_character =
      (code >= 0xd800 && code < 0xe000) || code > 0x10ffff || (code & 0xfffeU) == 0xfffeU;
  return overlong || no_character ? 0 : length;
}

}  // namespace

std::string clean_name(std::string_view name) {
  std::string clean;
  while (!name.empty() && clean.size() < kMaxBytes) {
    const std::size_t length = sequence_length(name);
    const bool control =
        length == 1 && (static_cast<unsigned char>(name[0]) < 32 || name[0] == 127);
    if (length == 0 || control)
      clean += length == 0 ? '?' : ' ';
    else
      clean += name.substr(0, length);
    name.remove_prefix(length == 0 ? 1 : length);
  }
  return clean;
}

}  // namespace turnscan::file
