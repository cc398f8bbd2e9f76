#include <new>
#include <stdexcept>
#include <turnscan/io/image/image_io.hpp>

#include <turnscan/io/file/decode_file.hpp>
#include <turnscan/io/image/frame_size.hpp>
#include <turnscan/io/image/jpeg_codec.hpp>
#include <turnscan/io/image/png_codec.hpp>

namespace turnscan {

namespace {

using image::PngPixels;

template <class T>
void require_pixels(const Image<T>& image) {
  if (image.width < 1 || image.height < 1 ||
      image.pixels.size() != std::size_t(image.width) * std::size_t(image.height))
    throw std::invalid_argument("an image to write must have width x height pixels, at least one");
}

template <class T>
const unsigned char* bytes_of(const Image<T>& image) {
  return reinterpret_cast<const unsigned char*>(image.pixels.data());
}

template <class T>
Result<Image<T>> decode_png_as(std::string_view bytes, const image::PngInfo& info,
                               image::PngPixels kind) {
  Image<T> image(static_cast<int>(info.width), static_cast<int>(info.height));
  TURNSCAN_TRY(
      image::decode_png(bytes, info, kind, reinterpret_cast<unsigned char*>(image.pixels.data())));
  return image;
}

std::string_view kind_name(const image::PngInfo& info) {
  if (info.color_type == 0) return "grey";
  return info.color_type == 3 ? "palette" : info.channels() == 2 ? "grey and alpha" : "colour";
}

Result<> write_encoded(const std::filesystem::path& path, Result<std::string> encoded,
                       Durability durability) {
  if (!encoded) {
    encoded.error().path = path.string();
    return tl::unexpected<Error>(std::move(encoded).error());
  }
  return write_file_atomically(path, std::string_view(*encoded), durability);
}

Result<ColorImage> decode_color_of(std::string_view bytes, std::uint64_t most_pixels) {
  if (image::looks_like_jpeg(bytes)) return image::decode_jpeg(bytes, most_pixels);
  if (!image::looks_like_png(bytes))
    return fail(ErrorCode::kUnsupported, "neither a PNG nor a JPEG image");
  TURNSCAN_ASSIGN(const auto info, image::read_png_info(bytes));
  TURNSCAN_TRY(image::check_pixels(info.width, info.height, most_pixels));
  return decode_png_as<Rgb>(bytes, info, image::PngPixels::kRgb8);
}

}  // namespace

Result<DepthImage> decode_depth_png(std::string_view bytes) {
  TURNSCAN_ASSIGN(const auto info, image::read_png_info(bytes));
  if (info.color_type != 0 || info.bit_depth != 16)
    return fail(ErrorCode::kUnsupported,
                "a depth image must be a 16-bit grey PNG: this one is {}-bit {}; it may be a "
                "picture of depth rather than depth",
                info.bit_depth, kind_name(info));
  TURNSCAN_TRY(image::check_pixels(info.width, info.height, image::kMaxDepthPixels));
  return decode_png_as<std::uint16_t>(bytes, info, image::PngPixels::kDepth16);
}

Result<DepthImage> read_depth_png(const std::filesystem::path& path) {
  return file::decode_file(path, decode_depth_png);
}

Result<std::string> encode_depth_png(const DepthImage& image) {
  require_pixels(image);
  return image::encode_png(bytes_of(image), image.width, image.height, image::PngPixels::kDepth16);
}

Result<> write_depth_png(const std::filesystem::path& path, const DepthImage& image,
                         Durability durability) {
  return write_encoded(path, encode_depth_png(image), durability);
}

Result<> write_grey_png(const std::filesystem::path& path, const Image<std::uint8_t>& image,
                        Durability durability) {
  require_pixels(image);
  return write_encoded(
      path, image::encode_png(image.pixels.data(), image.width, image.height, PngPixels::kGrey8),
      durability);
}

Result<ColorImage> decode_color(std::string_view bytes) {
  return decode_color_of(bytes, kMaxImagePixels);
}

Result<ColorImage> read_color(const std::filesystem::path& path) {
  return file::decode_file(path, [](std::string_view bytes) {
    return decode_color_of(bytes, image::kMaxFrameColorPixels);
  });
}

Result<> decode_frame_color(std::string_view bytes, Frame& frame) {
  TURNSCAN_ASSIGN(frame.color, decode_color_of(bytes, image::kMaxFrameColorPixels));
  frame.color_jpeg = image::is_jpeg_file(bytes) ? std::string(bytes) : std::string();
  return {};
}

Result<> read_frame_color(const std::filesystem::path& path, Frame& frame) {
  return file::decode_file(
      path, [&frame](std::string_view bytes) { return decode_frame_color(bytes, frame); });
}

Result<std::string> encode_color_png(const ColorImage& image) {
  require_pixels(image);
  return image::encode_png(bytes_of(image), image.width, image.height, image::PngPixels::kRgb8);
}

Result<> write_color_png(const std::filesystem::path& path, const ColorImage& image,
                         Durability durability) {
  return write_encoded(path, encode_color_png(image), durability);
}

Result<std::string> encode_color_jpeg(const ColorImage& image, int quality) {
  require_pixels(image);
  if (quality < 1 || quality > 100)
    throw std::invalid_argument("the quality of a JPEG image must lie in [1, 100]");
  return image::encode_jpeg(image, quality);
}

Result<> write_color_jpeg(const std::filesystem::path& path, const ColorImage& image, int quality,
                          Durability durability) {
  return write_encoded(path, encode_color_jpeg(image, quality), durability);
}

}  // namespace turnscan
