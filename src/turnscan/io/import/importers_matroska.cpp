// Imports recordings of an Azure Kinect, and of the Femto Bolt and Mega made with Orbbec's library
// of the same interface, in a Matroska file. Tracks and tags: Microsoft, "Use Azure Kinect Sensor
// SDK to record file format"
// (learn.microsoft.com/previous-versions/azure/kinect-dk/record-file-format). Depth is in
// millimetres.

#include <algorithm>
#include <cmath>
#include <turnscan/core/version.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/image/yuv.hpp>
#include <turnscan/io/import/azure_kinect.hpp>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/matroska/matroska.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;
using matroska::Block;
using matroska::MatroskaFile;
using matroska::Track;

namespace {

constexpr double kMillimetre = 1e-3;

/// Encoding of a track's frames: the code in a BITMAPINFOHEADER.
enum class Packing { kUnknown, kDepth16BigEndian, kPng, kJpeg, kNv12, kYuy2, kBgra };

std::string_view four_characters(const Track& track) {
  if (track.codec != "V_MS/VFW/FOURCC" || track.codec_private.size() < 20) return {};
  return std::string_view(track.codec_private).substr(16, 4);
}

Packing packing_of(const Track& track) {
  if (track.codec == "V_MJPEG") return Packing::kJpeg;
  const std::string_view code = four_characters(track);
  if (code == "b16g") return Packing::kDepth16BigEndian;
  if (code == "MPNG") return Packing::kPng;
  if (code == "MJPG") return Packing::kJpeg;
  if (code == "NV12") return Packing::kNv12;
  if (code == "YUY2") return Packing::kYuy2;
  if (code == "BGRA") return Packing::kBgra;
  return Packing::kUnknown;
}

std::string shown_codec(const Track& track) {
  std::string code(four_characters(track));
  for (char& c : code)
    if (c < ' ' || c > '~') c = '?';
  return code.empty() ? track.codec : fmt::format("{} {}", track.codec, code);
}

/// The track whose UID is given by a tag, else the one with that name.
const Track* track_named(const MatroskaFile& file, std::string_view name, std::string_view tag) {
  for (const matroska::Tag& t : file.tags()) {
    if (t.name != tag) continue;
    for (const Track& track : file.tracks())
      if (track.video && (track.uid == t.track || std::to_string(track.uid) == t.value))
        return &track;
  }
  for (const Track& track : file.tracks())
    if (track.video && track.name == name) return &track;
  return nullptr;
}

Result<const Track*> depth_track(const MatroskaFile& file) {
  const Track* track = track_named(file, "DEPTH", "K4A_DEPTH_TRACK");
  if (track == nullptr)
    return fail(ErrorCode::kUnsupported,
                "there is no track DEPTH; is it a recording of an Azure Kinect or a Femto with its "
                "depth camera on?");
  const Packing packing = packing_of(*track);
  if (track->encoded || (packing != Packing::kDepth16BigEndian && packing != Packing::kPng))
    return fail(ErrorCode::kUnsupported,
                "the depth track is packed as {}{}; only b16g (16 bit) and PNG are read",
                shown_codec(*track), track->encoded ? ", compressed once more" : "");
  if (track->width < 1 || track->height < 1 || track->width > 65535 || track->height > 65535)
    return fail(ErrorCode::kFormat, "the depth track has images of {} x {} pixels", track->width,
                track->height);
  return track;
}

/// The columns [begin, end) of each row that the lens calibration covers.
struct Columns {
  int begin = 0, end = 0;
};

/// Empty: all of them. Ignores the lens's tangential distortion, which is a few hundredths of a
/// pixel.
std::vector<Columns> covered_columns(const CameraIntrinsics& camera, double radius) {
  double x = std::min(radius, std::sqrt(camera.lens().largest_r2)), y = 0.0;
  BrownConrady<double> lens = camera.lens();
  lens.p1 = lens.p2 = 0.0;
  distort_any(lens, x, y);
  std::vector<Columns> out;
  bool all = true;
  for (int v = 0; v < camera.height; ++v) {
    const double down = (v - camera.cy) / camera.fy, rest = x * x - down * down;
    const double half = rest > 0.0 ? std::sqrt(rest) * camera.fx : -1.0;
    Columns row;
    if (half >= 0.0) {
      row.begin = int(std::clamp(std::ceil(camera.cx - half), 0.0, double(camera.width)));
      row.end = int(std::clamp(std::floor(camera.cx + half) + 1.0, 0.0, double(camera.width)));
    }
    all = all && row.begin == 0 && row.end == camera.width;
    out.push_back(row);
  }
  if (all) out.clear();
  return out;
}

/// The blocks of one frame.
struct FrameBlocks {
  Block depth, color;
  bool has_color = false;
};

struct Frames {
  std::vector<FrameInfo> infos;
  std::vector<FrameBlocks> blocks;  ///< one per frame; meaningless for dropped ones
  Packing depth = Packing::kUnknown, color = Packing::kUnknown;
};

class MatroskaSequence : public FrameSequence {
 public:
  MatroskaSequence(MatroskaFile file, SequenceHeader header, Frames frames,
                   std::vector<Columns> covered)
      : file_(std::move(file)),
        header_(std::move(header)),
        frames_(std::move(frames)),
        covered_(std::move(covered)) {
    header_.software = fmt::format("turnscan {}", version());
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_.infos; }
  Result<Frame> read(std::size_t position) const override;

