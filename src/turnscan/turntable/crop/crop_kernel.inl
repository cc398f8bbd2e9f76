// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/turntable/crop/crop_kernel.hpp>

namespace turnscan::crop_kernel {
namespace {

#if TURNSCAN_NATIVE_LANES == 16

/// One bit a pixel of 32 pixels.
inline std::uint64_t inside_of_32(const std::uint16_t* raw, const std::uint16_t* first,
                                  const std::uint16_t* count) {
  const __m512i above = _mm512_sub_epi16(_mm512_loadu_si512(raw), _mm512_loadu_si512(first));
  return _mm512_cmplt_epu16_mask(above, _mm512_loadu_si512(count));
}

inline std::uint64_t inside_of_64(const std::uint16_t* raw, const std::uint16_t* first,
                                  const std::uint16_t* count) {
  return inside_of_32(raw, first, count) | inside_of_32(raw + 32, first + 32, count + 32) << 32;
}

#elif TURNSCAN_NATIVE_LANES == 8

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
inline std::uint32_t outside_of_32(const std::uint16_t* raw, const std::uint16_t* first,
                                   const std::uint16_t* count) {
  // Packing works on halves of 128 bits, which the permutation puts in order again.
  const __m256i packed =
      _mm256_packs_epi16(outside(raw, first, count), outside(raw + 16, first + 16, count + 16));
  return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_permute4x64_epi64(packed, 0xD8)));
}

inline std::uint64_t inside_of_64(const std::uint16_t* raw, const std::uint16_t* first,
                                  const std::uint16_t* count) {
  const std::uint64_t low = outside_of_32(raw, first, count);
  const std::uint64_t high = outside_of_32(raw + 32, first + 32, count + 32);
  return ~(low | high << 32);
}

#else

inline std::uint64_t inside_of_64(const std::uint16_t* raw, const std::uint16_t* first,
                                  const std::uint16_t* count) {
  std::uint64_t word = 0;
  for (std::size_t j = 0; j < 64; ++j) {
    const auto above = static_cast<std::uint16_t>(raw[j] - first[j]);
    word |= std::uint64_t(above < count[j]) << j;
  }
  return word;
}

#endif

void select(const std::uint16_t* raw, const std::uint16_t* first, const std::uint16_t* count,
            std::size_t n, std::uint64_t* bits) {
  for (std::size_t i = 0; i < n; i += 64)
    bits[i / 64] = inside_of_64(raw + i, first + i, count + i);
}

constexpr CropKernel kKernel{select};

}  // namespace
}  // namespace turnscan::crop_kernel

template <>
const turnscan::crop_kernel::CropKernel&
turnscan::built_kernel<turnscan::crop_kernel::CropKernel, TURNSCAN_INSTRUCTION_SET>() {
  return crop_kernel::kKernel;
}
