#pragma once

#include <turnscan/core/image.hpp>
#include <vector>

namespace turnscan::studio {

/// The image at half size, a quarter, and so on, down to one pixel. Each pixel is the mean of those
/// that it covers.
std::vector<ColorImage> halves_of(const ColorImage& picture);

}  // namespace turnscan::studio
