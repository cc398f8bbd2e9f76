#include <immintrin.h>

#include <turnscan/turntable/crop_kernel.hpp>

namespace turnscan::crop_kernel {
namespace {

inline std::uint64_t inside_bits(const std::uint16_t* raw, const std::uint16_t* first,
                                 const std::uint16_t* count) {
  const __m512i above = _mm512_sub_epi16(_mm512_loadu_si512(raw), _mm512_loadu_si512(first));
  return _mm512_cmplt_epu16_mask(above, _mm512_loadu_si512(count));
}

void select(const std::uint16_t* raw, const std::uint16_t* first, const std::uint16_t* count,
            std::size_t n, std::uint64_t* bits) {
  for (std::size_t i = 0; i < n; i += 64)
    bits[i / 64] = inside_bits(raw + i, first + i, count + i) |
                   inside_bits(raw + i + 32, first + i + 32, count + i + 32) << 32;
}

}  // namespace

extern const Kernel kAvx512Kernel;
const Kernel kAvx512Kernel = {select};

}  // namespace turnscan::crop_kernel
