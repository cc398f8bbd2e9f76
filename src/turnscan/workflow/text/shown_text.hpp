#pragma once
// Sanitises text for a terminal; file names may contain anything.

#include <string>
#include <string_view>

namespace turnscan {

/// Escapes control characters (C0 except line ends and tabs, DEL, C1) as \uXXXX, so that the
/// terminal does not interpret them. In JSON the escaped text is equivalent.
std::string shown_text(std::string_view text);

/// The same on a single line of at most `most` bytes; the middle of a longer line is elided.
std::string shown_line(std::string_view text, std::size_t most = 2000);

}  // namespace turnscan
