#include <immintrin.h>

#include <turnscan/turntable/crop_kernel.hpp>

namespace turnscan::crop_kernel {
namespace {

inline __m256i load(const std::uint16_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

/// 0xffff where the pixel is not kept: the saturated difference count - (raw - first) is 0.
inline __m256i outside(const std::uint16_t* raw, const std::uint16_t* first,
                       const std::uint16_t* count) {
  const __m256i above = _mm256_sub_epi16(load(raw), load(first));
  return _mm256_cmpeq_epi16(_mm256_subs_epu16(load(count), above), _mm256_setzero_si256());
}

/// One bit a pixel of 32 pixels.
inline std::uint32_t outside_bits(const std::uint16_t* raw, const std::uint16_t* first,
                                  const std::uint16_t* count) {
  // Packing works on halves of 128 bits, which the permutation puts in order again.
  const __m256i packed =
      _mm256_packs_epi16(outside(raw, first, count), outside(raw + 16, first + 16, count + 16));
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permute4x64_epi64(packed, 0xD8)));
}

void select(const std::uint16_t* raw, const std::uint16_t* first, const std::uint16_t* count,
            std::size_t n, std::uint64_t* bits) {
  for (std::size_t i = 0; i < n; i += 64) {
    const std::uint64_t low = outside_bits(raw + i, first + i, count + i);
    const std::uint64_t high = outside_bits(raw + i + 32, first + i + 32, count + i + 32);
    bits[i / 64] = ~(low | high << 32);
  }
}

}  // namespace

extern const Kernel kAvx2Kernel;
const Kernel kAvx2Kernel = {select};

}  // namespace turnscan::crop_kernel
