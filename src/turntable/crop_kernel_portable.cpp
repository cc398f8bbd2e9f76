#include <turnscan/turntable/crop_kernel.hpp>

namespace turnscan::crop_kernel {
namespace {

void select(const std::uint16_t* raw, const std::uint16_t* first, const std::uint16_t* count,
            std::size_t n, std::uint64_t* bits) {
  for (std::size_t i = 0; i < n; i += 64) {
    std::uint64_t word = 0;
    for (std::size_t j = 0; j < 64; ++j) {
      const auto above = static_cast<std::uint16_t>(raw[i + j] - first[i + j]);
      word |= std::uint64_t(above < count[i + j]) << j;
    }
    bits[i / 64] = word;
  }
}

}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel = {select};

}  // namespace turnscan::crop_kernel