 private:
  Result<DepthImage> read_depth(const Block& block) const;
  Result<> read_color_image(const Block& block, Frame& frame) const;

  MatroskaFile file_;
  SequenceHeader header_;
  Frames frames_;
  std::vector<Columns> covered_;
};

Result<DepthImage> MatroskaSequence::read_depth(const Block& block) const {
  TURNSCAN_ASSIGN(const std::string bytes, file_.read(block));
  const CameraIntrinsics& camera = header_.sensors.front().intrinsics;
  DepthImage image;
  if (frames_.depth == Packing::kPng) {
    TURNSCAN_ASSIGN(image, decode_depth_png(bytes));
  } else {
    const std::size_t pixels = std::size_t(camera.width) * std::size_t(camera.height);
    if (bytes.size() != 2 * pixels)
      return fail(ErrorCode::kFormat, "an image of {} x {} pixels does not have {} bytes",
                  camera.width, camera.height, bytes.size());
    image = DepthImage(camera.width, camera.height);
    for (std::size_t i = 0; i < pixels; ++i)
      image.pixels[i] = static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[2 * i]) << 8 |
                                                   static_cast<unsigned char>(bytes[2 * i + 1]));
  }
  if (image.width != camera.width || image.height != camera.height)
    return fail(ErrorCode::kFormat, "the image has {} x {} pixels, but its track {} x {}",
                image.width, image.height, camera.width, camera.height);
  std::replace(image.pixels.begin(), image.pixels.end(), kOutsideCrop, kNoReturn);
  for (std::size_t v = 0; v < covered_.size(); ++v) {
    const auto row = image.pixels.begin() + std::ptrdiff_t(v) * image.width;
    std::fill(row, row + covered_[v].begin, kNoReturn);
    std::fill(row + covered_[v].end, row + image.width, kNoReturn);
  }
  return image;
}

Result<> MatroskaSequence::read_color_image(const Block& block, Frame& frame) const {
  TURNSCAN_ASSIGN(const std::string bytes, file_.read(block));
  const CameraIntrinsics& camera = *header_.sensors.front().color_intrinsics;
  if (frames_.color == Packing::kJpeg) {
    TURNSCAN_TRY(decode_frame_color(bytes, frame));
    const ColorImage& image = frame.color;
    if (image.width != camera.width || image.height != camera.height)
      return fail(ErrorCode::kFormat, "the image has {} x {} pixels, but its track {} x {}",
                  image.width, image.height, camera.width, camera.height);
    return {};
  }
  const image::RawColor layout = frames_.color == Packing::kNv12   ? image::RawColor::kNv12
                                 : frames_.color == Packing::kYuy2 ? image::RawColor::kYuy2
                                                                   : image::RawColor::kBgra;
  TURNSCAN_ASSIGN(frame.color, image::decode_raw_color(bytes, camera.width, camera.height, layout));
  return {};
}

Result<Frame> MatroskaSequence::read(std::size_t position) const {
  Frame frame;
  frame.info = frames_.infos.at(position);
  if (frame.info.status == FrameStatus::kDropped)
    return fail_at(file_.path().string(), ErrorCode::kMissingData, "frame {} was dropped",
                   frame.info.index);
  const auto place = [&](const Block& block, Error error) {
    error.message =
        fmt::format("frame {} at byte {}: {}", frame.info.index, block.at, error.message);
    return at_path(file_.path(), std::move(error));
  };
  const FrameBlocks& blocks = frames_.blocks[position];
  auto depth = read_depth(blocks.depth);
  if (!depth) return place(blocks.depth, std::move(depth).error());
  frame.depth = std::move(*depth);
  if (!blocks.has_color) return frame;
  if (auto color = read_color_image(blocks.color, frame); !color)
    return place(blocks.color, std::move(color).error());
  return frame;
}

// ---- the sensor

