#include <algorithm>
#include <cmath>
#include <turnscan/capture/source/plugin_source.hpp>

namespace turnscan::source {

namespace {

constexpr double kRecordedUnit_m = 1e-4;  // for depth delivered in metres
constexpr std::int32_t kLargestImage = 16384;

ErrorCode code_of(std::int32_t status) {
  switch (status) {
    case TURNSCAN_NOT_FOUND:
      return ErrorCode::kNotFound;
    case TURNSCAN_BUSY:
      return ErrorCode::kDeviceBusy;
    case TURNSCAN_LOST:
      return ErrorCode::kDeviceLost;
    case TURNSCAN_DENIED:
      return ErrorCode::kNoPermission;
    case TURNSCAN_BAD_PARAMETER:
      return ErrorCode::kInvalidOption;
    case TURNSCAN_UNSUPPORTED:
      return ErrorCode::kUnsupported;
    default:
      return ErrorCode::kLibrary;
  }
}

CameraIntrinsics intrinsics_of(const turnscan_camera& camera) {
  CameraIntrinsics out;
  out.width = camera.width;
  out.height = camera.height;
  out.fx = camera.fx;
  out.fy = camera.fy;
  out.cx = camera.cx;
  out.cy = camera.cy;
  std::copy(std::begin(camera.distortion), std::end(camera.distortion), out.distortion.begin());
  return out;
}

Pose pose_of(const double (&rows)[12]) {
  Pose pose = Pose::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) pose(r, c) = rows[4 * r + c];
  return pose;
}

template <std::size_t N>
std::string text_of(char (&text)[N]) {
  text[N - 1] = '\0';
  return text;
}

/// Owns the device.
class Device {
 public:
  Device(const turnscan_plugin& plugin, turnscan_device* device)
      : plugin_(&plugin), device_(device) {}
  ~Device() {
    if (device_ != nullptr) plugin_->close(device_);
  }
  Device(Device&& other) noexcept
      : plugin_(other.plugin_), device_(std::exchange(other.device_, nullptr)) {}
  Device& operator=(Device&&) = delete;
  const turnscan_plugin& plugin() const { return *plugin_; }
  turnscan_device* get() const { return device_; }

 private:
  const turnscan_plugin* plugin_;
  turnscan_device* device_;
};

Result<SensorInfo> sensor_of(const turnscan_plugin& plugin, turnscan_device_info& info) {
  SensorInfo sensor;
  sensor.model = text_of(info.model);
  sensor.intrinsics = intrinsics_of(info.camera);
  sensor.depth_unit_m =
      info.depth_kind == TURNSCAN_DEPTH_STEPS ? info.depth_unit_m : kRecordedUnit_m;
  auto good = sensor.intrinsics.check();
  if (good && info.color_kind == TURNSCAN_COLOR_OWN) {
    sensor.color_intrinsics = intrinsics_of(info.color_camera);
    sensor.T_color_sensor = pose_of(info.T_color_depth);
    good = sensor.color_intrinsics->check();
    if (const auto pose = pose_from(sensor.T_color_sensor.matrix()); good && !pose)
      good = tl::unexpected<Error>(pose.error());
  }
  if (!good)
    return fail(ErrorCode::kLibrary, "{}: the driver describes no usable camera ({})", plugin.name,
                good.error().message);
  if (!(sensor.depth_unit_m >= 1e-6 && sensor.depth_unit_m <= 0.1))
    return fail(ErrorCode::kLibrary, "{}: the driver's step of depth, {} m, is not usable",
                plugin.name, sensor.depth_unit_m);
  return sensor;
}

class PluginGrabber : public Grabber {
 public:
  PluginGrabber(Device device, SourceInfo info, const turnscan_device_info& description)
      : device_(std::move(device)), info_(std::move(info)), description_(description) {}

  const SourceInfo& info() const override { return info_; }

  Result<> start() override {
    turnscan_error error{};
    last_number_ = 0;
    const std::int32_t status = plugin().start(device_.get(), &error);
    if (status < 0) return plugin_failure(plugin(), status, error);
    return {};
  }
  void stop() override { plugin().stop(device_.get()); }

  Result<Delivery> grab(double timeout_s) override {
    if (pending_) return std::exchange(pending_, std::nullopt).value();
    turnscan_frame frame{};
    turnscan_error error{};
    const std::int32_t status = plugin().grab(device_.get(), timeout_s, &frame, &error);
    if (status < 0) return plugin_failure(plugin(), status, error);
    Delivery out;
    if (status == TURNSCAN_NOTHING) return out;
    out.kind = status == TURNSCAN_END ? Delivery::Kind::kEnd : Delivery::Kind::kFrame;
    if (status == TURNSCAN_END) return out;
    out.host_time_s = info_.live ? steady_seconds() : frame.time_s;
    out.frame.info.time_s = frame.time_s;
    TURNSCAN_TRY(take(frame, out.frame));
    return after_gap(std::move(out), frame.number);
  }

 private:
  const turnscan_plugin& plugin() const { return device_.plugin(); }

  Result<> take(const turnscan_frame& from, Frame& to) const {
    if (from.depth == nullptr || from.width <= 0 || from.height <= 0 ||
        from.width > kLargestImage || from.height > kLargestImage)
      return fail(ErrorCode::kLibrary, "{}: the driver sent a frame without an image",
                  plugin().name);
    to.depth = DepthImage(from.width, from.height);
    if (description_.depth_kind == TURNSCAN_DEPTH_STEPS)
      take_steps(static_cast<const std::uint16_t*>(from.depth), to.depth);
    else
      take_metres(static_cast<const float*>(from.depth), to.depth);
    if (from.color != nullptr) take_color(from, to);
    return {};
  }

