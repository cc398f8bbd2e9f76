#include <OpenEXR/openexr.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <span>
#include <turnscan/io/image/file_numbers.hpp>
#include <turnscan/io/image/frame_size.hpp>

namespace turnscan::image {

namespace {

/// Those that lose nothing, or no more than a 65,000th (PXR24).
constexpr std::array<exr_compression_t, 6> kExrCodecs{EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE,
                                                      EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP,
                                                      EXR_COMPRESSION_PIZ,  EXR_COMPRESSION_PXR24};
/// Bytes of an image for each of its file: far above what the codecs reach on an empty one.
constexpr std::size_t kMostPackedExr = 16384;

std::int64_t read_exr_bytes(exr_const_context_t, void* user, void* to, std::uint64_t size,
                            std::uint64_t offset, exr_stream_error_func_ptr_t) {
  const std::string_view bytes = *static_cast<std::string_view*>(user);
  if (offset > bytes.size()) return -1;
  const std::string_view part = bytes.substr(offset, size);
  std::copy(part.begin(), part.end(), static_cast<char*>(to));
  return std::int64_t(part.size());
}

std::int64_t exr_size(exr_const_context_t, void* user) {
  return std::int64_t(static_cast<std::string_view*>(user)->size());
}

/// OpenEXR looks at all attributes before it adds one: a hundred thousand would take minutes.
constexpr int kMaxHeaderBlocks = 10000;
thread_local int header_blocks_left = 0;

void* allocate_at_most(std::size_t size) {
  if (size > kMaxDepthPixels * sizeof(double) || header_blocks_left-- <= 0) return nullptr;
  return std::malloc(size);
}

/// A file that is being read, and the steps that unpack its rows.
struct ExrReader {
  exr_context_t context = nullptr;
  exr_decode_pipeline_t rows{};

