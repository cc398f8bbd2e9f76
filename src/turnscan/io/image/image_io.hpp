#pragma once
// Depth images (16-bit grey PNG) and colour images (PNG, JPEG).
//
// All readers reject an image of more than kMaxImagePixels pixels (those of the images of frames of
// fewer: frame_size.hpp), or with more than 65535 rows or columns, or whose size its file's length
// cannot hold, before they allocate memory for it (kResourceLimit, kFormat). Damaged and truncated
// files fail with kFormat.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan {

inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t(1) << 26;

/// Raw values of a 16-bit grey PNG. Any other kind of PNG fails with kUnsupported: an 8-bit image
/// is a visualisation of depth, not depth.
Result<DepthImage> read_depth_png(const std::filesystem::path& path);
Result<DepthImage> decode_depth_png(std::string_view bytes);

/// The same image always gives the same bytes (for one version of zlib). Throws
/// std::invalid_argument if the image is empty or its pixels do not match its size.
Result<> write_depth_png(const std::filesystem::path& path, const DepthImage& image,
                         Durability durability = Durability::kSynced);
Result<std::string> encode_depth_png(const DepthImage& image);

/// PNG (grey, RGB, RGBA, palette; 1 to 16 bits per channel, alpha is dropped) or JPEG (grey, YCbCr,
/// RGB), detected by content. Anything else fails with kUnsupported.
/// The first reads images that belong to frames, the second textures, too.
Result<ColorImage> read_color(const std::filesystem::path& path);
Result<ColorImage> decode_color(std::string_view bytes);

/// The same, into a frame's color and color_jpeg; only color for a JPEG stream that is not a
/// complete file (a camera's, without its tables or its end). On failure the frame is unchanged.
Result<> read_frame_color(const std::filesystem::path& path, Frame& frame);
Result<> decode_frame_color(std::string_view bytes, Frame& frame);

/// 8-bit grey PNG. Throws std::invalid_argument as write_depth_png does.
Result<> write_grey_png(const std::filesystem::path& path, const Image<std::uint8_t>& image,
                        Durability durability = Durability::kSynced);

/// Throw std::invalid_argument as write_depth_png does; quality is in [1, 100].
Result<> write_color_png(const std::filesystem::path& path, const ColorImage& image,
                         Durability durability = Durability::kSynced);
Result<> write_color_jpeg(const std::filesystem::path& path, const ColorImage& image,
                          int quality = 92, Durability durability = Durability::kSynced);
Result<std::string> encode_color_png(const ColorImage& image);
Result<std::string> encode_color_jpeg(const ColorImage& image, int quality = 92);

}  // namespace turnscan
