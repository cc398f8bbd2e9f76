#pragma once
// Bytes and texts as a page may hold them.

#include <string>
#include <string_view>

namespace turnscan::page {

/// Text as content or in double quotes of an attribute: & < > " ' as entities, bytes that are no
/// UTF-8 and control characters as U+FFFD.
std::string escaped(std::string_view text);

/// JSON as the content of <script type="application/json">: every < becomes \u003c, which is the
/// same in a JSON string and stands nowhere else, so that no text can end the element.
std::string in_script(std::string json);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// "sha256-..." as a content security policy names an inline script or style (FIPS 180-4).
std::string csp_hash(std::string_view content);

}  // namespace turnscan::page
