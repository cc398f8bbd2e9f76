#pragma once
// 16-bit grey PNG images as depth recordings hold them, packed by libdeflate: two to five times as
// fast as libpng with zlib, read and written.

#include <span>
#include <string>
#include <string_view>
#include <turnscan/io/image/png_codec.hpp>

namespace turnscan::image {

/// Decodes an image without interlacing into info.width * info.height values (std::uint16_t in the
/// machine's byte order) at `pixels`. False where the image is interlaced or damaged: libpng then
/// has the word; what stands at `pixels` is undefined.
/// @param info of this image: 16 bit, grey.
bool decode_plain_depth(std::string_view bytes, const PngInfo& info, unsigned char* pixels);

/// The rows of an image without interlacing, each after the number of its filter, behind a row of
/// zeros. Empty where the image is interlaced, has a palette or transparency, or is damaged. Throws
/// std::bad_alloc. Holds until the next call on this thread.
std::span<unsigned char> unpack_plain(std::string_view bytes, const PngInfo& info,
                                      std::size_t bytes_per_pixel);

enum Filter { kNone, kSub, kUp, kAverage, kPaeth };

/// Undoes Paeth's filter of a row of `size` bytes, for one size of pixel.
using UndoPaeth = void (*)(unsigned char* row, const unsigned char* above, std::size_t size);

/// Adds what the filter predicts; `above` are the bytes of the row before, zeros for the first.
/// False where there is no such filter.
bool undo_filter(int filter, unsigned char* row, const unsigned char* above, std::size_t size,
                 std::size_t bytes_per_pixel, UndoPaeth undo_paeth);

/// @param pixels width * height values (std::uint16_t in the machine's byte order).
std::string encode_plain_depth(const unsigned char* pixels, std::uint32_t width,
                               std::uint32_t height);

/// A PNG file of rows that are filtered already, each after the number of its filter. A chunk holds
/// less than 2^31 bytes; the limits of image sizes see to it.
enum class PlainPng { kGrey16, kRgb8 };
std::string pack_png(std::span<const unsigned char> filtered, std::uint32_t width,
                     std::uint32_t height, PlainPng kind);

}  // namespace turnscan::image
