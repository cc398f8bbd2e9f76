#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>
#include <turnscan/core/spread.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/iai_kinect2.hpp>
#include <turnscan/io/import/importers_common.hpp>

namespace turnscan::importers {

namespace {

/// Images of other programs mark missing depth with 0 or 65535; only turnscan's own crop writes
/// 65535 for "a return, but outside".
Result<DepthImage> read_foreign_depth(const std::filesystem::path& path,
                                      const DepthFileOptions& options) {
  TURNSCAN_ASSIGN(DepthFile file, read_depth_file(path, options));
  std::replace(file.image.pixels.begin(), file.image.pixels.end(), kOutsideCrop, kNoReturn);
  return std::move(file.image);
}

Result<> read_scan(const std::filesystem::path& path, const Eigen::Matrix3d& scan_to_sensor,
                   Frame& frame) {
  TURNSCAN_ASSIGN(CloudFile file, read_cloud(path));
  frame.points = std::move(file.cloud);
  for (Vec3f& p : frame.points.points) p = (scan_to_sensor * p.cast<double>()).cast<float>();
  for (Vec3f& n : frame.points.normals)
    n = (scan_to_sensor * n.cast<double>()).stableNormalized().cast<float>();
  frame.points.frame.clear();
  frame.grid_width = file.grid_width;
  frame.grid_height = file.grid_height;
  frame.grid = std::move(file.grid);
  return {};
}

template <class Image>
Result<> check_size(const Image& image, const CameraIntrinsics& camera,
                    const std::filesystem::path& path) {
  if (image.width == camera.width && image.height == camera.height) return {};
  return fail_at(path.string(), ErrorCode::kFormat,
                 "the image has {} x {} pixels, but its camera has {} x {}", image.width,
                 image.height, camera.width, camera.height);
}

/// Where no mask is white, nothing is known: another object may stand before this one.
Result<> keep_masked(const std::vector<std::filesystem::path>& masks, DepthImage& depth) {
  if (masks.empty()) return {};
  std::vector<char> kept(depth.pixels.size(), 0);
  for (const std::filesystem::path& path : masks) {
    TURNSCAN_ASSIGN(const ColorImage mask, read_color(path));
    if (mask.width != depth.width || mask.height != depth.height)
      return fail_at(path.string(), ErrorCode::kFormat,
                     "the mask has {} x {} pixels, its depth image {} x {}", mask.width,
                     mask.height, depth.width, depth.height);
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (mask.pixels[i].g > 0) kept[i] = 1;
  }
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i] == 0) depth.pixels[i] = kNoReturn;
  return {};
}

std::vector<ForeignFrame>::const_iterator first_colored(const std::vector<ForeignFrame>& frames) {
  return std::find_if(frames.begin(), frames.end(),
                      [](const ForeignFrame& f) { return !f.color.empty(); });
}

}  // namespace

ForeignSequence::ForeignSequence(SequenceHeader header, const std::vector<ForeignFrame>& frames,
                                 const Eigen::Matrix3d& scan_to_sensor,
                                 const DepthFileOptions& depth_files)
    : header_(std::move(header)), scan_to_sensor_(scan_to_sensor), depth_files_(depth_files) {
  header_.software = fmt::format("turnscan {}", version());
  for (const ForeignFrame& frame : frames) {
    frames_.push_back(frame.info);
    files_.push_back({frame.data, frame.color, frame.masks});
  }
  if (header_.sensors.size() != 1 || header_.sensors[0].kind == SensorKind::kPointScanner) return;
  steps_ = steps_of_sensor();
  if (steps_ == 1) return;
  double& unit_m = header_.sensors[0].depth_unit_m;
  unit_m *= steps_;
  add_note(header_, fmt::format("every depth is a multiple of {} steps: the sensor's are {}",
                                steps_, format_quantity(unit_m, Quantity::kLength)));
}

std::uint16_t ForeignSequence::steps_of_sensor() const {
  // That so many different values are even by chance has a probability of 2^-30.
  constexpr std::size_t kSurely = 30;
  std::set<std::uint16_t> values;
  unsigned divisor = 0;
  for (const std::size_t i : evenly_spread(files_.size(), 3)) {
    const auto image = frames_[i].status == FrameStatus::kDropped
                           ? Result<DepthImage>()
                           : read_foreign_depth(files_[i].data, depth_files_);
    if (!image) continue;  // told when the frame is read
    for (const std::uint16_t value : image->pixels) {
      divisor = std::gcd(divisor, unsigned(value));
      if (divisor == 1) return 1;
      if (value != kNoReturn && values.size() < kSurely) values.insert(value);
    }
  }
  return values.size() < kSurely ? 1 : std::uint16_t(divisor);
}

