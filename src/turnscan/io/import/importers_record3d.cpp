// Imports recordings of Record3D (record3d.app), .r3d: a zip with `metadata` (JSON) and rgbd/N.jpg,
// rgbd/N.depth and rgbd/N.conf, as its author describes them (github.com/marek-simonik/record3d,
// issues 7, 30, 39, 93, 108): depth as LZFSE-compressed 32-bit floats in metres, confidence as
// LZFSE-compressed bytes 0 to 2 (Apple: low, medium, high), both registered to colour. LZ4, the
// other compression in Apple's library, is accepted as well.

#include <algorithm>
#include <charconv>
#include <map>
#include <turnscan/core/version.hpp>
#include <turnscan/io/image/depth_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/lz4/lz4.hpp>
#include <turnscan/io/lzfse/lzfse.hpp>
#include <turnscan/io/record3d/metadata.hpp>
#include <turnscan/io/zip/zip_file.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kMaxFrames = 4000000;
constexpr std::uint64_t kMaxJpegBytes = std::uint64_t(256) << 20;

struct R3dFrame {
  FrameInfo info;
  std::optional<zip::Entry> depth, color, confidence;
};

struct R3dFile {
  file::RandomAccessFile file;
  std::vector<R3dFrame> frames;
};

/// Number and ending of "rgbd/12.depth".
std::optional<std::pair<std::uint32_t, std::string_view>> frame_file(std::string_view name) {
  if (!name.starts_with("rgbd/")) return std::nullopt;
  name.remove_prefix(5);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || number >= kMaxFrames) return std::nullopt;
  return std::pair(number, name.substr(std::size_t(end - name.data())));
}

Result<std::map<std::uint32_t, R3dFrame>> frames_in(const zip::Directory& directory,
                                                    const file::ReadBudget& budget) {
  std::map<std::uint32_t, R3dFrame> frames;
  for (const auto& [name, entry] : directory.entries) {
    const auto file = frame_file(name);
    if (!file) continue;
    const auto& [number, ending] = *file;
    if (frames.count(number) == 0) TURNSCAN_TRY(budget.hold(file::ReadBudget::kFrame));
    if (ending == ".depth") {
      frames[number].depth = entry;
      frames[number].info.file = name;
    }
    if (ending == ".jpg") frames[number].color = entry;
    if (ending == ".conf") frames[number].confidence = entry;
  }
  return frames;
}

/// Bytes compressed by LZFSE or LZ4, or stored; a stored image may begin like either, so that data
/// of the right size are not decompressed.
Result<std::string> unpacked_bytes(const fs::path& path, std::string bytes, std::size_t most,
                                   std::size_t right_size) {
  if (bytes.size() == right_size) return bytes;
  const bool lz4 = lz4::looks_like_lz4(bytes);
  if (!lz4 && !lzfse::looks_like_lzfse(bytes)) return bytes;
  auto decoded = lz4 ? lz4::decode(bytes, most) : lzfse::decode(bytes, most);
  if (!decoded) return at_path(path, std::move(decoded).error());
  return decoded;
}

Result<std::string> unpacked(const file::RandomAccessFile& file, const zip::Entry& entry,
                             std::size_t size) {
  // Incompressible data are stored, with a few additional bytes per block.
  TURNSCAN_ASSIGN(std::string packed, zip::read_entry(file, entry, size + size / 16 + 4096));
  TURNSCAN_ASSIGN(std::string bytes, unpacked_bytes(file.path(), std::move(packed), size, size));
  if (bytes.size() == size) return bytes;
  return fail_at(file.path().string(), ErrorCode::kFormat,
                 "the image at byte {} unpacks to {} bytes, but its size asks for {}",
                 entry.header_at, bytes.size(), size);
}

class Record3dSequence : public FrameSequence {
 public:
  Record3dSequence(SequenceHeader header, R3dFile data, std::uint8_t least)
      : header_(std::move(header)), file_(std::move(data.file)), least_(least) {
    header_.software = fmt::format("turnscan {}", version());
    for (R3dFrame& frame : data.frames) {
      infos_.push_back(std::move(frame.info));
      parts_.push_back({frame.depth, frame.color, frame.confidence});
    }
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }

  Result<Frame> read(std::size_t position) const override {
    const Parts& parts = parts_.at(position);
    Frame frame;
    frame.info = infos_[position];
    if (!parts.depth || frame.info.status == FrameStatus::kDropped)
      return fail(ErrorCode::kMissingData, "frame {} was dropped", frame.info.index);
    const SensorInfo& sensor = header_.sensors.front();
    const int width = sensor.intrinsics.width, height = sensor.intrinsics.height;
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    TURNSCAN_ASSIGN(const std::string floats, unpacked(file_, *parts.depth, 4 * pixels));
    frame.depth = depth_of_floats(floats, width, height);
    if (parts.confidence && least_ > 0) {
      TURNSCAN_ASSIGN(const std::string levels, unpacked(file_, *parts.confidence, pixels));
      mask_unsure({reinterpret_cast<const std::uint8_t*>(levels.data()), levels.size()}, least_,
                  frame.depth);
    }
    if (!parts.color) return frame;
    TURNSCAN_TRY(read_jpeg(*parts.color, sensor, frame));
    return frame;
  }

