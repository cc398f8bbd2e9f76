#pragma once
// .sens, the container of ScanNet and of SUN3D's and BundleFusion's recordings, version 4: a header
// followed by the frames. Follows ScanNet's SensReader (sensorData.h and README), which defines it:
// little-endian; row-major matrices of 32-bit floats.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/random_access_file.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <vector>

namespace turnscan::sens {

using Matrix = std::array<float, 16>;

enum class ColorPacking : std::int32_t { kUnknown = -1, kRaw = 0, kPng = 1, kJpeg = 2 };
enum class DepthPacking : std::int32_t { kUnknown = -1, kRaw = 0, kZlib = 1, kOcci = 2 };

struct Header {
  std::string sensor_name;
  Matrix color_intrinsics{}, color_extrinsics{};  ///< extrinsics: camera to the base frame
  Matrix depth_intrinsics{}, depth_extrinsics{};
  ColorPacking color_packing = ColorPacking::kUnknown;
  bool jpeg_is_bgr = false;  ///< red and blue are exchanged in JPEG files
  DepthPacking depth_packing = DepthPacking::kUnknown;
  std::uint32_t color_width = 0, color_height = 0;
  std::uint32_t depth_width = 0, depth_height = 0;
  float depth_shift = 0.0f;       ///< depth steps per metre
  std::uint64_t frame_count = 0;  ///< as stated
};

struct FramePlace {
  Matrix camera_to_world{};  ///< not finite if tracking was lost
  std::uint64_t color_time_us = 0, depth_time_us = 0;
  std::uint64_t color_at = 0, depth_at = 0;  ///< offsets of the data
  std::uint64_t color_bytes = 0, depth_bytes = 0;
};

struct Index {
  Header header;
  std::vector<FramePlace> frames;  ///< only complete frames
};

/// Checks the first 16 bytes: version 4 and a name of at most 1024 characters.
bool looks_like_sens(std::string_view begin);

/// Reads the header and skips over the frames. A truncated file has fewer frames than its header
/// states. Fails with kFormat if the header is damaged or states impossible sizes, and with
/// kUnsupported for another version, kResourceLimit for more frames than a file of its length can
/// have (file::ReadBudget), and kCancelled.
Result<Index> read_index(const file::RandomAccessFile& file,
                         const RunContext& context = RunContext());

/// Values of the depth image, depth_width x depth_height; row by row. Fails with kUnsupported for
/// compression other than raw and zlib, and with kFormat if it is damaged.
Result<std::vector<std::uint16_t>> read_depth(const file::RandomAccessFile& file,
                                              const Header& header, const FramePlace& frame);

}  // namespace turnscan::sens
