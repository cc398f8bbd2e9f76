#include <turnscan/io/image/png_codec.hpp>

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <turnscan/io/image/frame_size.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/image/png_color.hpp>
#include <turnscan/io/image/png_depth.hpp>
#include <vector>

namespace turnscan::image {

namespace {

// libpng reports errors by longjmp. Only plain data may live between setjmp and the jump: all C++
// objects belong to the caller of decode_rows.

struct Source {
  const unsigned char* data;
  std::size_t left;
  std::size_t allowed;  // number of further bytes that may be read
};

constexpr std::size_t kMaxBehindRows = 64 * 1024;

struct Failure {
  std::array<char, 128> text;
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::strncpy(failure->text.data(), message, failure->text.size() - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep target, std::size_t size) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (size > source->left) png_error(png, "the file ends too early");
  if (size > source->allowed) png_error(png, "there is more behind its rows");
  source->allowed -= size;
  std::memcpy(target, source->data, size);
  source->data += size;
  source->left -= size;
}

void ask_for(png_structp png, PngPixels kind) {
  if (kind == PngPixels::kDepth16) {
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
    return;
  }
  if (kind == PngPixels::kGrey8) return;
  png_set_palette_to_rgb(png);
  png_set_expand_gray_1_2_4_to_8(png);
  png_set_scale_16(png);
  png_set_strip_alpha(png);
  png_set_gray_to_rgb(png);
}

std::size_t bytes_per_pixel(PngPixels kind) {
  return kind == PngPixels::kDepth16 ? 2 : kind == PngPixels::kRgb8 ? 3 : 1;
}

bool decode_rows(Source* source, PngPixels kind, std::size_t row_bytes, png_bytepp rows,
                 Failure* failure) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, failure, on_error, on_warning);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  if (info == nullptr || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, source, read_bytes);
  // Texts and profiles are not needed, and their compressed content may be huge.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_user_limits(png, 65535, 65535);
  png_read_info(png, info);
  ask_for(png, kind);
  const int passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != row_bytes) png_error(png, "unexpected kind of pixels");
  const png_uint_32 height = png_get_image_height(png, info);
  for (int pass = 0; pass < passes; ++pass) {
    for (png_uint_32 y = 0; y < height; ++y) {
      // With the last row libpng unpacks all remaining data, which may expand a thousandfold.
      if (pass + 1 == passes && y + 1 == height) source->allowed = row_bytes + kMaxBehindRows;
      png_read_row(png, rows[y], nullptr);
    }
  }
  source->allowed = source->left;
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

/// Deflate compresses to no less than about a 1032nd (zlib, technical details).
bool can_hold(std::size_t file_bytes, const PngInfo& info) {
  const std::uint64_t bits = static_cast<std::uint64_t>(info.width) *
                             static_cast<std::uint64_t>(info.channels() * info.bit_depth);
  const std::uint64_t raw = (bits / 8) * info.height;
  return raw <= static_cast<std::uint64_t>(file_bytes) * 1100 + 4096;
}

}  // namespace

int PngInfo::channels() const {
  constexpr std::array<int, 7> kChannels{1, 0, 3, 1, 2, 0, 4};
  return color_type >= 0 && color_type < 7 ? kChannels[static_cast<std::size_t>(color_type)] : 0;
}

std::uint32_t big_endian_32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

bool looks_like_png(std::string_view bytes) { return bytes.starts_with(kPngSignature); }

Result<PngInfo> read_png_info(std::string_view bytes) {
  if (!looks_like_png(bytes)) return fail(ErrorCode::kUnsupported, "not a PNG image");
  if (bytes.size() < 33 || bytes.substr(12, 4) != "IHDR")
    return fail(ErrorCode::kFormat, "damaged PNG image: the header is missing");
  const PngInfo info{big_endian_32(bytes, 16), big_endian_32(bytes, 20), bytes[24], bytes[25]};
  if (info.channels() == 0 || info.width == 0 || info.height == 0)
    return fail(ErrorCode::kFormat, "damaged PNG image: the header is invalid");
  TURNSCAN_TRY(check_pixels(info.width, info.height, kMaxImagePixels));
  if (!can_hold(bytes.size(), info))
    return fail(ErrorCode::kFormat, "damaged PNG image: {} bytes cannot hold {} x {} pixels",
                bytes.size(), info.width, info.height);
  return info;
}

Result<> decode_png(std::string_view bytes, const PngInfo& info, PngPixels kind,
                    unsigned char* pixels) {
  if (kind == PngPixels::kDepth16 && decode_plain_depth(bytes, info, pixels)) return {};
  const bool rgb = info.color_type == 2 && info.bit_depth == 8;
  if (kind == PngPixels::kRgb8 && rgb && decode_rgb(bytes, info, pixels)) return {};
  const std::size_t row_bytes = info.width * bytes_per_pixel(kind);
  std::vector<png_bytep> rows(info.height);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = pixels + row * row_bytes;
  Source source{reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), bytes.size()};
  Failure failure{};
  if (!decode_rows(&source, kind, row_bytes, rows.data(), &failure))
    return fail(ErrorCode::kFormat, "damaged PNG image: {}", failure.text.data());
  return {};
}

Result<std::string> encode_png(const unsigned char* pixels, int width, int height, PngPixels kind) {
  const auto columns = static_cast<std::uint32_t>(width), rows = static_cast<std::uint32_t>(height);
  if (kind == PngPixels::kGrey8) return encode_plain_grey(pixels, columns, rows);
  return kind == PngPixels::kDepth16 ? encode_plain_depth(pixels, columns, rows)
                                     : encode_rgb(pixels, columns, rows);
}

}  // namespace turnscan::image
