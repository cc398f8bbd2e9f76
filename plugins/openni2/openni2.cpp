// Depth sensors with an OpenNI 2 driver (PrimeSense, Asus Xtion, Orbbec Astra), and .oni files.

#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <system_error>

#include "openni2_library.hpp"

namespace turnscan::plugin {
namespace {

constexpr double kMicrosecond = 1e-6;

double number_of(const std::string& text, const char* name, double low, double high) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high))
    throw Failure{TURNSCAN_BAD_PARAMETER, std::string(name) + " = " + text + " is no number from " +
                                              std::to_string(static_cast<int>(low)) + " to " +
                                              std::to_string(static_cast<int>(high))};
  return value;
}

bool is_depth(openni::PixelFormat format) {
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

std::string mode_text(const openni::VideoMode& mode) {
  return std::to_string(mode.getResolutionX()) + "x" + std::to_string(mode.getResolutionY()) + "@" +
         std::to_string(mode.getFps());
}

class Sensor {
 public:
  Sensor(const std::string& address, const turnscan_parameter* parameters, std::int32_t count);

  void describe(turnscan_device_info& info);
  void start();
  void stop();
  std::int32_t grab(double timeout_s, turnscan_frame& frame);

 private:
  void open(const std::string& address);
  void choose_mode(const std::string& wish);
  void choose_color();
  void play_file();
  void check_connected() const;
  bool wait(double timeout_s);
  bool read_depth();
  void read_color();
  void read_waiting_color();

  Device device_;
  std::unique_ptr<Disconnects> disconnects_;
  Stream depth_, color_;
  openni::VideoMode mode_;
  openni::VideoFrameRef depth_frame_, color_frame_;
  std::vector<std::uint16_t> depth_pixels_;
  std::vector<std::uint8_t> color_pixels_;
  std::string model_, serial_;
  std::optional<double> hfov_rad_;
  bool with_color_, file_ = false, as_fast_as_possible_, started_ = false;
  std::uint64_t frame_count_ = 0, frames_read_ = 0;
};

Sensor::Sensor(const std::string& address, const turnscan_parameter* parameters, std::int32_t count)
    : with_color_(flag_of(parameters, count, "color", false)) {
  const std::string hfov = value_of(parameters, count, "hfov", "");
  if (!hfov.empty()) hfov_rad_ = number_of(hfov, "hfov", 1, 179) * std::numbers::pi / 180.0;
  const std::string speed = value_of(parameters, count, "speed", "max");
  if (speed != "max" && speed != "1")
    throw Failure{TURNSCAN_BAD_PARAMETER, "speed = " + speed + " is neither 1 nor max"};
  as_fast_as_possible_ = speed == "max";
  start_library();
  open(address);
  if (!device_.device.hasSensor(openni::SENSOR_DEPTH) ||
      depth_.stream.create(device_.device, openni::SENSOR_DEPTH) != openni::STATUS_OK)
    throw Failure{TURNSCAN_UNSUPPORTED, "the device has no depth sensor; use another one"};
  choose_mode(value_of(parameters, count, "mode", ""));
  if (with_color_) choose_color();
  if (file_) play_file();
}

void Sensor::open(const std::string& address) {
  // The library would open a pipe, and wait for its writer without end.
  std::error_code error;
  const auto status = std::filesystem::status(address, error);
  if (!address.empty() && std::filesystem::exists(status) &&
      !std::filesystem::is_regular_file(status))
    throw Failure{TURNSCAN_NOT_FOUND, address + " is no file; give an .oni file or a device"};
  const char* uri = address.empty() ? openni::ANY_DEVICE : address.c_str();
  if (device_.device.open(uri) != openni::STATUS_OK) throw open_failure(last_error());
  file_ = device_.device.isFile();
  const openni::DeviceInfo& info = device_.device.getDeviceInfo();
  model_ = file_ ? "oni-file" : info.getName();
  if (model_.empty()) model_ = "openni2";
  disconnects_ = std::make_unique<Disconnects>(info.getUri());
  char serial[64] = {};
  int size = sizeof serial - 1;
  if (!file_ && device_.device.getProperty(ONI_DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size) ==
                    openni::STATUS_OK)
    serial_ = serial;
}

/// The mode that is set, or the one that the user names; in tenths of a millimetre where the sensor
/// offers them.
void Sensor::choose_mode(const std::string& wish) {
  mode_ = depth_.stream.getVideoMode();
  const std::string want = wish.empty() ? mode_text(mode_) : wish;
  std::string known;
  std::optional<openni::VideoMode> best;
  const auto& modes = depth_.stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    if (!is_depth(modes[i].getPixelFormat())) continue;
    const std::string text = mode_text(modes[i]);
    if (known.find(text) == std::string::npos) known += (known.empty() ? "" : ", ") + text;
    if (text == want && (!best || modes[i].getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM))
      best = modes[i];
  }
  if (!wish.empty() && (!best || file_))
    throw Failure{TURNSCAN_BAD_PARAMETER,
                  "mode = " + wish + " is none of the sensor's modes; use one of " + known};
  if (!file_ && best && depth_.stream.setVideoMode(*best) == openni::STATUS_OK)
    mode_ = depth_.stream.getVideoMode();
  if (!is_depth(mode_.getPixelFormat()))
    throw Failure{TURNSCAN_UNSUPPORTED,
                  "the sensor's depth comes in a format that turnscan does not read"};
  if (!file_) depth_.stream.setMirroringEnabled(false);
}

