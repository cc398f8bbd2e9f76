// Imports ScanNet's and SUN3D's .sens (io/sens/sens_file.hpp), and what ElasticFusion's Logger2
// writes (io/sens/klg_file.hpp). The extrinsics of a .sens's depth and colour map depth points to
// the colour camera; poses are those of the base frame, camera to world.

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <turnscan/core/version.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers_capture.hpp>
#include <turnscan/io/sens/klg_file.hpp>
#include <turnscan/io/sens/sens_file.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

constexpr double kKlgUnit_m = 1e-3;

struct SensFrame {
  FrameInfo info;
  sens::FramePlace place;
};

Eigen::Matrix4d matrix_of(const sens::Matrix& rows) {
  return Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(rows.data()).cast<double>();
}

CameraIntrinsics camera_of_sens(const sens::Matrix& m, std::uint32_t width, std::uint32_t height) {
  CameraIntrinsics camera;
  camera.width = int(width);
  camera.height = int(height);
  camera.fx = double(m[0]);
  camera.fy = double(m[5]);
  camera.cx = double(m[2]);
  camera.cy = double(m[6]);
  return camera;
}

class SensSequence : public FrameSequence {
 public:
  SensSequence(SequenceHeader header, file::RandomAccessFile file, sens::Header sens,
               std::vector<SensFrame> frames)
      : header_(std::move(header)), file_(std::move(file)), sens_(std::move(sens)) {
    header_.software = fmt::format("turnscan {}", version());
    for (SensFrame& frame : frames) {
      infos_.push_back(std::move(frame.info));
      places_.push_back(frame.place);
    }
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return infos_; }

  Result<Frame> read(std::size_t position) const override {
    const sens::FramePlace& place = places_.at(position);
    Frame frame;
    frame.info = infos_[position];
    if (frame.info.status == FrameStatus::kDropped)
      return fail(ErrorCode::kMissingData, "frame {} was dropped", frame.info.index);
    TURNSCAN_ASSIGN(frame.depth.pixels, sens::read_depth(file_, sens_, place));
    frame.depth.width = int(sens_.depth_width);
    frame.depth.height = int(sens_.depth_height);
    std::replace(frame.depth.pixels.begin(), frame.depth.pixels.end(), kOutsideCrop, kNoReturn);
    if (place.color_bytes == 0 || !header_.sensors.front().color_intrinsics) return frame;
    TURNSCAN_TRY(read_color(place, frame));
    return frame;
  }

 private:
  Result<> read_color(const sens::FramePlace& place, Frame& frame) const {
    TURNSCAN_ASSIGN(const std::string bytes, file_.read(place.color_at, place.color_bytes));
    if (sens_.color_packing == sens::ColorPacking::kRaw) {
      TURNSCAN_ASSIGN(frame.color, raw_color(bytes, place.color_at));
      return {};
    }
    if (auto good = decode_frame_color(bytes, frame); !good)
      return at_path(file_.path(), std::move(good).error());
    if (sens_.jpeg_is_bgr) {
      for (Rgb& pixel : frame.color.pixels) std::swap(pixel.r, pixel.b);
      frame.color_jpeg.clear();  // others would show it with its colours exchanged
    }
    const ColorImage& image = frame.color;
    if (image.width == int(sens_.color_width) && image.height == int(sens_.color_height)) return {};
    return fail_at(file_.path().string(), ErrorCode::kFormat,
                   "the colour image at byte {} has {} x {} pixels, but the header says {} x {}",
                   place.color_at, image.width, image.height, sens_.color_width,
                   sens_.color_height);
  }

