#pragma once
// Encodes bytes and text for embedding in a page.

#include <string>
#include <string_view>

namespace turnscan::page {

/// Escapes text for element content or a double-quoted attribute: & < > " ' become entities,
/// invalid UTF-8 and control characters become U+FFFD.
std::string escaped(std::string_view text);

/// Escapes JSON as the content of <script type="application/json">: every < becomes \u003c, which
/// is equivalent inside a JSON string and occurs nowhere else, so that no text can close the
/// element.
std::string in_script(std::string json);

/// Encodes as defined by RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// "sha256-..." hash of an inline script or style for a content security policy (FIPS 180-4).
std::string csp_hash(std::string_view content);

}  // namespace turnscan::page
