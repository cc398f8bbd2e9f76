#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/sens/klg_file.hpp>

namespace turnscan::sens {

namespace {

constexpr std::uint64_t kKlgHeadBytes = 4, kKlgFrameBytes = 16;
constexpr std::uint32_t kUsualWidth = 640, kUsualHeight = 480;

template <class T>
T little(const char* at) {
  return file::load<T, false>(at);
}

/// Size and packing, by the first frame.
Result<> describe_images(const file::RandomAccessFile& file, const FramePlace& first, Header& h) {
  h.depth_width = kUsualWidth;
  h.depth_height = kUsualHeight;
  h.depth_shift = 1000.0f;
  if (first.color_bytes > 0) {
    TURNSCAN_ASSIGN(const std::string bytes, file.read(first.color_at, first.color_bytes));
    Frame frame;
    h.color_packing = ColorPacking::kRaw;
    if (decode_frame_color(bytes, frame)) {
      h.color_packing = ColorPacking::kJpeg;
      h.jpeg_is_bgr = true;
      h.depth_width = std::uint32_t(frame.color.width);
      h.depth_height = std::uint32_t(frame.color.height);
    } else if (first.color_bytes != 3ULL * kUsualWidth * kUsualHeight) {
      return fail(ErrorCode::kFormat,
                  "the colour image at byte {} is neither a JPEG file nor RGB of 640 x 480 pixels; "
                  "this is no .klg file, or it is damaged",
                  first.color_at);
    }
    h.color_width = h.depth_width;
    h.color_height = h.depth_height;
  }
  const std::uint64_t raw = 2ULL * h.depth_width * h.depth_height;
  h.depth_packing = first.depth_bytes == raw ? DepthPacking::kRaw : DepthPacking::kZlib;
  return {};
}

}  // namespace

Result<Index> read_klg_index(const file::RandomAccessFile& file, const RunContext& context) {
  const file::ReadBudget budget(file.size(), context);
  Index index;
  TURNSCAN_ASSIGN(const std::string head, file.read(0, kKlgHeadBytes));
  const auto stated = little<std::int32_t>(head.data());
  index.header.frame_count = stated > 0 ? std::uint64_t(stated) : 0;
  std::uint64_t at = kKlgHeadBytes;
  while ((stated <= 0 || index.frames.size() < index.header.frame_count) &&
         file.size() - at >= kKlgFrameBytes) {
    TURNSCAN_TRY(budget.hold(file::ReadBudget::kFrame));
    TURNSCAN_ASSIGN(const std::string bytes, file.read(at, kKlgFrameBytes));
    FramePlace frame;
    frame.depth_time_us = little<std::uint64_t>(bytes.data());
    frame.depth_bytes = little<std::uint32_t>(bytes.data() + 8);
    frame.color_bytes = little<std::uint32_t>(bytes.data() + 12);
    frame.depth_at = at + kKlgFrameBytes;
    frame.color_at = frame.depth_at + frame.depth_bytes;
    if (frame.color_at + frame.color_bytes > file.size()) break;
    at = frame.color_at + frame.color_bytes;
    index.frames.push_back(frame);
  }
  if (index.frames.empty())
    return fail(ErrorCode::kFormat,
                "there is no whole frame; this is no .klg file, or it is damaged");
  TURNSCAN_TRY(describe_images(file, index.frames.front(), index.header));
  if (auto depth = read_depth(file, index.header, index.frames.front()); !depth)
    return fail(ErrorCode::kFormat,
                "the first depth image does not unpack to {} x {} pixels; this is no .klg file, it "
                "is damaged, or its images are of another size",
                index.header.depth_width, index.header.depth_height);
  return index;
}

}  // namespace turnscan::sens