 private:
  struct Parts {
    std::optional<zip::Entry> depth, color, confidence;
  };

  Result<> read_jpeg(const zip::Entry& entry, const SensorInfo& sensor, Frame& frame) const {
    TURNSCAN_ASSIGN(const std::string bytes, zip::read_entry(file_, entry, kMaxJpegBytes));
    if (auto good = decode_frame_color(bytes, frame); !good)
      return at_path(file_.path(), std::move(good).error());
    const ColorImage& image = frame.color;
    const CameraIntrinsics& camera = sensor.color_intrinsics.value_or(sensor.intrinsics);
    if (image.width == camera.width && image.height == camera.height) return {};
    return fail_at(file_.path().string(), ErrorCode::kFormat,
                   "the colour image at byte {} has {} x {} pixels, but its camera has {} x {}",
                   entry.header_at, image.width, image.height, camera.width, camera.height);
  }

  SequenceHeader header_;
  file::RandomAccessFile file_;
  std::vector<FrameInfo> infos_;
  std::vector<Parts> parts_;
  std::uint8_t least_;
};

/// Side lengths of an image in either orientation.
struct Sides {
  int shorter = 0, longer = 0;
  bool operator==(const Sides&) const = default;
};
Sides sides_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Depth images of the two sensors as delivered by Apple.
constexpr Sides kLidar{192, 256}, kTrueDepth{480, 640};

/// Older recordings do not state the size of depth: it is derived from the number of pixels.
Result<> size_by_content(const R3dFile& data, record3d::Metadata& metadata) {
  if (metadata.depth_width != 0) return {};
  const auto first = std::find_if(data.frames.begin(), data.frames.end(),
                                  [](const R3dFrame& f) { return f.depth.has_value(); });
  const std::uint64_t most =
      std::uint64_t(metadata.camera.width) * std::uint64_t(metadata.camera.height) * 4;
  TURNSCAN_ASSIGN(std::string packed,
                  zip::read_entry(data.file, *first->depth, most + most / 16 + 4096));
  TURNSCAN_ASSIGN(const std::string bytes,
                  unpacked_bytes(data.file.path(), std::move(packed),
                                 std::size_t(std::max<std::uint64_t>(most, 480 * 640 * 4)), 0));
  const bool upright = metadata.camera.height >= metadata.camera.width;
  const Sides color = sides_of(metadata.camera.width, metadata.camera.height);
  for (const auto& [shorter, longer] : {kLidar, kTrueDepth, color}) {
    if (bytes.size() != std::size_t(shorter) * std::size_t(longer) * 4) continue;
    metadata.depth_width = upright ? shorter : longer;
    metadata.depth_height = upright ? longer : shorter;
    return {};
  }
  return fail_at(data.file.path().string(), ErrorCode::kFormat,
                 "metadata has no dw and dh, and {} bytes of depth fit no known size",
                 bytes.size());
}

/// Distinguishes TrueDepth (structured light, 640 x 480) and LiDAR (time of flight, 256 x 192) by
/// the size.
std::string model_of(int width, int height, bool has_confidence) {
  const Sides sides = sides_of(width, height);
  if (sides == kLidar) return "iphone-lidar";
  if (sides.shorter >= kTrueDepth.shorter && sides.longer * 3 == sides.shorter * 4)
    return "iphone-truedepth";
  return has_confidence ? "iphone-lidar" : "iphone-truedepth";
}

Result<> describe_sensor(const R3dFile& data, const record3d::Metadata& metadata,
                         SequenceHeader& header) {
  SensorInfo sensor;
  sensor.intrinsics =
      from_corner_coordinates(metadata.camera, metadata.depth_width, metadata.depth_height);
  sensor.depth_unit_m = kFloatDepthStep_m;
  const auto colored = std::find_if(data.frames.begin(), data.frames.end(),
                                    [](const R3dFrame& f) { return f.color.has_value(); });
  if (colored != data.frames.end()) {
    TURNSCAN_ASSIGN(const std::string bytes,
                    zip::read_entry(data.file, *colored->color, kMaxJpegBytes));
    auto image = decode_color(bytes);
    if (!image) return at_path(data.file.path(), std::move(image).error());
    if (image->width != metadata.depth_width || image->height != metadata.depth_height)
      sensor.color_intrinsics =
          from_corner_coordinates(metadata.camera, image->width, image->height);
  }
  const bool has_confidence =
      std::any_of(data.frames.begin(), data.frames.end(),
                  [](const R3dFrame& f) { return f.confidence.has_value(); });
  sensor.model = model_of(metadata.depth_width, metadata.depth_height, has_confidence);
  add_note(header, fmt::format("depth of {} x {} pixels: taken for the {}", metadata.depth_width,
                               metadata.depth_height,
                               sensor.model == "iphone-lidar" ? "LiDAR" : "TrueDepth camera"));
  if (sensor.model == "iphone-lidar") add_note(header, kLidarNote);
  TURNSCAN_TRY(sensor.intrinsics.check());
  header.sensors.push_back(std::move(sensor));
  return {};
}

