#include <turnscan/io/image/depth_file.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <turnscan/io/file/decode_file.hpp>
#include <turnscan/io/image/file_numbers.hpp>
#include <turnscan/io/image/frame_size.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/image/png_codec.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan {

namespace {

using image::NumberImage;

constexpr std::string_view kNpyMagic("\x93NUMPY", 6);

Result<> check_depth_size(std::uint64_t width, std::uint64_t height, std::uint64_t value_bytes,
                          std::uint64_t bytes) {
  TURNSCAN_TRY(image::check_pixels(width, height, image::kMaxDepthPixels));
  if (width * height * value_bytes > bytes)
    return fail(ErrorCode::kFormat, "damaged image: {} bytes cannot hold {} x {} values", bytes,
                width, height);
  return {};
}

/// What follows "'name':" in an NPY header, up to `end`.
std::string_view npy_field(std::string_view header, std::string_view name, std::string_view end) {
  const std::string key = fmt::format("'{}':", name);
  const std::size_t at = header.find(key);
  if (at == header.npos) return {};
  header.remove_prefix(at + key.size());
  return text::trimmed(header.substr(0, header.find_first_of(end)));
}

Result<NumberImage> parse_npy_header(std::string_view header) {
  NumberImage out;
  const std::string_view type = npy_field(header, "descr", ",");  // '<u2'
  const std::string_view order = npy_field(header, "fortran_order", ",");
  std::string shape(npy_field(header, "shape", ")"));  // (480, 640
  if (type.size() != 5 || shape.empty() || order.empty())
    return fail(ErrorCode::kUnsupported,
                "this array is not one of plain numbers with rows and columns");
  out.kind = type[2];
  out.value_bytes = std::size_t(type[3] - '0');
  out.swapped = type[1] == '>';
  const bool known = out.kind == 'f'
                         ? out.value_bytes == 4 || out.value_bytes == 8
                         : (out.kind == 'u' || out.kind == 'i') &&
                               std::has_single_bit(out.value_bytes) && out.value_bytes <= 4;
  if (!known || order != "False")
    return fail(ErrorCode::kUnsupported,
                "an array of {}{} is not read as depth; save one of uint16 or float32, row by row",
                type, order == "False" ? "" : " in Fortran's order");
  std::vector<std::uint32_t> axes;
  TURNSCAN_ASSIGN(const auto fields, text::csv_fields(std::string_view(shape).substr(1)));
  for (const std::string& field : fields) {
    if (field.empty()) continue;  // behind the last comma
    TURNSCAN_ASSIGN(const std::uint32_t axis, text::parse_index(field, 1U << 30));
    if (axis != 1) axes.push_back(axis);
  }
  if (axes.size() != 2)
    return fail(ErrorCode::kUnsupported,
                "an array of the shape {}) is not one image; save each in a file of its own",
                shape);
  out.rows = axes[0];
  out.columns = axes[1];
  return out;
}

template <class T>
double value_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swapped) std::reverse(raw.begin(), raw.end());
  T value;
  std::memcpy(&value, raw.data(), sizeof(T));
  return double(value);
}

using ReadValue = double (*)(const char*, bool);

ReadValue reader_of(const NumberImage& header) {
  if (header.kind == 'f') return header.value_bytes == 4 ? value_at<float> : value_at<double>;
  const bool is_signed = header.kind == 'i';
  switch (header.value_bytes) {
    case 1:
      return is_signed ? value_at<std::int8_t> : value_at<std::uint8_t>;
    case 2:
      return is_signed ? value_at<std::int16_t> : value_at<std::uint16_t>;
    default:
      return is_signed ? value_at<std::int32_t> : value_at<std::uint32_t>;
  }
}

DepthFile depth_of(const NumberImage& header, std::string_view body, double float_unit_m) {
  static_assert(std::endian::native == std::endian::little);
  DepthFile file;
  file.floats = header.kind == 'f';
  file.eight_bits = header.value_bytes == 1;
  const double scale = file.floats ? float_unit_m / kFloatDepthStep_m : 1.0;
  DepthImage& out = file.image = DepthImage(int(header.columns), int(header.rows), kNoReturn);
  const ReadValue read = reader_of(header);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const double steps =
        std::round(scale * read(body.data() + i * header.value_bytes, header.swapped));
    if (steps > kNoReturn && steps < kOutsideCrop) out.pixels[i] = std::uint16_t(steps);
  }
  return file;
}

