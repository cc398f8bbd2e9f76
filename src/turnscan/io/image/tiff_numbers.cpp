#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <turnscan/io/image/file_numbers.hpp>
#include <turnscan/io/image/frame_size.hpp>

namespace turnscan::image {

namespace {

/// LZW, the densest of these codecs, packs at most 4,096 bytes into a code of 12 bits.
constexpr std::uint64_t kMostPacked = 4096 * 8 / 12;
constexpr std::array<std::uint16_t, 5> kCodecs{COMPRESSION_NONE, COMPRESSION_LZW,
                                               COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE,
                                               COMPRESSION_PACKBITS};

/// A file in memory, as libtiff reads it.
struct Memory {
  std::string_view bytes;
  std::size_t at = 0;
};

Memory& memory_of(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t size) {
  Memory& memory = memory_of(handle);
  const std::size_t left = memory.bytes.size() - std::min(memory.at, memory.bytes.size());
  const std::size_t count = std::min(left, std::size_t(std::max<tmsize_t>(size, 0)));
  if (count > 0) std::memcpy(to, memory.bytes.data() + memory.at, count);
  memory.at += count;
  return tmsize_t(count);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int whence) {
  Memory& memory = memory_of(handle);
  const std::uint64_t from = whence == SEEK_CUR   ? memory.at
                             : whence == SEEK_END ? memory.bytes.size()
                                                  : 0;
  memory.at = std::size_t(from + offset);
  return memory.at;
}

int close_nothing(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) { return memory_of(handle).bytes.size(); }
int say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open_tiff(Memory& memory) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
      TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), tmsize_t(kMaxDepthPixels * sizeof(double)));
  // m: not mapped into memory, O: the tables of strips are read when they are asked for.
  return {TIFFClientOpenExt("depth", "rmO", &memory, read_bytes, write_nothing, seek, close_nothing,
                            size_of, nullptr, nullptr, options.get()),
          &TIFFClose};
}

template <class T>
T field(TIFF* tiff, std::uint32_t tag, T otherwise) {
  T value = otherwise;
  return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

char kind_of(std::uint16_t format) {
  return format == SAMPLEFORMAT_IEEEFP ? 'f' : format == SAMPLEFORMAT_INT ? 'i' : 'u';
}

Result<NumberImage> header_of(TIFF* tiff, std::size_t file_bytes) {
  NumberImage out;
  out.columns = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  out.rows = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  out.kind = kind_of(field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT));
  const auto bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  const bool known =
      out.kind == 'f' ? bits == 32 || bits == 64 : bits == 8 || bits == 16 || bits == 32;
  if (!known || field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1) != 1 ||
      TIFFIsTiled(tiff) != 0)
    return fail(
        ErrorCode::kUnsupported,
        "this TIFF is not one of depth: it has colours, {} bits a value, or tiles; save one "
        "number a pixel, uint16 or float32, in strips",
        bits);
  out.value_bytes = bits / 8;
  const auto codec = field<std::uint16_t>(tiff, TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  if (std::find(kCodecs.begin(), kCodecs.end(), codec) == kCodecs.end())
    return fail(ErrorCode::kUnsupported,
                "this TIFF is packed by codec {}; save it with LZW, deflate or not packed", codec);
  TURNSCAN_TRY(check_pixels(out.columns, out.rows, kMaxDepthPixels));
  if (std::uint64_t(out.columns) * out.rows * out.value_bytes > kMostPacked * file_bytes)
    return fail(ErrorCode::kFormat, "damaged image: {} bytes cannot hold {} x {} values",
                file_bytes, out.columns, out.rows);
  return out;
}

}  // namespace

bool looks_like_tiff(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv) ||
         bytes.starts_with("II+\0"sv) || bytes.starts_with("MM\0+"sv);
}

Result<FileNumbers> decode_tiff_numbers(std::string_view bytes) {
  Memory memory{bytes};
  const Tiff tiff = open_tiff(memory);
  if (!tiff) return fail(ErrorCode::kFormat, "damaged TIFF image: its tables are cut off");
  FileNumbers out;
  TURNSCAN_ASSIGN(out.header, header_of(tiff.get(), bytes.size()));
  const std::size_t row_bytes = out.header.columns * out.header.value_bytes;
  if (TIFFScanlineSize64(tiff.get()) != row_bytes)
    return fail(ErrorCode::kUnsupported, "the rows of this TIFF are not plain numbers");
  out.values.resize(row_bytes * out.header.rows);
  for (std::uint32_t row = 0; row < out.header.rows; ++row)
    if (TIFFReadScanline(tiff.get(), out.values.data() + row * row_bytes, row) != 1)
      return fail(ErrorCode::kFormat, "damaged TIFF image: row {} of {} cannot be read", row,
                  out.header.rows);
  return out;
}

}  // namespace turnscan::image