/// Assigns times and poses from the metadata by frame number.
Result<> place_frames(const ImportOptions& options, record3d::Metadata& metadata,
                      std::vector<R3dFrame>& frames, SequenceHeader& header) {
  if (!times_from_first(metadata.times_s)) metadata.times_s.clear();
  std::vector<std::optional<Pose>> poses;
  bool timed = true;
  for (const R3dFrame& frame : frames) {
    const std::uint32_t number = frame.info.index;
    const bool known = number < metadata.poses.size() && metadata.poses[number];
    poses.push_back(known ? std::optional(from_gl_camera(*metadata.poses[number])) : std::nullopt);
    timed = timed && number < metadata.times_s.size();
  }
  TURNSCAN_TRY(settle_device_poses(options, poses, header));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameInfo& info = frames[i].info;
    info.T_table_sensor = poses[i];
    if (timed) info.time_s = metadata.times_s[info.index];
    if (!timed && metadata.fps >= 1.0 && metadata.fps <= 1000.0)
      info.time_s = info.index / metadata.fps;
  }
  if (!timed)
    add_note(header, fmt::format("there are no times of the frames that increase: they were taken "
                                 "{} times a second, as the file says",
                                 metadata.fps));
  return {};
}

Result<record3d::Metadata> read_metadata(const file::RandomAccessFile& file,
                                         const zip::Directory& directory,
                                         const file::ReadBudget& budget, SequenceHeader& header) {
  const auto entry = std::find_if(directory.entries.begin(), directory.entries.end(),
                                  [](const zip::NamedEntry& e) { return e.name == "metadata"; });
  if (entry == directory.entries.end())
    return fail_at(file.path().string(), ErrorCode::kFormat, "{}",
                   directory.cut_off
                       ? "the file is cut off before its metadata; copy it from the phone again"
                       : "the archive has no entry \"metadata\": this is no recording of Record3D");
  TURNSCAN_ASSIGN(const std::string text, zip::read_entry(file, entry->entry, kMaxTextBytes));
  auto metadata = record3d::parse_metadata(text, budget);
  if (!metadata) {
    Error error = std::move(metadata).error();
    error.message = "metadata: " + error.message;
    return at_path(file.path(), std::move(error));
  }
  if (metadata->focal_change > 0.002)
    add_note(header, fmt::format("the focal length changed by {:.1f} % while recording, and one "
                                 "for all frames was taken; lock the focus next time",
                                 100.0 * metadata->focal_change));
  return metadata;
}

/// Frames with depth, sorted by their numbers, which are in info.index.
Result<R3dFile> collect(file::RandomAccessFile file, const zip::Directory& directory,
                        const file::ReadBudget& budget, std::size_t stated,
                        SequenceHeader& header) {
  R3dFile data{std::move(file), {}};
  TURNSCAN_ASSIGN(auto frames, frames_in(directory, budget));
  for (auto& [number, frame] : frames) {
    if (!frame.depth) continue;
    frame.info.index = number;
    data.frames.push_back(std::move(frame));
  }
  if (data.frames.empty())
    return fail_at(data.file.path().string(), ErrorCode::kTooFewPoints,
                   "the archive has no depth images (rgbd/0.depth and so on)");
  if (directory.cut_off)
    add_note(header,
             fmt::format("the file is cut off: its first {} frames{} are whole and were "
                         "taken",
                         data.frames.size(), stated == 0 ? "" : fmt::format(" of {}", stated)));
  return data;
}

}  // namespace

OpenResult open_record3d(const fs::path& path, const ImportOptions& options,
                         const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("Record3D recording {}", display_name(path));
  TURNSCAN_ASSIGN(file::RandomAccessFile file, file::RandomAccessFile::open(path));
  const file::ReadBudget budget(file.size(), context);
  auto listed = zip::read_directory(file, budget);
  if (!listed) return at_path(path, std::move(listed).error());
  const zip::Directory& directory = *listed;
  TURNSCAN_ASSIGN(record3d::Metadata metadata, read_metadata(file, directory, budget, header));
  auto collected = collect(std::move(file), directory, budget,
                           std::max(metadata.poses.size(), metadata.times_s.size()), header);
  if (!collected) return at_path(path, std::move(collected).error());
  R3dFile& data = *collected;
  TURNSCAN_TRY(context.check());
  TURNSCAN_TRY(size_by_content(data, metadata));
  if (auto good = describe_sensor(data, metadata, header); !good)
    return at_path(path, std::move(good).error());
  TURNSCAN_TRY(place_frames(options, metadata, data.frames, header));
  data.frames = with_dropped(std::move(data.frames), header);
  drop_without_pose(data.frames, header);
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<Record3dSequence>(std::move(header), std::move(data),
                                            least_confidence(options));
}

}  // namespace turnscan::importers
