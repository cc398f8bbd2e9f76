#include "view/picture_halves.hpp"

#include <algorithm>
#include <turnscan/core/parallel.hpp>

namespace turnscan::studio {

namespace {

ColorImage half_of(const ColorImage& picture) {
  ColorImage out(std::max(1, picture.width / 2), std::max(1, picture.height / 2), Rgb{});
  parallel_for(std::size_t(out.height), 64, [&](std::size_t row) {
    const int y = int(row), below = std::min(2 * y + 1, picture.height - 1);
    for (int x = 0; x < out.width; ++x) {
      const int beside = std::min(2 * x + 1, picture.width - 1);
      const Rgb &a = picture.at(2 * x, 2 * y), &b = picture.at(beside, 2 * y),
                &c = picture.at(2 * x, below), &d = picture.at(beside, below);
      const auto mean = [](int sum) { return static_cast<std::uint8_t>((sum + 2) / 4); };
      out.at(x, y) = {mean(a.r + b.r + c.r + d.r), mean(a.g + b.g + c.g + d.g),
                      mean(a.b + b.b + c.b + d.b)};
    }
  });
  return out;
}

}  // namespace

std::vector<ColorImage> halves_of(const ColorImage& picture) {
  std::vector<ColorImage> out;
  for (const ColorImage* last = &picture; last->width > 1 || last->height > 1; last = &out.back())
    out.push_back(half_of(*last));
  return out;
}

}  // namespace turnscan::studio
