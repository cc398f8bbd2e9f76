#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <turnscan/evaluation/colormap.hpp>

namespace turnscan {

namespace {

constexpr std::array<std::array<int, 3>, 10> kViridis = {{{68, 1, 84},
                                                          {72, 40, 120},
                                                          {62, 74, 137},
                                                          {49, 104, 142},
                                                          {38, 130, 142},
                                                          {31, 158, 137},
                                                          {53, 183, 121},
                                                          {110, 206, 88},
                                                          {181, 222, 43},
                                                          {253, 231, 37}}};

}  // namespace

Rgb viridis(double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * double(kViridis.size() - 1);
  const auto low = std::min(std::size_t(place), kViridis.size() - 2);
  const double t = place - double(low);
  std::array<std::uint8_t, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) {
    c[i] = std::uint8_t(std::lround((1.0 - t) * kViridis[low][i] + t * kViridis[low + 1][i]));
  }
  return {c[0], c[1], c[2]};
}

}  // namespace turnscan
