#pragma once
// libjpeg behind plain arrays.

#include <string>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

bool looks_like_jpeg(std::string_view bytes);
Result<ColorImage> decode_jpeg(std::string_view bytes);
Result<std::string> encode_jpeg(const ColorImage& image, int quality);

}  // namespace turnscan::image
