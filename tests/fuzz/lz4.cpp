// The input is an LZ4 frame, or blocks as Apple's library wraps them. What comes out is never more
// than was allowed.

#include <turnscan/io/lz4/lz4.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/fuzz_target.hpp"

TURNSCAN_FUZZ_TARGET(lz4) {
  using namespace turnscan;
  constexpr std::size_t kMax = 1 << 20;
  const auto bytes = lz4::decode(fuzz::text_of(data, size), kMax);
  fuzz::require(!bytes || bytes->size() <= kMax, "size");
  return 0;
}
