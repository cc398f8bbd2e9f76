// The input is the URI of a source.

#include <cstdlib>
#include <string_view>
#include <turnscan/capture/source/source_uri.hpp>

#include "tests/fuzz/fuzz_target.hpp"

TURNSCAN_FUZZ_TARGET(source_uri) {
  using namespace turnscan;
  const auto uri = parse_source_uri({reinterpret_cast<const char*>(data), size});
  if (!uri) {
    if (uri.error().code != ErrorCode::kInvalidOption) std::abort();
    return 0;
  }
  // What is written is read back as the same, unless it has become too long.
  const std::string text = format_source_uri(*uri);
  const auto again = parse_source_uri(text);
  if (!again) {
    if (text.size() <= 4096) std::abort();
    return 0;
  }
  if (again->scheme != uri->scheme || again->address != uri->address ||
      again->parameters != uri->parameters)
    std::abort();
  return 0;
}
