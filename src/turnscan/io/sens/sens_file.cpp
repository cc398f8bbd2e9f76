#include <libdeflate.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <turnscan/io/image/frame_size.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/sens/sens_file.hpp>

namespace turnscan::sens {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kVersion = 4;
constexpr std::uint64_t kMaxName = 1024;
constexpr std::uint32_t kMaxSide = 16384;
constexpr std::uint64_t kFrameHeaderBytes = 64 + 4 * 8;

/// Reads fields sequentially.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void take(T& value) {
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_.remove_prefix(sizeof(T));
  }

 private:
  std::string_view bytes_;
};

template <class T>
T value_at(std::string_view bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

bool good_sizes(const Header& h) {
  const auto side = [](std::uint32_t s) { return s >= 1 && s <= kMaxSide; };
  const auto few = [](std::uint32_t width, std::uint32_t height, std::uint64_t most) {
    return std::uint64_t(width) * height <= most;
  };
  return few(h.depth_width, h.depth_height, image::kMaxDepthPixels) &&
         few(h.color_width, h.color_height, image::kMaxFrameColorPixels) && side(h.depth_width) &&
         side(h.depth_height) && h.color_width <= kMaxSide && h.color_height <= kMaxSide;
}

/// The header, and the position of the first frame.
Result<std::pair<Header, std::uint64_t>> read_header(const file::RandomAccessFile& file) {
  TURNSCAN_ASSIGN(const std::string begin, file.read(0, std::uint64_t(12)));
  const auto version = value_at<std::uint32_t>(begin, 0);
  if (version != kVersion)
    return fail_at(file.path().string(), ErrorCode::kUnsupported,
                   "the .sens file has version {}; version {} is read", version, kVersion);
  const auto name = value_at<std::uint64_t>(begin, 4);
  if (name > kMaxName)
    return fail_at(file.path().string(), ErrorCode::kFormat,
                   "the sensor's name has {} characters by the header; this is no .sens file, or "
                   "it is damaged",
                   name);
  constexpr std::uint64_t kRest = 4 * 64 + 2 * 4 + 4 * 4 + 4 + 8;
  TURNSCAN_ASSIGN(const std::string bytes, file.read(12, name + kRest));
  Header h;
  h.sensor_name = bytes.substr(0, name);
  Fields fields(std::string_view(bytes).substr(name));
  fields.take(h.color_intrinsics);
  fields.take(h.color_extrinsics);
  fields.take(h.depth_intrinsics);
  fields.take(h.depth_extrinsics);
  fields.take(h.color_packing);
  fields.take(h.depth_packing);
  fields.take(h.color_width);
  fields.take(h.color_height);
  fields.take(h.depth_width);
  fields.take(h.depth_height);
  fields.take(h.depth_shift);
  fields.take(h.frame_count);
  if (!good_sizes(h) || !(h.depth_shift >= 1.0f && h.depth_shift <= 1e7f))
    return fail_at(file.path().string(), ErrorCode::kFormat,
                   "the header states depth images of {} x {} pixels with {} steps a metre; the "
                   "file is damaged",
                   h.depth_width, h.depth_height, h.depth_shift);
  return std::pair(std::move(h), 12 + name + kRest);
}

struct FreeUnpacker {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

bool unpack_zlib(const std::string& packed, std::vector<std::uint16_t>& pixels) {
  const std::unique_ptr<libdeflate_decompressor, FreeUnpacker> decompressor(
      libdeflate_alloc_decompressor());
  std::size_t size = 0;
  const std::size_t wanted = pixels.size() * sizeof(std::uint16_t);
  return decompressor != nullptr &&
         libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), pixels.data(),
                                    wanted, &size) == LIBDEFLATE_SUCCESS &&
         size == wanted;
}

}  // namespace

bool looks_like_sens(std::string_view begin) {
  return begin.size() >= 12 && value_at<std::uint32_t>(begin, 0) == kVersion &&
         value_at<std::uint64_t>(begin, 4) <= kMaxName;
}

Result<Index> read_index(const file::RandomAccessFile& file, const RunContext& context) {
  const file::ReadBudget budget(file.size(), context);
  TURNSCAN_ASSIGN(auto header, read_header(file));
  Index index{std::move(header.first), {}};
  std::uint64_t at = header.second;
  while (index.frames.size() < index.header.frame_count && file.size() - at >= kFrameHeaderBytes) {
    TURNSCAN_TRY(budget.hold(file::ReadBudget::kFrame));
    TURNSCAN_ASSIGN(const std::string bytes, file.read(at, kFrameHeaderBytes));
    Fields fields(bytes);
    FramePlace frame;
    fields.take(frame.camera_to_world);
    fields.take(frame.color_time_us);
    fields.take(frame.depth_time_us);
    fields.take(frame.color_bytes);
    fields.take(frame.depth_bytes);
    frame.color_at = at + kFrameHeaderBytes;
    const std::uint64_t left = file.size() - frame.color_at;
    if (frame.color_bytes > left || frame.depth_bytes > left - frame.color_bytes) break;
    frame.depth_at = frame.color_at + frame.color_bytes;
    at = frame.depth_at + frame.depth_bytes;
    index.frames.push_back(frame);
  }
  return index;
}

Result<std::vector<std::uint16_t>> read_depth(const file::RandomAccessFile& file,
                                              const Header& header, const FramePlace& frame) {
  const std::string path = file.path().string();
  const std::uint64_t at = frame.depth_at;
  if (header.depth_packing != DepthPacking::kRaw && header.depth_packing != DepthPacking::kZlib)
    return fail_at(path, ErrorCode::kUnsupported,
                   "depth is packed by method {}; raw (0) and zlib (1) are read",
                   std::int32_t(header.depth_packing));
  constexpr std::uint64_t kMaxRatio = 1040;  // of deflate
  const std::uint64_t pixels = std::uint64_t(header.depth_width) * header.depth_height;
  const bool raw = header.depth_packing == DepthPacking::kRaw;
  if (raw ? frame.depth_bytes != 2 * pixels : 2 * pixels / kMaxRatio > frame.depth_bytes)
    return fail_at(path, ErrorCode::kFormat,
                   "the depth image at byte {} has {} bytes, which do not fit its size", at,
                   frame.depth_bytes);
  std::vector<std::uint16_t> out;
  if (raw) {
    out.resize(pixels);
    TURNSCAN_TRY(file.read(at, std::span(reinterpret_cast<char*>(out.data()), 2 * pixels)));
    return out;
  }
  TURNSCAN_ASSIGN(const std::string packed, file.read(at, frame.depth_bytes));
  out.resize(pixels);
  if (unpack_zlib(packed, out)) return out;
  return fail_at(path, ErrorCode::kFormat, "the depth image at byte {} is damaged", at);
}

}  // namespace turnscan::sens