/// Colour that the sensor itself lays on the depth image, of the same size; else none.
void Sensor::choose_color() {
  with_color_ = false;
  if (file_ || !device_.device.hasSensor(openni::SENSOR_COLOR) ||
      !device_.device.isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR) ||
      color_.stream.create(device_.device, openni::SENSOR_COLOR) != openni::STATUS_OK)
    throw Failure{TURNSCAN_UNSUPPORTED,
                  "the sensor has no colour that lies on its depth; leave out color=1"};
  openni::VideoMode mode = color_.stream.getVideoMode();
  mode.setPixelFormat(openni::PIXEL_FORMAT_RGB888);
  mode.setResolution(mode_.getResolutionX(), mode_.getResolutionY());
  if (color_.stream.setVideoMode(mode) != openni::STATUS_OK ||
      device_.device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR) !=
          openni::STATUS_OK)
    throw Failure{TURNSCAN_UNSUPPORTED, "the sensor has no colour of " + mode_text(mode_) +
                                            "; leave out color=1 or choose another mode"};
  color_.stream.setMirroringEnabled(false);
  device_.device.setDepthColorSyncEnabled(true);
  with_color_ = true;
}

void Sensor::play_file() {
  openni::PlaybackControl* control = device_.device.getPlaybackControl();
  if (control == nullptr)
    throw Failure{TURNSCAN_FAILED, "the file cannot be played; record it again"};
  control->setRepeatEnabled(false);
  control->setSpeed(as_fast_as_possible_ ? -1.0F : 1.0F);
  const int count = control->getNumberOfFrames(depth_.stream);
  frame_count_ = count > 0 ? static_cast<std::uint64_t>(count) : 0;
}

void Sensor::describe(turnscan_device_info& info) {
  put_text(info.model, model_);
  put_text(info.serial, serial_);
  turnscan_camera& camera = info.camera;
  camera.width = mode_.getResolutionX();
  camera.height = mode_.getResolutionY();
  const double hfov = hfov_rad_.value_or(depth_.stream.getHorizontalFieldOfView());
  const double vfov = hfov_rad_ ? 0.0 : depth_.stream.getVerticalFieldOfView();
  if (!(hfov > 0.01 && hfov < 3.1))
    throw Failure{TURNSCAN_UNSUPPORTED,
                  "the driver does not say how wide the sensor sees; give hfov=DEGREES"};
  camera.fx = 0.5 * camera.width / std::tan(0.5 * hfov);
  camera.fy = vfov > 0.01 && vfov < 3.1 ? 0.5 * camera.height / std::tan(0.5 * vfov) : camera.fx;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  info.depth_kind = TURNSCAN_DEPTH_STEPS;
  info.depth_unit_m = mode_.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? 1e-4 : 1e-3;
  info.fps = mode_.getFps();
  info.color_kind = with_color_ ? TURNSCAN_COLOR_REGISTERED : TURNSCAN_COLOR_NONE;
  info.live = file_ && as_fast_as_possible_ ? 0 : 1;
  info.frame_count = frame_count_;
}

void Sensor::start() {
  if (started_) return;
  if (depth_.stream.start() != openni::STATUS_OK) throw open_failure(last_error());
  started_ = depth_.was_started = color_.was_started = true;
  if (with_color_ && color_.stream.start() != openni::STATUS_OK) throw open_failure(last_error());
}

void Sensor::stop() {
  if (!started_) return;
  depth_frame_.release();
  color_frame_.release();
  if (with_color_) color_.stream.stop();
  depth_.stream.stop();
  started_ = false;
}

void Sensor::check_connected() const {
  if (disconnects_->gone())
    throw Failure{TURNSCAN_LOST, "the sensor went away; check the cable and the power supply"};
}

/// Whether there is a frame of depth; takes in colour on the way.
bool Sensor::wait(double timeout_s) {
  openni::VideoStream* streams[2] = {&depth_.stream, &color_.stream};
  int ready = -1;
  const auto status = openni::OpenNI::waitForAnyStream(
      streams, with_color_ ? 2 : 1, &ready, std::max(1, static_cast<int>(timeout_s * 1e3)));
  if (status == openni::STATUS_TIME_OUT) return false;
  if (status != openni::STATUS_OK) {
    check_connected();
    throw Failure{TURNSCAN_LOST, "the sensor stopped (" + last_error() + "); check the cable"};
  }
  if (ready == 1) {
    read_color();
    return false;
  }
  return true;
}

