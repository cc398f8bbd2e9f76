// The input is a stream of LZFSE. What comes out is never more than was allowed.

#include <turnscan/io/lzfse/lzfse.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/fuzz_target.hpp"

TURNSCAN_FUZZ_TARGET(lzfse) {
  using namespace turnscan;
  constexpr std::size_t kMax = 1 << 20;
  const auto bytes = lzfse::decode(fuzz::text_of(data, size), kMax);
  fuzz::require(!bytes || bytes->size() <= kMax, "size");
  return 0;
}