  Result<ColorImage> raw_color(const std::string& bytes, std::uint64_t at) const {
    const std::size_t pixels = std::size_t(sens_.color_width) * sens_.color_height;
    if (bytes.size() != 3 * pixels)
      return fail_at(file_.path().string(), ErrorCode::kFormat,
                     "the colour image at byte {} has {} bytes, not {}", at, bytes.size(),
                     3 * pixels);
    ColorImage image(int(sens_.color_width), int(sens_.color_height));
    for (std::size_t i = 0; i < pixels; ++i)
      image.pixels[i] = {std::uint8_t(bytes[3 * i]), std::uint8_t(bytes[3 * i + 1]),
                         std::uint8_t(bytes[3 * i + 2])};
    return image;
  }

  SequenceHeader header_;
  file::RandomAccessFile file_;
  sens::Header sens_;
  std::vector<FrameInfo> infos_;
  std::vector<sens::FramePlace> places_;
};

/// Identity if the file has none (zeros).
Result<Pose> extrinsics_of(const sens::Matrix& rows, const char* name) {
  if (std::all_of(rows.begin(), rows.end(), [](float v) { return v == 0.0f; }))
    return Pose::Identity();
  const auto pose = pose_from(matrix_of(rows));
  if (!pose)
    return fail(ErrorCode::kFormat, "the extrinsics of {} are no pose: {}", name,
                pose.error().message);
  return *pose;
}

/// Sets sensor.T_color_sensor, and returns T_base_depth.
Result<Pose> describe_cameras(const sens::Header& sens, SensorInfo& sensor) {
  sensor.model = sens.sensor_name;
  sensor.depth_unit_m = 1.0 / double(sens.depth_shift);
  sensor.intrinsics = camera_of_sens(sens.depth_intrinsics, sens.depth_width, sens.depth_height);
  TURNSCAN_TRY(sensor.intrinsics.check());
  TURNSCAN_ASSIGN(const Pose T_base_depth, extrinsics_of(sens.depth_extrinsics, "depth"));
  TURNSCAN_ASSIGN(const Pose T_base_color, extrinsics_of(sens.color_extrinsics, "colour"));
  if (sens.color_packing == sens::ColorPacking::kUnknown || sens.color_width == 0 ||
      sens.color_height == 0)
    return T_base_depth;
  const CameraIntrinsics color =
      camera_of_sens(sens.color_intrinsics, sens.color_width, sens.color_height);
  TURNSCAN_TRY(color.check());
  sensor.color_intrinsics = color;
  sensor.T_color_sensor = T_base_color.inverse() * T_base_depth;
  return T_base_depth;
}

std::optional<Pose> pose_of(const sens::Matrix& rows, const Pose& T_base_depth) {
  const auto pose = pose_from(matrix_of(rows));
  if (!pose) return std::nullopt;
  return Pose(*pose * T_base_depth);
}

/// Times of depth if present, else of colour. Microseconds.
std::vector<double> times_of(const std::vector<sens::FramePlace>& places) {
  std::vector<double> times;
  const bool depth_timed =
      std::any_of(places.begin(), places.end(), [](const auto& p) { return p.depth_time_us != 0; });
  const std::uint64_t first = places.empty() ? 0
                              : depth_timed  ? places.front().depth_time_us
                                             : places.front().color_time_us;
  for (const sens::FramePlace& p : places) {
    const std::uint64_t time = depth_timed ? p.depth_time_us : p.color_time_us;
    times.push_back(time >= first ? double(time - first) * 1e-6 : -1.0);
  }
  return times;
}

Result<std::vector<SensFrame>> place_frames(const std::vector<sens::FramePlace>& places,
                                            const Pose& T_base_depth, const ImportOptions& options,
                                            SequenceHeader& header) {
  std::vector<double> times = times_of(places);
  const bool timed = times_from_first(times);
  if (!timed) add_note(header, "there are no times of the frames that increase");
  std::vector<std::optional<Pose>> poses;
  for (const sens::FramePlace& p : places)
    poses.push_back(pose_of(p.camera_to_world, T_base_depth));
  TURNSCAN_TRY(settle_device_poses(options, poses, header));
  std::vector<SensFrame> frames;
  for (std::size_t i = 0; i < places.size(); ++i) {
    SensFrame& frame = frames.emplace_back();
    frame.place = places[i];
    frame.info.index = std::uint32_t(i);
    if (timed) frame.info.time_s = times[i];
    frame.info.T_table_sensor = poses[i];
  }
  if (timed) frames = with_dropped(std::move(frames), header);
  drop_without_pose(frames, header);
  return frames;
}

}  // namespace