void Sensor::read_color() {
  if (color_.stream.readFrame(&color_frame_) != openni::STATUS_OK || !color_frame_.isValid())
    return;
  const int row = 3 * color_frame_.getWidth();
  color_pixels_.resize(static_cast<std::size_t>(row) *
                       static_cast<std::size_t>(color_frame_.getHeight()));
  const auto* from = static_cast<const std::uint8_t*>(color_frame_.getData());
  for (int y = 0; y < color_frame_.getHeight(); ++y)
    std::memcpy(color_pixels_.data() + std::ptrdiff_t(y) * row,
                from + std::ptrdiff_t(y) * color_frame_.getStrideInBytes(),
                static_cast<std::size_t>(row));
}

/// Colours that came with the depth: of two streams that are ready only the first is told.
void Sensor::read_waiting_color() {
  openni::VideoStream* stream = &color_.stream;
  int ready = -1;
  if (with_color_ && openni::OpenNI::waitForAnyStream(&stream, 1, &ready, 0) == openni::STATUS_OK)
    read_color();
}

bool Sensor::read_depth() {
  if (depth_.stream.readFrame(&depth_frame_) != openni::STATUS_OK || !depth_frame_.isValid()) {
    check_connected();
    return false;
  }
  const auto width = static_cast<std::size_t>(depth_frame_.getWidth());
  const auto height = static_cast<std::size_t>(depth_frame_.getHeight());
  depth_pixels_.resize(width * height);
  const auto* from = static_cast<const std::uint8_t*>(depth_frame_.getData());
  for (std::size_t y = 0; y < height; ++y)
    std::memcpy(depth_pixels_.data() + y * width,
                from + y * static_cast<std::size_t>(depth_frame_.getStrideInBytes()),
                width * sizeof(std::uint16_t));
  ++frames_read_;
  return true;
}

std::int32_t Sensor::grab(double timeout_s, turnscan_frame& frame) {
  check_connected();
  if (file_ && frames_read_ >= frame_count_) return TURNSCAN_END;
  // A file that is read as fast as possible brings a frame when it is asked for one.
  const bool waits = !(file_ && as_fast_as_possible_);
  if (waits && !wait(timeout_s)) return TURNSCAN_NOTHING;
  if (!read_depth()) return TURNSCAN_NOTHING;
  read_waiting_color();
  frame = {};
  frame.depth = depth_pixels_.data();
  frame.width = depth_frame_.getWidth();
  frame.height = depth_frame_.getHeight();
  if (with_color_ && color_frame_.isValid()) {
    frame.color = color_pixels_.data();
    frame.color_width = color_frame_.getWidth();
    frame.color_height = color_frame_.getHeight();
  }
  frame.time_s = static_cast<double>(depth_frame_.getTimestamp()) * kMicrosecond;
  frame.number = depth_frame_.getFrameIndex() > 0
                     ? static_cast<std::uint64_t>(depth_frame_.getFrameIndex())
                     : 0;
  return TURNSCAN_OK;
}

}  // namespace
}  // namespace turnscan::plugin

/// A sensor that is called from one thread only, which never ends.
struct turnscan_device {
 public:
  turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                  std::int32_t count) {
    caller_.call(
        [&] { sensor_ = std::make_unique<turnscan::plugin::Sensor>(address, parameters, count); });
  }
  ~turnscan_device() {
    caller_.call([&] { sensor_.reset(); });
  }
  turnscan_device(const turnscan_device&) = delete;
  turnscan_device& operator=(const turnscan_device&) = delete;

  void describe(turnscan_device_info& info) {
    caller_.call([&] { sensor_->describe(info); });
  }
  void start() {
    caller_.call([&] { sensor_->start(); });
  }
  void stop() {
    caller_.call([&] { sensor_->stop(); });
  }
  std::int32_t grab(double timeout_s, turnscan_frame& frame) {
    return caller_.call([&] { return sensor_->grab(timeout_s, frame); });
  }

 private:
  turnscan::plugin::Caller caller_;
  std::unique_ptr<turnscan::plugin::Sensor> sensor_;
};

namespace turnscan::plugin {
namespace {

constexpr turnscan_parameter_info kParameters[] = {
    {"color", "Also take colours that the sensor lays on its depth: 0 or 1", "0"},
    {"mode", "WIDTHxHEIGHT@RATE of the depth images", "the sensor's own"},
    {"hfov", "Horizontal field of view in degrees, where the driver does not say it",
     "the driver's"},
    {"speed", "Of an .oni file: 1 or max, which loses no frame", "max"}};

constexpr turnscan_plugin kPlugin = plugin_of<turnscan_device, find_devices>(
    "openni2", "PrimeSense, Asus Xtion, Orbbec Astra, .oni files (OpenNI 2)", kParameters);

}  // namespace
}  // namespace turnscan::plugin

TURNSCAN_EXPORT_PLUGIN(kPlugin)
