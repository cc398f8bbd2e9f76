#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/image/frame_size.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import_ros/ros_images.hpp>

namespace turnscan::importers {

namespace {

using rosbag::CompressedImageMessage;
using rosbag::ImageMessage;

constexpr float kMaxSteps = 65534.0f;

enum class Layout { kRgb, kBgr, kGrey, kYuyv, kUyvy };

struct Encoding {
  std::string_view name;
  Layout layout;
  std::uint32_t bytes;  ///< per pixel
};

// 8UC3 is written by users of OpenCV: blue first.
constexpr std::array<Encoding, 16> kEncodings = {{{"rgb8", Layout::kRgb, 3},
                                                  {"bgr8", Layout::kBgr, 3},
                                                  {"8UC3", Layout::kBgr, 3},
                                                  {"rgba8", Layout::kRgb, 4},
                                                  {"bgra8", Layout::kBgr, 4},
                                                  {"8UC4", Layout::kBgr, 4},
                                                  {"mono8", Layout::kGrey, 1},
                                                  {"8UC1", Layout::kGrey, 1},
                                                  {"yuyv", Layout::kYuyv, 2},
                                                  {"YUYV", Layout::kYuyv, 2},
                                                  {"yuv422_yuy2", Layout::kYuyv, 2},
                                                  {"yuyv422", Layout::kYuyv, 2},
                                                  {"yuv422", Layout::kUyvy, 2},
                                                  {"uyvy", Layout::kUyvy, 2},
                                                  {"UYVY", Layout::kUyvy, 2},
                                                  {"uyvy422", Layout::kUyvy, 2}}};

const Encoding* encoding_of(std::string_view name) {
  const auto found = std::find_if(kEncodings.begin(), kEncodings.end(),
                                  [&](const Encoding& e) { return e.name == name; });
  return found == kEncodings.end() ? nullptr : &*found;
}

/// Checks that the rows are within the data.
Result<> check_rows(const ImageMessage& image, std::uint32_t pixel_bytes, std::uint64_t most) {
  const std::uint64_t row = std::uint64_t(image.width) * pixel_bytes;
  TURNSCAN_TRY(turnscan::image::check_pixels(image.width, image.height, most));
  if (image.step < row || std::uint64_t(image.step) * (image.height - 1) + row > image.data.size())
    return fail(ErrorCode::kFormat,
                "an image of {} x {} pixels ({}) does not fit its {} bytes; the message is damaged",
                image.width, image.height, file::clean_name(image.encoding.substr(0, 40)),
                image.data.size());
  return {};
}

std::uint16_t steps_of(float metres, float per_metre) {
  const float steps = metres * per_metre;
  // Also kNoReturn for NaN.
  return steps >= 0.5f && steps <= kMaxSteps ? std::uint16_t(std::lround(steps)) : kNoReturn;
}

template <bool kSwap>
void take_integers(const char* row, std::uint16_t* out, std::uint32_t width) {
  for (std::uint32_t i = 0; i < width; ++i) {
    const auto value = file::load<std::uint16_t, kSwap>(row + 2 * std::size_t(i));
    out[i] = value == kOutsideCrop ? kNoReturn : value;
  }
}

template <bool kSwap>
void take_floats(const char* row, std::uint16_t* out, std::uint32_t width, float per_metre) {
  for (std::uint32_t i = 0; i < width; ++i)
    out[i] = steps_of(file::load<float, kSwap>(row + 4 * std::size_t(i)), per_metre);
}

std::uint8_t clamped(int value) { return std::uint8_t(std::clamp(value, 0, 255)); }

/// Full-range ITU-R BT.601, as in JPEG.
Rgb rgb_of(int y, int u, int v) {
  const int d = u - 128, e = v - 128;
  return {clamped(y + (359 * e + 128) / 256), clamped(y - (88 * d + 183 * e - 128) / 256),
          clamped(y + (454 * d + 128) / 256)};
}

void take_color(const char* from, const Encoding& encoding, Rgb* out, std::uint32_t width) {
  const auto* row = reinterpret_cast<const std::uint8_t*>(from);
  for (std::uint32_t i = 0; i < width; ++i) {
    const std::uint8_t* p = row + std::size_t(i) * encoding.bytes;
    switch (encoding.layout) {
      case Layout::kRgb:
        out[i] = {p[0], p[1], p[2]};
        break;
      case Layout::kBgr:
        out[i] = {p[2], p[1], p[0]};
        break;
      case Layout::kGrey:
        out[i] = {p[0], p[0], p[0]};
        break;
      case Layout::kYuyv:
      case Layout::kUyvy: {
        const std::size_t luma = encoding.layout == Layout::kYuyv ? 0 : 1;
        const std::uint8_t* pair = row + 4 * std::size_t(i / 2);
        out[i] = rgb_of(p[luma], pair[1 - luma], pair[3 - luma]);
        break;
      }
    }
  }
}

}  // namespace

bool is_integer_depth(std::string_view encoding) {
  return encoding == "16UC1" || encoding == "mono16";
}
bool is_float_depth(std::string_view encoding) { return encoding == "32FC1"; }
bool is_color(std::string_view encoding) { return encoding_of(encoding) != nullptr; }

Result<DepthImage> ros_depth(const ImageMessage& image, double unit_m) {
  const bool integers = is_integer_depth(image.encoding);
  if (!integers && !is_float_depth(image.encoding))
    return fail(ErrorCode::kUnsupported, "images of encoding '{}' hold no depth that can be read",
                file::clean_name(image.encoding.substr(0, 40)));
  TURNSCAN_TRY(check_rows(image, integers ? 2 : 4, turnscan::image::kMaxDepthPixels));
  DepthImage out(int(image.width), int(image.height));
  const auto per_metre = static_cast<float>(1.0 / unit_m);
  for (std::uint32_t r = 0; r < image.height; ++r) {
    const char* row = image.data.data() + std::size_t(r) * image.step;
    std::uint16_t* to = out.pixels.data() + std::size_t(r) * image.width;
    if (integers)
      image.big_endian ? take_integers<true>(row, to, image.width)
                       : take_integers<false>(row, to, image.width);
    else
      image.big_endian ? take_floats<true>(row, to, image.width, per_metre)
                       : take_floats<false>(row, to, image.width, per_metre);
  }
  return out;
}

std::string_view compressed_depth_encoding(std::string_view format) {
  if (format.find("compressedDepth") == std::string_view::npos) return {};
  const std::string_view encoding = format.substr(0, format.find(';'));
  return is_integer_depth(encoding) || is_float_depth(encoding) ? encoding : std::string_view();
}

Result<DepthImage> ros_depth(const CompressedImageMessage& image, double unit_m) {
  // The compression method and two parameters of inverse depth precede the PNG.
  constexpr std::size_t kConfigBytes = 12;
  const std::string_view encoding = compressed_depth_encoding(image.format);
  if (encoding.empty() || image.data.size() < kConfigBytes)
    return fail(ErrorCode::kUnsupported,
                "a compressed image of format '{}' holds no depth that "
                "can be read",
                file::clean_name(image.format.substr(0, 60)));
  TURNSCAN_ASSIGN(DepthImage out, decode_depth_png(image.data.substr(kConfigBytes)));
  if (is_integer_depth(encoding)) {
    std::replace(out.pixels.begin(), out.pixels.end(), kOutsideCrop, kNoReturn);
    return out;
  }
  const auto a = file::load<float, false>(image.data.data() + 4);
  const auto b = file::load<float, false>(image.data.data() + 8);
  const auto per_metre = static_cast<float>(1.0 / unit_m);
  for (std::uint16_t& value : out.pixels)
    value = value == 0 ? kNoReturn : steps_of(a / (float(value) - b), per_metre);
  return out;
}

Result<ColorImage> ros_color(const ImageMessage& image) {
  const Encoding* encoding = encoding_of(image.encoding);
  if (encoding == nullptr)
    return fail(ErrorCode::kUnsupported, "colour of encoding '{}' cannot be read",
                file::clean_name(image.encoding.substr(0, 40)));
  const bool pairs = encoding->layout == Layout::kYuyv || encoding->layout == Layout::kUyvy;
  if (pairs && image.width % 2 != 0)
    return fail(ErrorCode::kFormat, "an image of encoding '{}' has an odd width; it is damaged",
                image.encoding);
  TURNSCAN_TRY(check_rows(image, encoding->bytes, turnscan::image::kMaxFrameColorPixels));
  ColorImage out(int(image.width), int(image.height));
  for (std::uint32_t r = 0; r < image.height; ++r)
    take_color(image.data.data() + std::size_t(r) * image.step, *encoding,
               out.pixels.data() + std::size_t(r) * image.width, image.width);
  return out;
}

Result<> take_ros_color(const CompressedImageMessage& image, Frame& frame) {
  return decode_frame_color(image.data, frame);
}

}  // namespace turnscan::importers