Result<std::optional<std::string>> calibration_of(const MatroskaFile& file) {
  const std::string_view named = file.tag("K4A_CALIBRATION_FILE");
  const std::string_view name = named.empty() ? std::string_view("calibration.json") : named;
  for (const matroska::Attachment& attachment : file.attachments()) {
    if (attachment.name != name) continue;
    TURNSCAN_ASSIGN(std::string json, file.read(attachment));
    return std::optional<std::string>(std::move(json));
  }
  return std::optional<std::string>();
}

/// Both write the same files. Serial numbers of the Femto Bolt and Mega begin with CL, those of the
/// Azure Kinect are numeric.
std::string model_of(const MatroskaFile& file) {
  return file.tag("K4A_DEVICE_SERIAL_NUMBER").starts_with("CL") ? "orbbec-femto" : "azure-kinect";
}

struct Sensor {
  SensorInfo info;
  std::vector<Columns> covered;
};

Result<Sensor> sensor_of(const MatroskaFile& file, const Track& depth, const Track* color,
                         const ImportOptions& options, SequenceHeader& header) {
  Sensor out;
  out.info.model = model_of(file);
  TURNSCAN_ASSIGN(out.info.depth_unit_m, depth_scale(options, kMillimetre));
  if (!options.intrinsics.empty()) {
    TURNSCAN_ASSIGN(out.info.intrinsics, stated_intrinsics(options));
    out.info.intrinsics.width = depth.width;
    out.info.intrinsics.height = depth.height;
    TURNSCAN_TRY(out.info.intrinsics.check());
    if (color != nullptr)
      add_note(header, "colour was left out: with --intrinsics its camera is not known");
    return out;
  }
  TURNSCAN_ASSIGN(const auto json, calibration_of(file));
  if (!json)
    return fail_at(file.path().string(), ErrorCode::kMissingData,
                   "there is no calibration.json among its attachments; state the depth camera: "
                   "--intrinsics fx,fy,cx,cy");
  const ImageSize depth_size{depth.width, depth.height};
  std::optional<ImageSize> color_size;
  if (color != nullptr) color_size = ImageSize{color->width, color->height};
  auto cameras = parse_azure_kinect(*json, depth_size, color_size);
  if (!cameras)
    return fail_at(file.path().string(), cameras.error().code, "its calibration.json: {}",
                   cameras.error().message);
  out.info.intrinsics = cameras->depth;
  out.covered = covered_columns(cameras->depth, cameras->depth_radius);
  if (color == nullptr) return out;
  if (cameras->color) {
    out.info.color_intrinsics = cameras->color;
    out.info.T_color_sensor = cameras->T_color_depth;
  } else {
    add_note(header, fmt::format("colour was left out: its camera is not known for images of {} x "
                                 "{} pixels",
                                 color->width, color->height));
  }
  return out;
}

/// nullptr if the file has none that can be read.
const Track* color_track(const MatroskaFile& file, SequenceHeader& header) {
  const Track* track = track_named(file, "COLOR", "K4A_COLOR_TRACK");
  if (track == nullptr || track->blocks.empty()) return nullptr;
  const Packing packing = packing_of(*track);
  const bool known = packing == Packing::kJpeg || packing == Packing::kNv12 ||
                     packing == Packing::kYuy2 || packing == Packing::kBgra;
  if (known && !track->encoded) return track;
  add_note(header,
           fmt::format("colour was left out: its track is packed as {}", shown_codec(*track)));
  return nullptr;
}

// ---- the frames

constexpr double kMaxGap = 1.5;  // relative to the frame interval

/// As stated, else the median interval between frames; 0: there is only one.
double frame_time_of(const Track& track, const std::vector<Block>& blocks) {
  if (track.frame_time_ns > 0) return double(track.frame_time_ns);
  std::vector<std::int64_t> times;
  for (std::size_t i = 1; i < blocks.size(); ++i)
    times.push_back(blocks[i].time_ns - blocks[i - 1].time_ns);
  if (times.empty()) return 0.0;
  const auto middle = times.begin() + std::ptrdiff_t(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return double(*middle);
}

std::vector<Block> in_order(std::vector<Block> blocks) {
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const Block& a, const Block& b) { return a.time_ns < b.time_ns; });
  return blocks;
}

/// The number of frames missing before each one, limited to the number of frames plus a thousand; a
/// longer gap is a pause.
std::vector<std::uint32_t> missing_before(const std::vector<Block>& blocks, double frame_time_ns) {
  std::vector<std::uint32_t> out(blocks.size(), 0);
  double left = double(blocks.size()) + 1000.0;
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    const double gap = double(blocks[i].time_ns - blocks[i - 1].time_ns);
    if (!(frame_time_ns > 0.0) || gap <= kMaxGap * frame_time_ns) continue;
    const double count = std::round(gap / frame_time_ns) - 1.0;
    if (count > left) continue;
    left -= count;
    out[i] = static_cast<std::uint32_t>(count);
  }
  return out;
}