OpenResult open_sens(const fs::path& path, const ImportOptions& options,
                     const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format(".sens recording {}", display_name(path));
  TURNSCAN_ASSIGN(file::RandomAccessFile file, file::RandomAccessFile::open(path));
  TURNSCAN_ASSIGN(sens::Index index, sens::read_index(file, context));
  if (index.frames.empty())
    return fail_at(path.string(), ErrorCode::kTooFewPoints,
                   "the file has no whole frame, of {} that its header states",
                   index.header.frame_count);
  SensorInfo sensor;
  const auto T_base_depth = describe_cameras(index.header, sensor);
  if (!T_base_depth) return at_path(path, T_base_depth.error());
  header.sensors.push_back(std::move(sensor));
  if (index.frames.size() < index.header.frame_count)
    add_note(header, fmt::format("the file is cut off: its first {} frames of {} are whole and "
                                 "were taken",
                                 index.frames.size(), index.header.frame_count));
  TURNSCAN_ASSIGN(std::vector<SensFrame> frames,
                  place_frames(index.frames, *T_base_depth, options, header));
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<SensSequence>(std::move(header), std::move(file), std::move(index.header),
                                        std::move(frames));
}

OpenResult open_klg(const fs::path& path, const ImportOptions& options, const RunContext& context) {
  SequenceHeader header;
  header.source = fmt::format("Logger2 recording {}", display_name(path));
  TURNSCAN_ASSIGN(file::RandomAccessFile file, file::RandomAccessFile::open(path));
  auto read = sens::read_klg_index(file, context);
  if (!read) return at_path(path, read.error());
  sens::Index& index = *read;
  if (options.intrinsics.empty())
    return fail_at(path.string(), ErrorCode::kMissingData,
                   "the file does not say the intrinsics of its camera; state them: --intrinsics "
                   "fx,fy,cx,cy (ElasticFusion takes 528,528,320,240 for 640 x 480 pixels)");
  SensorInfo& sensor = header.sensors.emplace_back();
  TURNSCAN_ASSIGN(sensor.intrinsics, stated_intrinsics(options));
  sensor.intrinsics.width = int(index.header.depth_width);
  sensor.intrinsics.height = int(index.header.depth_height);
  TURNSCAN_TRY(sensor.intrinsics.check());
  TURNSCAN_ASSIGN(sensor.depth_unit_m, depth_scale(options, kKlgUnit_m));
  if (index.header.color_packing != sens::ColorPacking::kUnknown)
    sensor.color_intrinsics = sensor.intrinsics;
  if (index.frames.size() < index.header.frame_count)
    add_note(header, fmt::format("the file is cut off: its first {} frames of {} are whole and "
                                 "were taken",
                                 index.frames.size(), index.header.frame_count));
  std::vector<double> times = times_of(index.frames);
  const bool timed = times_from_first(times);
  if (!timed) add_note(header, "there are no times of the frames that increase");
  std::vector<SensFrame> frames;
  for (std::size_t i = 0; i < index.frames.size(); ++i) {
    SensFrame& frame = frames.emplace_back();
    frame.place = index.frames[i];
    frame.info.index = std::uint32_t(i);
    if (timed) frame.info.time_s = times[i];
  }
  if (timed) frames = with_dropped(std::move(frames), header);
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  return std::make_unique<SensSequence>(std::move(header), std::move(file), std::move(index.header),
                                        std::move(frames));
}

}  // namespace turnscan::importers
