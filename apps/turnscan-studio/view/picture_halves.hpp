#pragma once

#include <turnscan/core/image.hpp>
#include <vector>

namespace turnscan::studio {

/// Halves of a picture, their halves, and so on, down to one pixel. Each pixel is the mean of those
/// that it stands for.
std::vector<ColorImage> halves_of(const ColorImage& picture);

}  // namespace turnscan::studio
