#include <turnscan/io/image/jpeg_codec.hpp>

#include <csetjmp>
#include <cstdio>
#include <cstdlib>
// jpeglib.h requires the two includes above.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <turnscan/io/image/frame_size.hpp>

namespace turnscan::image {

namespace {

// libjpeg reports errors by longjmp out of a callback. Only plain data may live between setjmp and
// the jump: the functions below use nothing else.

struct Errors {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  std::array<char, JMSG_LENGTH_MAX> text;
};

Errors& errors_of(j_common_ptr codec) { return *reinterpret_cast<Errors*>(codec->err); }

void on_error(j_common_ptr codec) {
  Errors& errors = errors_of(codec);
  errors.manager.format_message(codec, errors.text.data());
  std::longjmp(errors.back, 1);
}

/// A truncated file is only a warning for libjpeg, which then fills the rest with grey.
bool harmless(int code) {
  return code == JWRN_EXTRANEOUS_DATA || code == JWRN_ADOBE_XFORM || code == JWRN_JFIF_MAJOR;
}

void on_message(j_common_ptr codec, int level) {
  if (level < 0 && !harmless(codec->err->msg_code)) on_error(codec);
}

void install(Errors& errors) {
  (void)jpeg_std_error(&errors.manager);
  errors.manager.error_exit = on_error;
  errors.manager.emit_message = on_message;
  errors.text[0] = '\0';
}

constexpr int kMaxScans = 200;

/// Each scan of a progressive file costs a pass over the whole image, however short it is.
void on_progress(j_common_ptr codec) {
  if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number > kMaxScans)
    ERREXIT(codec, JERR_BAD_PROGRESSION);
}

struct Decoder {
  jpeg_decompress_struct codec;
  jpeg_progress_mgr progress;
  Errors errors;
};

bool open(Decoder* decoder, const unsigned char* data, unsigned long size) {
  install(decoder->errors);
  decoder->codec.err = &decoder->errors.manager;
  if (setjmp(decoder->errors.back)) return false;
  jpeg_create_decompress(&decoder->codec);
  decoder->progress.progress_monitor = on_progress;
  decoder->codec.progress = &decoder->progress;
  decoder->codec.mem->max_memory_to_use = 1L << 30;
  jpeg_mem_src(&decoder->codec, data, size);
  return jpeg_read_header(&decoder->codec, TRUE) == JPEG_HEADER_OK;
}

bool read_rgb(Decoder* decoder, unsigned char* pixels) {
  if (setjmp(decoder->errors.back)) return false;
  jpeg_decompress_struct& codec = decoder->codec;
  codec.out_color_space = JCS_RGB;
  codec.dct_method = JDCT_ISLOW;  // the same pixels on every machine
  (void)jpeg_start_decompress(&codec);
  if (codec.output_components != 3) ERREXIT(&codec, JERR_CONVERSION_NOTIMPL);
  const std::size_t row_bytes = static_cast<std::size_t>(codec.output_width) * 3;
  while (codec.output_scanline < codec.output_height) {
    JSAMPROW row = pixels + codec.output_scanline * row_bytes;
    (void)jpeg_read_scanlines(&codec, &row, 1);
  }
  (void)jpeg_finish_decompress(&codec);
  return true;
}

struct Encoder {
  jpeg_compress_struct codec;
  Errors errors;
  unsigned char* bytes;
  unsigned long size;
};

bool write_rgb(Encoder* encoder, const unsigned char* pixels, int width, int height, int quality) {
  install(encoder->errors);
  encoder->codec.err = &encoder->errors.manager;
  if (setjmp(encoder->errors.back)) return false;
  jpeg_compress_struct& codec = encoder->codec;
  jpeg_create_compress(&codec);
  jpeg_mem_dest(&codec, &encoder->bytes, &encoder->size);
  codec.image_width = static_cast<JDIMENSION>(width);
  codec.image_height = static_cast<JDIMENSION>(height);
  codec.input_components = 3;
  codec.in_color_space = JCS_RGB;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, quality, TRUE);
  codec.dct_method = JDCT_ISLOW;
  jpeg_start_compress(&codec, TRUE);
  const std::size_t row_bytes = static_cast<std::size_t>(width) * 3;
  while (codec.next_scanline < codec.image_height) {
    // libjpeg does not write to the rows that it is given.
    JSAMPROW row = const_cast<JSAMPROW>(pixels + codec.next_scanline * row_bytes);
    (void)jpeg_write_scanlines(&codec, &row, 1);
  }
  jpeg_finish_compress(&codec);
  return true;
}

Result<> check_header(const jpeg_decompress_struct& codec, std::size_t file_bytes,
                      std::uint64_t most) {
  const std::uint64_t pixels = std::uint64_t(codec.image_width) * codec.image_height;
  TURNSCAN_TRY(check_pixels(codec.image_width, codec.image_height, most));
  if (codec.jpeg_color_space == JCS_CMYK || codec.jpeg_color_space == JCS_YCCK)
    return fail(ErrorCode::kUnsupported, "a CMYK JPEG image; save it as RGB");
  // A block of 8 x 8 pixels takes at least one bit.
  if (pixels > std::uint64_t(file_bytes) * 1024)
    return fail(ErrorCode::kFormat, "damaged JPEG image: {} bytes cannot hold {} x {} pixels",
                file_bytes, codec.image_width, codec.image_height);
  return {};
}

Result<ColorImage> decode(Decoder& decoder, std::string_view bytes, std::uint64_t most) {
  const auto damaged = [&decoder] {
    return fail(ErrorCode::kFormat, "damaged JPEG image: {}", decoder.errors.text.data());
  };
  if (!open(&decoder, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()))
    return damaged();
  TURNSCAN_TRY(check_header(decoder.codec, bytes.size(), most));
  ColorImage image(static_cast<int>(decoder.codec.image_width),
                   static_cast<int>(decoder.codec.image_height));
  static_assert(sizeof(Rgb) == 3);
  if (!read_rgb(&decoder, reinterpret_cast<unsigned char*>(image.pixels.data()))) return damaged();
  return image;
}

}  // namespace

bool looks_like_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

bool is_jpeg_file(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (!looks_like_jpeg(bytes) || !bytes.ends_with("\xff\xd9"sv)) return false;
  // Walks over the segments before the first scan, each with its length.
  bool tables = false;
  for (std::size_t at = 2; at + 4 <= bytes.size() && bytes[at] == '\xff';) {
    const auto byte = [&](std::size_t i) { return std::size_t(std::uint8_t(bytes[at + i])); };
    if (byte(1) == 0xda) return tables;
    tables = tables || byte(1) == 0xc4;
    at += 2 + (byte(2) << 8 | byte(3));
  }
  return false;
}

Result<ColorImage> decode_jpeg(std::string_view bytes, std::uint64_t most) {
  Decoder decoder{};
  auto image = decode(decoder, bytes, most);
  jpeg_destroy_decompress(&decoder.codec);
  return image;
}

Result<std::string> encode_jpeg(const ColorImage& image, int quality) {
  Encoder encoder{};
  const bool ok = write_rgb(&encoder, reinterpret_cast<const unsigned char*>(image.pixels.data()),
                            image.width, image.height, quality);
  std::string bytes;
  if (ok) bytes.assign(reinterpret_cast<const char*>(encoder.bytes), encoder.size);
  jpeg_destroy_compress(&encoder.codec);
  std::free(encoder.bytes);
  if (!ok)
    return fail(ErrorCode::kLibrary, "cannot encode the image as JPEG: {}",
                encoder.errors.text.data());
  return bytes;
}

}  // namespace turnscan::image
