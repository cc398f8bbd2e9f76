// Kinect for Xbox 360 and Kinect for Windows v1 through libfreenect.

#include <libfreenect.h>
#include <libfreenect_registration.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "../plugin_support.hpp"
#include "kinect_v1.hpp"

// Of libfreenect 0.5, but not of every library that stands in for it (fakenect has none of them).
#pragma weak freenect_copy_registration
#pragma weak freenect_destroy_registration
#pragma weak freenect_list_device_attributes
#pragma weak freenect_free_device_attributes

namespace turnscan::plugin {
namespace {

constexpr double kTicksPerSecond = 60e6;  // of the camera's clock
constexpr const char* kModel = "kinect-v1";

/// What libfreenect says about its last failure: its functions return no more than -1.
class Log {
 public:
  void add(const char* text) {
    const std::lock_guard lock(mutex_);
    text_ = text;
    while (!text_.empty() && (text_.back() == '\n' || text_.back() == '.')) text_.pop_back();
    gone_ = gone_ || text_.find("disappeared") != std::string::npos;
  }
  std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }
  bool gone() const {
    const std::lock_guard lock(mutex_);
    return gone_;
  }
  void clear() {
    const std::lock_guard lock(mutex_);
    text_.clear();
    gone_ = false;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
  bool gone_ = false;
};

Log& log() {
  static Log instance;
  return instance;
}

void take_log(freenect_context*, freenect_loglevel, const char* text) { log().add(text); }

/// The context of a listing or a device.
class Context {
 public:
  Context() {
    log().clear();
    if (freenect_init(&context_, nullptr) < 0)
      throw Failure{TURNSCAN_FAILED,
                    "libfreenect cannot start (" + log().text() + "); check that USB is there"};
    freenect_set_log_level(context_, FREENECT_LOG_ERROR);
    freenect_set_log_callback(context_, take_log);
    freenect_select_subdevices(context_, FREENECT_DEVICE_CAMERA);
  }
  ~Context() { freenect_shutdown(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  freenect_context* get() const { return context_; }

 private:
  freenect_context* context_ = nullptr;
};

std::vector<std::string> serials_of(freenect_context* context) {
  std::vector<std::string> serials;
  const int count = freenect_num_devices(context);
  freenect_device_attributes* list = nullptr;
  if (freenect_list_device_attributes != nullptr &&
      freenect_list_device_attributes(context, &list) >= 0) {
    for (const freenect_device_attributes* a = list; a != nullptr; a = a->next)
      serials.emplace_back(a->camera_serial != nullptr ? a->camera_serial : "");
    freenect_free_device_attributes(list);
  }
  serials.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return serials;
}

[[noreturn]] void throw_open_failure() {
  const std::string why = log().text();
  const auto ends_with = [&](const char* code) {
    return why.size() >= std::strlen(code) &&
           why.compare(why.size() - std::strlen(code), std::string::npos, code) == 0;
  };
  // The numbers are libusb's.
  if (ends_with(" -3"))
    throw Failure{
        TURNSCAN_DENIED,
        "this user may not open the Kinect; install the udev rule of docs/reference/devices.md and "
        "plug it in again"};
  if (ends_with(" -6"))
    throw Failure{TURNSCAN_BUSY,
                  "another program or a kernel driver (gspca_kinect) uses the Kinect; close that "
                  "program, or run 'modprobe -r gspca_kinect'"};
  if (ends_with(" -4")) throw Failure{TURNSCAN_LOST, "the Kinect went away; check its cable"};
  throw Failure{TURNSCAN_FAILED, "libfreenect cannot open the Kinect (" +
                                     (why.empty() ? std::string("no reason given") : why) +
                                     "); plug it in again"};
}

}  // namespace
}  // namespace turnscan::plugin

struct turnscan_device {
 public:
  turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                  std::int32_t count)
      : with_color_(turnscan::plugin::flag_of(parameters, count, "color", false)) {
    open(address);
    choose_modes();
    read_constants();
    freenect_set_user(device_.get(), this);
    freenect_set_depth_callback(device_.get(), on_depth);
    freenect_set_video_callback(device_.get(), on_video);
  }
  ~turnscan_device() { stop(); }
  turnscan_device(const turnscan_device&) = delete;
  turnscan_device& operator=(const turnscan_device&) = delete;

  void describe(turnscan_device_info& info) const;
  void start();
  void stop();
  std::int32_t grab(double timeout_s, turnscan_frame& frame);