/// The nearest in time, within one frame interval.
void find_color(const std::vector<Block>& colors, double frame_time_ns, FrameBlocks& frame) {
  const auto after =
      std::lower_bound(colors.begin(), colors.end(), frame.depth.time_ns,
                       [](const Block& b, std::int64_t time) { return b.time_ns < time; });
  double best = std::max(frame_time_ns, 1.0);
  const auto offer = [&](const Block& b) {
    const double away = std::abs(double(b.time_ns) - double(frame.depth.time_ns));
    if (away >= best) return;
    best = away;
    frame.color = b;
    frame.has_color = true;
  };
  if (after != colors.begin()) offer(*std::prev(after));
  if (after != colors.end()) offer(*after);
}

Frames frames_of(const Track& depth, const Track* color, SequenceHeader& notes) {
  const std::vector<Block> blocks = in_order(depth.blocks);
  std::vector<Block> colors;
  if (color != nullptr) colors = in_order(color->blocks);
  const double frame_time = frame_time_of(depth, blocks);
  const std::vector<std::uint32_t> missing = missing_before(blocks, frame_time);
  Frames out;
  out.depth = packing_of(depth);
  if (color != nullptr) out.color = packing_of(*color);
  const auto add = [&](double time_ns, FrameStatus status, const FrameBlocks& frame) {
    FrameInfo info;
    info.index = static_cast<std::uint32_t>(out.infos.size());
    info.time_s = (time_ns - double(blocks[0].time_ns)) * 1e-9;
    info.status = status;
    out.infos.push_back(std::move(info));
    out.blocks.push_back(frame);
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::uint32_t k = 1; k <= missing[i]; ++k) {
      const double before = double(blocks[i - 1].time_ns), after = double(blocks[i].time_ns);
      add(before + (after - before) * k / (missing[i] + 1.0), FrameStatus::kDropped, {});
    }
    FrameBlocks frame{blocks[i], {}, false};
    find_color(colors, frame_time, frame);
    add(double(blocks[i].time_ns), FrameStatus::kOk, frame);
  }
  const std::size_t dropped = out.infos.size() - blocks.size();
  if (dropped > 0)
    add_note(notes,
             fmt::format("{} frames are missing by their times; they are marked dropped", dropped));
  return out;
}

std::string description(const MatroskaFile& file, const Track& depth, const Track* color) {
  std::string text = fmt::format("depth {} x {}", depth.width, depth.height);
  if (const auto mode = azure_kinect_depth_mode({depth.width, depth.height}); !mode.empty())
    text += fmt::format(" ({})", mode);
  if (depth.frame_time_ns > 0)
    text += fmt::format(", {:.3g} frames a second", 1e9 / double(depth.frame_time_ns));
  if (color != nullptr)
    text +=
        fmt::format(", colour {} x {} ({})", color->width, color->height, four_characters(*color));
  if (const auto serial = file.tag("K4A_DEVICE_SERIAL_NUMBER"); !serial.empty())
    text += fmt::format(", device {}", serial.substr(0, 40));
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

OpenResult open_matroska(const fs::path& path, const ImportOptions& options,
                         const RunContext& context) {
  TURNSCAN_ASSIGN(MatroskaFile file, MatroskaFile::open(path, context));
  auto found = depth_track(file);
  if (!found) return at_path(path, std::move(found).error());
  const Track& depth = **found;
  if (depth.blocks.empty())
    return fail_at(path.string(), ErrorCode::kTooFewPoints, "the depth track has no whole frame{}",
                   file.ended_early().empty() ? "" : ": " + file.ended_early());
  SequenceHeader header;
  header.source = fmt::format("Azure Kinect recording {}", display_name(path));
  const Track* color = color_track(file, header);
  add_note(header, description(file, depth, color));
  TURNSCAN_ASSIGN(Sensor sensor, sensor_of(file, depth, color, options, header));
  if (!sensor.info.color_intrinsics) color = nullptr;
  if (!options.depth_unit_m) add_note(header, "depth is in millimetres, as the format defines");
  if (!file.ended_early().empty())
    add_note(header, fmt::format("{}: the {} frames before that were taken", file.ended_early(),
                                 depth.blocks.size()));
  header.sensors.push_back(sensor.info);
  Frames frames = frames_of(depth, color, header);
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<MatroskaSequence>(std::move(file), std::move(header), std::move(frames),
                                            std::move(sensor.covered));
}

}  // namespace turnscan::importers
