// Intel RealSense through librealsense2, and .bag files of theirs.

#include <algorithm>
#include <librealsense2/rs.hpp>
#include <vector>

#include "../plugin_support.hpp"

namespace turnscan::plugin {
namespace {

bool says(const std::string& text, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return text.find(word) != std::string::npos; });
}

[[noreturn]] void throw_failure(const rs2::error& error) {
  const std::string why = error.what();
  if (says(why, {"ermission", "ccess"}))
    throw Failure{TURNSCAN_DENIED, "this user may not open the RealSense (" + why +
                                       "); install the udev rule of docs/reference/devices.md"};
  if (says(why, {"busy", "BUSY", "in use"}))
    throw Failure{TURNSCAN_BUSY,
                  "another program uses the RealSense (" + why + "); close that program"};
  if (says(why, {"No device", "not found", "resolve"}))
    throw Failure{
        TURNSCAN_NOT_FOUND,
        "no RealSense with such a serial number and mode is connected (" + why + "); plug it in"};
  if (says(why, {"disconnected"}))
    throw Failure{TURNSCAN_LOST, "the RealSense went away; check its cable"};
  throw Failure{TURNSCAN_FAILED, "librealsense2 failed (" + why + "); plug the sensor in again"};
}

turnscan_camera camera_of(const rs2_intrinsics& from) {
  // The inverse model takes image points to rays, ours takes rays to image points.
  const bool brown = from.model == RS2_DISTORTION_BROWN_CONRADY;
  const bool straight =
      std::all_of(std::begin(from.coeffs), std::end(from.coeffs), [](float c) { return c == 0; });
  if (!brown && !straight)
    throw Failure{TURNSCAN_UNSUPPORTED,
                  "this RealSense describes its lens in a way that turnscan does not use"};
  turnscan_camera camera{};
  camera.width = from.width;
  camera.height = from.height;
  camera.fx = from.fx;
  camera.fy = from.fy;
  camera.cx = from.ppx;
  camera.cy = from.ppy;
  std::copy(std::begin(from.coeffs), std::end(from.coeffs), camera.distortion);
  return camera;
}

int number_of(const std::string& text, const char* name) {
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || value > 100000)
      throw Failure{TURNSCAN_BAD_PARAMETER, std::string(name) + " = " + text + " is no number"};
    value = 10 * value + (c - '0');
  }
  return value;
}

}  // namespace
}  // namespace turnscan::plugin

struct turnscan_device {
 public:
  turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                  std::int32_t count);
  ~turnscan_device() { stop(); }
  turnscan_device(const turnscan_device&) = delete;
  turnscan_device& operator=(const turnscan_device&) = delete;

  void describe(turnscan_device_info& info) const;
  void start();
  void stop();
  std::int32_t grab(double timeout_s, turnscan_frame& frame);

 private:
  bool with_color_, file_ = false, started_ = false;
  rs2::config config_;
  rs2::pipeline pipeline_;
  rs2::pipeline_profile profile_;
  rs2::frameset frames_;  ///< what the last frame's pointers name
};

turnscan_device::turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                                 std::int32_t count)
    : with_color_(turnscan::plugin::flag_of(parameters, count, "color", false)) {
  using namespace turnscan::plugin;
  const int width = number_of(value_of(parameters, count, "width", "0"), "width");
  const int height = number_of(value_of(parameters, count, "height", "0"), "height");
  const int fps = number_of(value_of(parameters, count, "fps", "0"), "fps");
  try {
    file_ = address.ends_with(".bag");
    if (file_)
      config_.enable_device_from_file(address, false);
    else if (!address.empty())
      config_.enable_device(address);
    config_.enable_stream(RS2_STREAM_DEPTH, width, height, RS2_FORMAT_Z16, fps);
    if (with_color_) config_.enable_stream(RS2_STREAM_COLOR, 0, 0, RS2_FORMAT_RGB8, fps);
    profile_ = config_.resolve(std::shared_ptr<rs2_pipeline>(pipeline_));
    if (file_) profile_.get_device().as<rs2::playback>().set_real_time(false);
  } catch (const rs2::error& error) {
    throw_failure(error);
  }
}

