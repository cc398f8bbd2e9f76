#pragma once
// Text that a terminal may be given, whatever the names in files say.

#include <string>
#include <string_view>

namespace turnscan {

/// Control characters (C0 but line ends and tabs, DEL, C1) as \uXXXX: a terminal would obey them.
/// In JSON texts these are the same characters.
std::string shown_text(std::string_view text);

/// The same on one line of at most `most` bytes; the middle of a longer one is left out.
std::string shown_line(std::string_view text, std::size_t most = 2000);

}  // namespace turnscan
