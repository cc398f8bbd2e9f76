#pragma once
// 16-bit grey PNG images as used in depth recordings, compressed by libdeflate: written and read
// two to five times as fast as by libpng with zlib.

#include <span>
#include <string>
#include <string_view>
#include <turnscan/io/image/png_codec.hpp>

namespace turnscan::image {

/// Decodes a non-interlaced image into info.width * info.height values (std::uint16_t in the
/// machine's byte order) at `pixels`. False if the image is interlaced or damaged and has to be
/// left to libpng; the contents of `pixels` are undefined then.
/// @param info of this image: 16 bit, grey.
bool decode_plain_depth(std::string_view bytes, const PngInfo& info, unsigned char* pixels);

/// The filtered rows of a non-interlaced image, each preceded by its filter type, after a row of
/// zeros. Empty if the image is interlaced, has a palette or transparency, or is damaged. Throws
/// std::bad_alloc. Valid until the next call on this thread.
std::span<unsigned char> unpack_plain(std::string_view bytes, const PngInfo& info,
                                      std::size_t bytes_per_pixel);

enum Filter { kNone, kSub, kUp, kAverage, kPaeth };

/// Undoes the Paeth filter of a row of `size` bytes, for one pixel size.
using UndoPaeth = void (*)(unsigned char* row, const unsigned char* above, std::size_t size);

/// Adds the filter's prediction; `above` is the previous row, zeros for the first. False if the
/// filter type is invalid.
bool undo_filter(int filter, unsigned char* row, const unsigned char* above, std::size_t size,
                 std::size_t bytes_per_pixel, UndoPaeth undo_paeth);

/// @param pixels width * height values (std::uint16_t in the machine's byte order).
std::string encode_plain_depth(const unsigned char* pixels, std::uint32_t width,
                               std::uint32_t height);

/// @param pixels width * height bytes.
std::string encode_plain_grey(const unsigned char* pixels, std::uint32_t width,
                              std::uint32_t height);

/// A PNG file from already filtered rows, each preceded by its filter type. A chunk must be shorter
/// than 2^31 bytes, which the limits on image size ensure.
enum class PlainPng { kGrey16, kRgb8, kGrey8 };
std::string pack_png(std::span<const unsigned char> filtered, std::uint32_t width,
                     std::uint32_t height, PlainPng kind);

}  // namespace turnscan::image