Result<DepthFile> decode_npy(std::string_view bytes, double float_unit_m) {
  if (bytes.size() < 12)
    return fail(ErrorCode::kFormat, "damaged NPY array: the header is cut off");
  const bool long_header = bytes[6] > 1;
  const std::size_t begin = long_header ? 12 : 10;
  const double length = long_header ? value_at<std::uint32_t>(bytes.data() + 8, false)
                                    : value_at<std::uint16_t>(bytes.data() + 8, false);
  if (length > double(bytes.size() - begin))
    return fail(ErrorCode::kFormat, "damaged NPY array: the header is cut off");
  TURNSCAN_ASSIGN(const NumberImage header,
                  parse_npy_header(bytes.substr(begin, std::size_t(length))));
  const std::string_view body = bytes.substr(begin + std::size_t(length));
  TURNSCAN_TRY(check_depth_size(header.columns, header.rows, header.value_bytes, body.size()));
  return depth_of(header, body, float_unit_m);
}

/// The next number of a PGM header; comments begin with #.
Result<std::uint32_t> pgm_number(std::string_view bytes, std::size_t& at) {
  constexpr std::string_view kSpace = " \t\r\n";
  for (at = bytes.find_first_not_of(kSpace, at); at != bytes.npos && bytes[at] == '#';
       at = bytes.find_first_not_of(kSpace, at))
    at = bytes.find('\n', at);
  std::uint32_t value = 0;
  if (at != bytes.npos) {
    const auto [end, error] =
        std::from_chars(bytes.data() + at, bytes.data() + bytes.size(), value);
    at = std::size_t(end - bytes.data());
    if (error == std::errc() && at < bytes.size()) return value;
  }
  return fail(ErrorCode::kFormat, "damaged PGM image: the header is invalid");
}

Result<DepthFile> decode_pgm(std::string_view bytes) {
  std::size_t at = 2;
  TURNSCAN_ASSIGN(const std::uint32_t width, pgm_number(bytes, at));
  TURNSCAN_ASSIGN(const std::uint32_t height, pgm_number(bytes, at));
  TURNSCAN_ASSIGN(const std::uint32_t largest, pgm_number(bytes, at));
  if (largest < 256 || largest > 65535)
    return fail(ErrorCode::kUnsupported,
                "a depth image must have 16 bits: this PGM has values up to {}; it may be a "
                "picture of depth rather than depth",
                largest);
  const std::string_view body = bytes.substr(at + 1);
  TURNSCAN_TRY(check_depth_size(width, height, 2, body.size()));
  DepthImage out(static_cast<int>(width), static_cast<int>(height), kNoReturn);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = std::uint16_t(value_at<std::uint16_t>(body.data() + 2 * i, true));
  return DepthFile{std::move(out)};
}

Result<DepthFile> decode_depth_png_file(std::string_view bytes, bool take_eight_bits) {
  TURNSCAN_ASSIGN(const auto info, image::read_png_info(bytes));
  if (!take_eight_bits || info.color_type != 0 || info.bit_depth != 8) {
    TURNSCAN_ASSIGN(DepthImage image, decode_depth_png(bytes));
    return DepthFile{std::move(image)};
  }
  Image<std::uint8_t> grey(int(info.width), int(info.height));
  TURNSCAN_TRY(image::decode_png(bytes, info, image::PngPixels::kGrey8, grey.pixels.data()));
  DepthFile out{DepthImage(grey.width, grey.height), false, true};
  std::copy(grey.pixels.begin(), grey.pixels.end(), out.image.pixels.begin());
  return out;
}

}  // namespace

Result<DepthFile> decode_depth_file(std::string_view bytes, const DepthFileOptions& options) {
  if (options.bare_rows > 0) {
    const NumberImage bare{'u', false, 2, options.bare_rows, options.bare_columns};
    TURNSCAN_TRY(check_depth_size(bare.columns, bare.rows, bare.value_bytes, bytes.size()));
    return depth_of(bare, bytes, options.float_unit_m);
  }
  if (bytes.starts_with(kNpyMagic)) return decode_npy(bytes, options.float_unit_m);
  if (bytes.starts_with("P5")) return decode_pgm(bytes);
  if (image::looks_like_tiff(bytes) || image::looks_like_exr(bytes)) {
    TURNSCAN_ASSIGN(const image::FileNumbers numbers, image::looks_like_exr(bytes)
                                                          ? image::decode_exr_numbers(bytes)
                                                          : image::decode_tiff_numbers(bytes));
    return depth_of(numbers.header, numbers.values, options.float_unit_m);
  }
  if (image::looks_like_png(bytes)) return decode_depth_png_file(bytes, options.eight_bits);
  return fail(
      ErrorCode::kUnsupported,
      "this is neither a PNG, a PGM, a TIFF, an EXR nor an NPY file; write depth as one of these");
}

Result<DepthFile> read_depth_file(const std::filesystem::path& path,
                                  const DepthFileOptions& options) {
  return file::decode_file(
      path, [&](std::string_view bytes) { return decode_depth_file(bytes, options); });
}

}  // namespace turnscan