Result<Frame> ForeignSequence::read(std::size_t position) const {
  if (position >= frames_.size())
    throw std::invalid_argument(fmt::format("import: there is no frame {}", position));
  const Files& files = files_[position];
  Frame frame;
  frame.info = frames_[position];
  if (frame.info.status == FrameStatus::kDropped)
    return fail(ErrorCode::kMissingData, "frame {} was dropped", frame.info.index);
  const SensorInfo& sensor = header_.sensors[frame.info.sensor];
  if (sensor.kind == SensorKind::kPointScanner) {
    TURNSCAN_TRY(read_scan(files.data, scan_to_sensor_, frame));
    return frame;
  }
  TURNSCAN_ASSIGN(frame.depth, read_foreign_depth(files.data, depth_files_));
  TURNSCAN_TRY(check_size(frame.depth, sensor.intrinsics, files.data));
  if (steps_ > 1)
    for (std::uint16_t& value : frame.depth.pixels)
      value = std::uint16_t((value + steps_ / 2U) / steps_);
  TURNSCAN_TRY(keep_masked(files.masks, frame.depth));
  if (files.color.empty()) return frame;
  TURNSCAN_TRY(read_frame_color(files.color, frame));
  TURNSCAN_TRY(
      check_size(frame.color, sensor.color_intrinsics.value_or(sensor.intrinsics), files.color));
  return frame;
}

Result<> apply_iai_kinect2(const ImportOptions& options, const std::vector<ForeignFrame>& frames,
                           SequenceHeader& header) {
  if (options.iai_kinect2.empty() || frames.empty()) return {};
  TURNSCAN_ASSIGN(const Kinect2Calibration kinect, read_iai_kinect2(options.iai_kinect2));
  SensorInfo& sensor = header.sensors.front();
  if (kinect.depth) sensor.depth_bias_m = kinect.depth->bias_m;
  if (!kinect.camera) return {};
  const CameraCorrection& camera = *kinect.camera;
  TURNSCAN_ASSIGN(const DepthImage depth, read_depth_png(frames.front().data));
  if (depth.width != camera.intrinsics.width || depth.height != camera.intrinsics.height)
    return fail_at(frames.front().data.string(), ErrorCode::kInvalidOption,
                   "the image has {} x {} pixels, but a Kinect v2 of --iai-kinect2 {} x {}",
                   depth.width, depth.height, camera.intrinsics.width, camera.intrinsics.height);
  sensor.intrinsics = camera.intrinsics;
  const auto colored = first_colored(frames);
  if (!camera.color_intrinsics || colored == frames.end()) return {};
  TURNSCAN_ASSIGN(const ColorImage color, read_color(colored->color));
  if (color.width != camera.color_intrinsics->width ||
      color.height != camera.color_intrinsics->height)
    return {};
  sensor.color_intrinsics = camera.color_intrinsics;
  sensor.T_color_sensor = camera.T_color_sensor;
  return {};
}

Result<> look_at_first_images(SequenceHeader& header, std::vector<ForeignFrame>& frames) {
  SensorInfo& sensor = header.sensors.front();
  CameraIntrinsics& camera = sensor.intrinsics;
  if (frames.empty()) return fail(ErrorCode::kTooFewPoints, "import: the data set has no frames");
  if (camera.width == 0) {
    TURNSCAN_ASSIGN(const DepthImage depth, read_depth_png(frames.front().data));
    camera.width = depth.width;
    camera.height = depth.height;
  }
  TURNSCAN_TRY(camera.check());
  const auto colored = first_colored(frames);
  if (colored == frames.end() || sensor.color_intrinsics) return {};
  TURNSCAN_ASSIGN(const ColorImage color, read_color(colored->color));
  if (color.width == camera.width && color.height == camera.height) return {};
  for (ForeignFrame& frame : frames) frame.color.clear();
  add_note(header, fmt::format("the colour images ({} x {}) are not registered to depth and their "
                               "camera is not known: colour was left out",
                               color.width, color.height));
  return {};
}

}  // namespace turnscan::importers