  /// 65535 has a special meaning in a recording; no sensor reaches that far.
  static void take_steps(const std::uint16_t* from, DepthImage& to) {
    std::transform(from, from + to.pixels.size(), to.pixels.begin(),
                   [](std::uint16_t raw) { return raw == kOutsideCrop ? kNoReturn : raw; });
  }

  static void take_metres(const float* from, DepthImage& to) {
    std::transform(from, from + to.pixels.size(), to.pixels.begin(), [](float z_m) {
      const double steps = std::round(double(z_m) / kRecordedUnit_m);
      return steps > 0.0 && steps < double(kOutsideCrop) ? static_cast<std::uint16_t>(steps)
                                                         : kNoReturn;
    });
  }

  /// Colour that does not match the driver's description is dropped.
  void take_color(const turnscan_frame& from, Frame& to) const {
    const SensorInfo& sensor = info_.header.sensors.front();
    const CameraIntrinsics& camera =
        sensor.color_intrinsics ? *sensor.color_intrinsics : sensor.intrinsics;
    if (description_.color_kind == TURNSCAN_COLOR_NONE || from.color_width != camera.width ||
        from.color_height != camera.height)
      return;
    to.color = ColorImage(camera.width, camera.height);
    for (std::size_t i = 0; i < to.color.pixels.size(); ++i)
      to.color.pixels[i] = {from.color[3 * i], from.color[3 * i + 1], from.color[3 * i + 2]};
  }

  /// If the sensor's frame counter skips, a dropped frame is delivered first: a single one for a
  /// gap of any length.
  Delivery after_gap(Delivery delivery, std::uint64_t number) {
    const bool gap = number != 0 && last_number_ != 0 && number > last_number_ + 1;
    last_number_ = number;
    if (!gap) return delivery;
    Delivery lost;
    lost.kind = Delivery::Kind::kFrame;
    lost.host_time_s = delivery.host_time_s;
    lost.frame.info.status = FrameStatus::kDropped;
    lost.frame.info.time_s = delivery.frame.info.time_s - (info_.fps > 0.0 ? 1.0 / info_.fps : 0.0);
    pending_ = std::move(delivery);
    return lost;
  }

  Device device_;
  SourceInfo info_;
  turnscan_device_info description_;
  std::optional<Delivery> pending_;
  std::uint64_t last_number_ = 0;
};

std::string known_parameters(const turnscan_plugin& plugin) {
  std::string known = "queue";
  for (std::int32_t i = 0; i < plugin.parameter_count; ++i)
    known += std::string(", ") + plugin.parameters[i].name;
  return known;
}

Result<std::vector<turnscan_parameter>> parameters_of(const turnscan_plugin& plugin,
                                                      const SourceUri& uri) {
  std::vector<turnscan_parameter> parameters;
  for (const auto& [name, value] : uri.parameters) {
    const bool known =
        std::any_of(plugin.parameters, plugin.parameters + plugin.parameter_count,
                    [&, &n = name](const turnscan_parameter_info& info) { return info.name == n; });
    if (!known)
      return fail(ErrorCode::kInvalidOption, "{}: there is no parameter '{}'; it has {}",
                  uri.scheme, name, known_parameters(plugin));
    parameters.push_back({name.c_str(), value.c_str()});
  }
  return parameters;
}

}  // namespace

tl::unexpected<Error> plugin_failure(const turnscan_plugin& plugin, std::int32_t status,
                                     const turnscan_error& error) {
  const std::string_view text(
      error.text,
      std::find(std::begin(error.text), std::end(error.text), '\0') - std::begin(error.text));
  return fail(code_of(status), "{}: {}", plugin.name,
              text.empty() ? "the driver failed without saying why; start it again" : text);
}

Result<std::unique_ptr<Grabber>> open_plugin(const SourceUri& uri, const RunContext& context) {
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(const turnscan_plugin* plugin, load_plugin(uri.scheme));
  return open_device(*plugin, uri);
}

Result<std::unique_ptr<Grabber>> open_device(const turnscan_plugin& plugin, const SourceUri& uri) {
  TURNSCAN_ASSIGN(const auto parameters, parameters_of(plugin, uri));
  turnscan_device* opened = nullptr;
  turnscan_error error{};
  std::int32_t status = plugin.open(uri.address.c_str(), parameters.data(),
                                    static_cast<std::int32_t>(parameters.size()), &opened, &error);
  if (status < 0) return plugin_failure(plugin, status, error);
  Device device(plugin, opened);
  turnscan_device_info description{};
  status = plugin.describe(device.get(), &description, &error);
  if (status < 0) return plugin_failure(plugin, status, error);
  TURNSCAN_ASSIGN(SensorInfo sensor, sensor_of(plugin, description));
  SourceInfo info;
  info.uri = format_source_uri(uri);
  info.driver = uri.scheme;
  const std::string serial = text_of(description.serial);
  info.identities = {identity_text(
      fmt::format("{}-{}-{}", uri.scheme, sensor.model, serial.empty() ? "0" : serial))};
  info.header.sensors = {std::move(sensor)};
  info.settings["driver"] = plugin.description;
  if (!serial.empty()) info.settings["serial"] = serial;
  info.fps = std::isfinite(description.fps) && description.fps > 0.0 ? description.fps : 0.0;
  info.live = description.live != 0;
  if (description.frame_count > 0) info.frame_count = description.frame_count;
  return std::unique_ptr<Grabber>(
      std::make_unique<PluginGrabber>(std::move(device), std::move(info), description));
}

}  // namespace turnscan::source