void turnscan_device::describe(turnscan_device_info& info) const {
  using namespace turnscan::plugin;
  const rs2::device device = profile_.get_device();
  put_text(info.model, device.get_info(RS2_CAMERA_INFO_NAME));
  put_text(info.serial, device.get_info(RS2_CAMERA_INFO_SERIAL_NUMBER));
  const auto depth = profile_.get_stream(RS2_STREAM_DEPTH).as<rs2::video_stream_profile>();
  info.camera = camera_of(depth.get_intrinsics());
  info.depth_kind = TURNSCAN_DEPTH_STEPS;
  info.depth_unit_m = device.first<rs2::depth_sensor>().get_depth_scale();
  info.fps = depth.fps();
  info.live = file_ ? 0 : 1;
  if (!with_color_) return;
  const auto color = profile_.get_stream(RS2_STREAM_COLOR).as<rs2::video_stream_profile>();
  info.color_kind = TURNSCAN_COLOR_OWN;
  info.color_camera = camera_of(color.get_intrinsics());
  const rs2_extrinsics pose = depth.get_extrinsics_to(color);
  for (int row = 0; row < 3; ++row) {
    // Its rotation stands column by column.
    for (int column = 0; column < 3; ++column)
      info.T_color_depth[4 * row + column] = pose.rotation[3 * column + row];
    info.T_color_depth[4 * row + 3] = pose.translation[row];
  }
}

void turnscan_device::start() {
  if (started_) return;
  try {
    profile_ = pipeline_.start(config_);
  } catch (const rs2::error& error) {
    turnscan::plugin::throw_failure(error);
  }
  started_ = true;
}

void turnscan_device::stop() {
  if (!started_) return;
  frames_ = rs2::frameset();
  started_ = false;
  try {
    pipeline_.stop();
  } catch (const rs2::error&) {
    return;  // it is gone, and so is what there was to stop
  }
}

std::int32_t turnscan_device::grab(double timeout_s, turnscan_frame& frame) {
  try {
    const auto timeout_ms = static_cast<unsigned>(std::max(1.0, 1e3 * timeout_s));
    if (!pipeline_.try_wait_for_frames(&frames_, timeout_ms)) {
      const bool over = file_ && profile_.get_device().as<rs2::playback>().current_status() ==
                                     RS2_PLAYBACK_STATUS_STOPPED;
      return over ? TURNSCAN_END : TURNSCAN_NOTHING;
    }
    const rs2::depth_frame depth = frames_.get_depth_frame();
    if (!depth) return TURNSCAN_NOTHING;
    frame = {};
    frame.depth = depth.get_data();
    frame.width = depth.get_width();
    frame.height = depth.get_height();
    frame.time_s = 1e-3 * depth.get_timestamp();
    frame.number = depth.get_frame_number();
    if (const rs2::video_frame color = frames_.get_color_frame(); with_color_ && color) {
      frame.color = static_cast<const std::uint8_t*>(color.get_data());
      frame.color_width = color.get_width();
      frame.color_height = color.get_height();
    }
    return TURNSCAN_OK;
  } catch (const rs2::error& error) {
    turnscan::plugin::throw_failure(error);
  }
}

namespace turnscan::plugin {
namespace {

std::vector<turnscan_device_entry> find_devices() {
  const rs2::context context;
  std::vector<turnscan_device_entry> found;
  for (const rs2::device device : context.query_devices())
    found.push_back(device_entry(device.get_info(RS2_CAMERA_INFO_NAME),
                                 device.get_info(RS2_CAMERA_INFO_SERIAL_NUMBER), found.size()));
  return found;
}

constexpr turnscan_parameter_info kParameters[] = {
    {"color", "Also take colours, from a camera of their own: 0 or 1", "0"},
    {"width", "Of the depth images in pixels; 0: the sensor's choice", "0"},
    {"height", "Of the depth images in pixels; 0: the sensor's choice", "0"},
    {"fps", "Frames a second; 0: the sensor's choice", "0"}};

constexpr turnscan_plugin kPlugin = plugin_of<turnscan_device, find_devices>(
    "realsense", "Intel RealSense, .bag files (librealsense2)", kParameters);

}  // namespace
}  // namespace turnscan::plugin

TURNSCAN_EXPORT_PLUGIN(kPlugin)