 private:
  void open(const std::string& address);
  void choose_modes();
  void read_constants();
  static void on_depth(freenect_device* device, void* data, std::uint32_t timestamp);
  static void on_video(freenect_device* device, void* data, std::uint32_t timestamp);

  struct Close {
    void operator()(freenect_device* device) const { freenect_close_device(device); }
  };

  turnscan::plugin::Context context_;
  std::unique_ptr<freenect_device, Close> device_;  ///< goes before its context
  std::string serial_;
  bool with_color_;
  freenect_frame_mode depth_mode_{}, video_mode_{};
  turnscan::plugin::KinectV1 constants_;
  std::vector<std::uint16_t> table_;  ///< of raw values; empty where depth comes in millimetres
  std::vector<std::uint16_t> depth_buffer_, depth_;
  std::vector<std::uint8_t> video_buffer_, color_;
  bool started_ = false, fresh_ = false, has_color_ = false;
  std::optional<std::uint32_t> last_ticks_;
  std::uint64_t ticks_ = 0;
};

void turnscan_device::open(const std::string& address) {
  using namespace turnscan::plugin;
  const std::vector<std::string> serials = serials_of(context_.get());
  if (serials.empty())
    throw Failure{TURNSCAN_NOT_FOUND,
                  "no Kinect is connected; plug it in, with its own power supply"};
  std::size_t index = 0;
  if (!address.empty()) {
    while (index < serials.size() && serials[index] != address && std::to_string(index) != address)
      ++index;
    if (index == serials.size())
      throw Failure{TURNSCAN_NOT_FOUND, "there is no Kinect with the number or serial number " +
                                            address + "; 'turnscan devices' lists them"};
  }
  serial_ = serials[index];
  freenect_device* opened = nullptr;
  if (freenect_open_device(context_.get(), &opened, static_cast<int>(index)) < 0)
    throw_open_failure();
  device_.reset(opened);
}

/// From what the library offers: millimetres if it can, else raw values of 11 bits; with colour,
/// depth that is registered to it and nothing else: how the two cameras stand to each other is a
/// secret of the device that the library keeps.
void turnscan_device::choose_modes() {
  using namespace turnscan::plugin;
  const auto find = [&](freenect_depth_format format) {
    for (int i = 0; i < freenect_get_depth_mode_count(); ++i) {
      const freenect_frame_mode mode = freenect_get_depth_mode(i);
      if (mode.is_valid != 0 && mode.depth_format == format &&
          mode.resolution == FREENECT_RESOLUTION_MEDIUM) {
        depth_mode_ = mode;
        return true;
      }
    }
    return false;
  };
  if (with_color_ && !find(FREENECT_DEPTH_REGISTERED))
    throw Failure{TURNSCAN_UNSUPPORTED,
                  "this libfreenect offers no depth that is registered to the colours; leave out "
                  "color=1"};
  if (!with_color_ && !find(FREENECT_DEPTH_MM) && !find(FREENECT_DEPTH_11BIT))
    throw Failure{TURNSCAN_UNSUPPORTED, "the Kinect offers no depth that turnscan understands"};
  if (freenect_set_depth_mode(device_.get(), depth_mode_) < 0)
    throw Failure{TURNSCAN_FAILED, "the Kinect refuses its depth mode; plug it in again"};
  depth_buffer_.resize(static_cast<std::size_t>(depth_mode_.width) *
                       static_cast<std::size_t>(depth_mode_.height));
  freenect_set_depth_buffer(device_.get(), depth_buffer_.data());
  if (!with_color_) return;
  video_mode_ = freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
  if (video_mode_.is_valid == 0 || freenect_set_video_mode(device_.get(), video_mode_) < 0)
    throw Failure{TURNSCAN_FAILED, "the Kinect refuses its colour mode; leave out color=1"};
  video_buffer_.resize(static_cast<std::size_t>(video_mode_.bytes));
  freenect_set_video_buffer(device_.get(), video_buffer_.data());
}

void turnscan_device::read_constants() {
  if (freenect_copy_registration != nullptr && freenect_destroy_registration != nullptr) {
    freenect_registration registration = freenect_copy_registration(device_.get());
    const freenect_zero_plane_info& plane = registration.zero_plane_info;
    if (plane.reference_distance > 0.0F && plane.reference_pixel_size > 0.0F) {
      constants_.baseline_cm = plane.dcmos_emitter_dist;
      constants_.reference_cm = plane.reference_distance;
      constants_.pixel = plane.reference_pixel_size;
      constants_.shift = registration.const_shift;
    }
    freenect_destroy_registration(&registration);
  }
  if (depth_mode_.depth_format == FREENECT_DEPTH_11BIT) table_ = constants_.table();
}

void turnscan_device::describe(turnscan_device_info& info) const {
  turnscan::plugin::put_text(info.model, turnscan::plugin::kModel);
  turnscan::plugin::put_text(info.serial, serial_);
  turnscan_camera& camera = info.camera;
  camera.width = depth_mode_.width;
  camera.height = depth_mode_.height;
  camera.fx = camera.fy = with_color_ ? constants_.color_focal_pixels : constants_.focal_pixels();
  camera.cx = 0.5 * depth_mode_.width;
  camera.cy = 0.5 * depth_mode_.height;
  info.depth_kind = TURNSCAN_DEPTH_STEPS;
  info.depth_unit_m = table_.empty() ? 1e-3 : 1e-4;
  info.fps = depth_mode_.framerate;
  info.color_kind = with_color_ ? TURNSCAN_COLOR_REGISTERED : TURNSCAN_COLOR_NONE;
  info.live = 1;
}

void turnscan_device::start() {
  using turnscan::plugin::Failure;
  if (started_) return;
  if (freenect_start_depth(device_.get()) < 0) turnscan::plugin::throw_open_failure();
  started_ = true;
  if (with_color_ && freenect_start_video(device_.get()) < 0)
    throw Failure{TURNSCAN_FAILED, "the Kinect's colour camera does not start; leave out color=1"};
}

void turnscan_device::stop() {
  if (!started_) return;
  if (with_color_) freenect_stop_video(device_.get());
  freenect_stop_depth(device_.get());
  started_ = false;
}

void turnscan_device::on_depth(freenect_device* device, void* data, std::uint32_t timestamp) {
  auto& self = *static_cast<turnscan_device*>(freenect_get_user(device));
  const auto* raw = static_cast<const std::uint16_t*>(data);
  self.depth_.assign(raw, raw + self.depth_buffer_.size());
  for (std::uint16_t& value : self.depth_) {
    if (!self.table_.empty())
      value = self.table_[value & 0x7ffU];
    else if (value >= FREENECT_DEPTH_MM_MAX_VALUE)
      value = FREENECT_DEPTH_MM_NO_VALUE;
  }
  // 32 bits of ticks last for 71 s.
  self.ticks_ += self.last_ticks_ ? std::uint32_t(timestamp - *self.last_ticks_) : 0U;
  self.last_ticks_ = timestamp;
  self.fresh_ = true;
}

void turnscan_device::on_video(freenect_device* device, void* data, std::uint32_t) {
  auto& self = *static_cast<turnscan_device*>(freenect_get_user(device));
  const auto* rgb = static_cast<const std::uint8_t*>(data);
  self.color_.assign(rgb, rgb + self.video_buffer_.size());
  self.has_color_ = true;
}

std::int32_t turnscan_device::grab(double timeout_s, turnscan_frame& frame) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
  fresh_ = false;
  do {
    timeval wait{0, 5000};
    if (freenect_process_events_timeout(context_.get(), &wait) < 0 ||
        turnscan::plugin::log().gone())
      throw turnscan::plugin::Failure{
          TURNSCAN_LOST, "the Kinect stopped answering; check its cable and its power supply"};
  } while (!fresh_ && Clock::now() < end);
  if (!fresh_) return TURNSCAN_NOTHING;
  frame = {};
  frame.depth = depth_.data();
  frame.width = depth_mode_.width;
  frame.height = depth_mode_.height;
  if (with_color_ && has_color_) {
    frame.color = color_.data();
    frame.color_width = video_mode_.width;
    frame.color_height = video_mode_.height;
  }
  frame.time_s = static_cast<double>(ticks_) / turnscan::plugin::kTicksPerSecond;
  return TURNSCAN_OK;
}

namespace turnscan::plugin {
namespace {

std::vector<turnscan_device_entry> find_devices() {
  const Context context;
  std::vector<turnscan_device_entry> found;
  for (const std::string& serial : serials_of(context.get()))
    found.push_back(device_entry(kModel, serial, found.size()));
  return found;
}

constexpr turnscan_parameter_info kParameters[] = {
    {"color", "Also take colours; depth is then seen from the colour camera: 0 or 1", "0"}};

constexpr turnscan_plugin kPlugin = plugin_of<turnscan_device, find_devices>(
    "freenect", "Kinect for Xbox 360, Kinect for Windows v1 (libfreenect)", kParameters);

}  // namespace
}  // namespace turnscan::plugin

TURNSCAN_EXPORT_PLUGIN(kPlugin)