  ExrReader() = default;
  ExrReader(const ExrReader&) = delete;
  ExrReader& operator=(const ExrReader&) = delete;
  ~ExrReader() {
    exr_decoding_destroy(context, &rows);
    if (context != nullptr) exr_finish(&context);
  }
};

bool names_depth(std::string_view channel) {
  std::string name(channel);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return name == "z" || name.ends_with(".z") || name.find("depth") != name.npos;
}

Result<const exr_attr_chlist_entry_t*> depth_channel(exr_const_context_t context) {
  const exr_attr_chlist_t* list = nullptr;
  if (exr_get_channels(context, 0, &list) != EXR_ERR_SUCCESS || list->num_channels < 1)
    return fail(ErrorCode::kFormat, "damaged EXR image: it has no channels");
  const std::span channels(list->entries, std::size_t(list->num_channels));
  const auto is_depth = [](const auto& channel) { return names_depth(channel.name.str); };
  const auto found = channels.size() == 1
                         ? channels.begin()
                         : std::find_if(channels.begin(), channels.end(), is_depth);
  if (found == channels.end())
    return fail(ErrorCode::kUnsupported,
                "this EXR has {} channels ({}, {}, ...), and none is named Z or depth; save depth "
                "as its only channel",
                channels.size(), channels[0].name.str, channels[1].name.str);
  if (found->x_sampling != 1 || found->y_sampling != 1)
    return fail(ErrorCode::kUnsupported, "the channel {} of this EXR leaves out pixels",
                found->name.str);
  return &*found;
}

Result<> check_exr_layout(exr_const_context_t context) {
  exr_storage_t storage{};
  exr_compression_t codec{};
  exr_get_storage(context, 0, &storage);
  exr_get_compression(context, 0, &codec);
  if (storage != EXR_STORAGE_SCANLINE)
    return fail(ErrorCode::kUnsupported,
                "this EXR has tiles or several values a pixel; save it in rows (scan lines)");
  if (std::find(kExrCodecs.begin(), kExrCodecs.end(), codec) == kExrCodecs.end())
    return fail(ErrorCode::kUnsupported,
                "this EXR is packed by a codec that changes depth (B44 or DWA); save it with ZIP");
  return {};
}

/// `top` becomes the number of the first row.
Result<NumberImage> exr_header(exr_const_context_t context, const exr_attr_chlist_entry_t& channel,
                               std::int64_t& top) {
  TURNSCAN_TRY(check_exr_layout(context));
  exr_attr_box2i_t data{}, shown{};
  exr_get_data_window(context, 0, &data);
  exr_get_display_window(context, 0, &shown);
  const std::int64_t width = std::int64_t(data.max.x) - data.min.x + 1;
  const std::int64_t height = std::int64_t(data.max.y) - data.min.y + 1;
  // A width below 1 becomes one that is too large.
  TURNSCAN_TRY(check_pixels(std::uint64_t(width), std::uint64_t(height), kMaxDepthPixels));
  if (std::memcmp(&data, &shown, sizeof(data)) != 0)
    return fail(ErrorCode::kUnsupported,
                "this EXR holds a part of its image only (data window and display window differ); "
                "save the whole image");
  NumberImage out;
  out.kind = channel.pixel_type == EXR_PIXEL_UINT ? 'u' : 'f';
  out.value_bytes = 4;
  out.columns = std::uint32_t(width);
  out.rows = std::uint32_t(height);
  top = data.min.y;
  return out;
}

/// Unpacks the rows that begin with `row` into `out`.
exr_result_t read_rows(ExrReader& reader, const exr_attr_chlist_entry_t& channel, int row,
                       const NumberImage& header, char* out) {
  exr_chunk_info_t place{};
  exr_decode_pipeline_t& rows = reader.rows;
  exr_result_t done = exr_read_scanline_chunk_info(reader.context, 0, row, &place);
  const bool first = rows.channels == nullptr;
  if (done == EXR_ERR_SUCCESS)
    done = first ? exr_decoding_initialize(reader.context, 0, &place, &rows)
                 : exr_decoding_update(reader.context, 0, &place, &rows);
  if (done != EXR_ERR_SUCCESS) return done;
  for (auto& one : std::span(rows.channels, std::size_t(rows.channel_count))) {
    one.decode_to_ptr = nullptr;
    if (std::strcmp(one.channel_name, channel.name.str) != 0) continue;
    one.decode_to_ptr = reinterpret_cast<std::uint8_t*>(out);
    one.user_data_type = header.kind == 'f' ? EXR_PIXEL_FLOAT : EXR_PIXEL_UINT;
    one.user_bytes_per_element = 4;
    one.user_pixel_stride = 4;
    one.user_line_stride = std::int32_t(4 * header.columns);
  }
  if (first) done = exr_decoding_choose_default_routines(reader.context, 0, &rows);
  return done == EXR_ERR_SUCCESS ? exr_decoding_run(reader.context, 0, &rows) : done;
}

}  // namespace

bool looks_like_exr(std::string_view bytes) { return bytes.starts_with("\x76\x2f\x31\x01"); }

Result<FileNumbers> decode_exr_numbers(std::string_view bytes) {
  exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
  how.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
  how.alloc_fn = allocate_at_most;
  how.free_fn = std::free;
  how.user_data = &bytes;
  how.read_fn = read_exr_bytes;
  how.size_fn = exr_size;
  how.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE;
  ExrReader reader;
  header_blocks_left = kMaxHeaderBlocks;
  // What cannot be kept is left out, without a word.
  if (exr_start_read(&reader.context, "depth", &how) != EXR_ERR_SUCCESS || header_blocks_left <= 0)
    return fail(ErrorCode::kFormat,
                "damaged EXR image: its header is cut off, invalid or far too long");
  header_blocks_left = std::numeric_limits<int>::max();
  TURNSCAN_ASSIGN(const exr_attr_chlist_entry_t* channel, depth_channel(reader.context));
  FileNumbers out;
  std::int64_t top = 0;
  TURNSCAN_ASSIGN(out.header, exr_header(reader.context, *channel, top));
  std::int32_t step = 0;
  exr_get_scanlines_per_chunk(reader.context, 0, &step);
  const std::size_t row_bytes = 4 * std::size_t(out.header.columns);
  if (row_bytes * out.header.rows > kMostPackedExr * bytes.size())
    return fail(ErrorCode::kFormat, "damaged EXR image: {} bytes cannot hold {} x {} values",
                bytes.size(), out.header.columns, out.header.rows);
  out.values.resize(row_bytes * out.header.rows);
  for (std::uint32_t row = 0; row < out.header.rows; row += std::uint32_t(std::max(step, 1)))
    if (read_rows(reader, *channel, int(top + row), out.header,
                  out.values.data() + row * row_bytes) != EXR_ERR_SUCCESS)
      return fail(ErrorCode::kFormat, "damaged EXR image: row {} of {} cannot be read", row,
                  out.header.rows);
  return out;
}

}  // namespace turnscan::image
