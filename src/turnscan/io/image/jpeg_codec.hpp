#pragma once
// Wrapper of libjpeg for plain arrays.

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan::image {

bool looks_like_jpeg(std::string_view bytes);
/// Whether a JPEG image contains its Huffman tables and its end marker, which camera streams may
/// omit (ITU-T T.81, B.2); every program can read it if it does.
bool is_jpeg_file(std::string_view bytes);
/// Fails with kResourceLimit if it has more pixels than `most`, and with kFormat.
Result<ColorImage> decode_jpeg(std::string_view bytes, std::uint64_t most);
Result<std::string> encode_jpeg(const ColorImage& image, int quality);

}  // namespace turnscan::image
