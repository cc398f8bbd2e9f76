// Kinect for Xbox One (Kinect v2) through libfreenect2.

#include <libfreenect2/frame_listener_impl.h>
#include <libfreenect2/logger.h>
#include <libfreenect2/registration.h>
#include <libfreenect2/libfreenect2.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include "../plugin_support.hpp"

namespace turnscan::plugin {
namespace {

constexpr int kWidth = 512, kHeight = 424;
constexpr double kTimestamp_s = 0.000125;  // unit of the sensor's clock
constexpr std::size_t kPixels = std::size_t(kWidth) * kHeight;

/// libfreenect2 prints to standard output unless it is told not to.
libfreenect2::Freenect2& library() {
  static const bool quiet = (libfreenect2::setGlobalLogger(nullptr), true);
  static libfreenect2::Freenect2 instance;
  (void)quiet;
  return instance;
}

}  // namespace
}  // namespace turnscan::plugin

struct turnscan_device {
 public:
  turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                  std::int32_t count);
  ~turnscan_device();
  turnscan_device(const turnscan_device&) = delete;
  turnscan_device& operator=(const turnscan_device&) = delete;

  void describe(turnscan_device_info& info) const;
  void start();
  void stop();
  std::int32_t grab(double timeout_s, turnscan_frame& frame);

 private:
  void take(libfreenect2::FrameMap& frames, turnscan_frame& frame);

  std::string serial_;
  bool with_color_, mirrored_, started_ = false;
  libfreenect2::Freenect2Device* device_ = nullptr;  ///< libfreenect2 deletes it
  std::unique_ptr<libfreenect2::SyncMultiFrameListener> listener_;
  std::unique_ptr<libfreenect2::Registration> registration_;
  libfreenect2::Freenect2Device::IrCameraParams camera_{};
  std::vector<float> depth_m_;
  std::vector<std::uint8_t> color_;
};

turnscan_device::turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                                 std::int32_t count)
    : with_color_(turnscan::plugin::flag_of(parameters, count, "color", false)),
      mirrored_(turnscan::plugin::flag_of(parameters, count, "mirrored", true)) {
  using turnscan::plugin::Failure;
  libfreenect2::Freenect2& library = turnscan::plugin::library();
  const int found = library.enumerateDevices();
  if (found == 0)
    throw Failure{TURNSCAN_NOT_FOUND,
                  "no Kinect v2 is connected; plug it in, with its own power supply, at USB 3"};
  for (int i = 0; i < found && serial_.empty(); ++i) {
    const std::string serial = library.getDeviceSerialNumber(i);
    if (address.empty() || address == serial || address == std::to_string(i)) serial_ = serial;
  }
  if (serial_.empty())
    throw Failure{TURNSCAN_NOT_FOUND, "there is no Kinect v2 with the number or serial number " +
                                          address + "; 'turnscan devices' lists them"};
  device_ = library.openDevice(serial_);
  if (device_ == nullptr)
    throw Failure{
        TURNSCAN_BUSY,
        "the Kinect v2 cannot be opened: another program uses it, or this user may not "
        "open it; close that program, or install the udev rule of docs/reference/devices.md"};
  listener_ = std::make_unique<libfreenect2::SyncMultiFrameListener>(
      with_color_ ? libfreenect2::Frame::Color | libfreenect2::Frame::Depth
                  : static_cast<unsigned>(libfreenect2::Frame::Depth));
  device_->setIrAndDepthFrameListener(listener_.get());
  if (with_color_) device_->setColorFrameListener(listener_.get());
  try {
    start();  // the camera's constants can be read once it has started
  } catch (...) {
    device_->close();
    throw;
  }
  camera_ = device_->getIrCameraParams();
  if (with_color_)
    registration_ =
        std::make_unique<libfreenect2::Registration>(camera_, device_->getColorCameraParams());
}

turnscan_device::~turnscan_device() {
  stop();
  device_->close();
}

/// The camera delivers its image mirrored left to right; so its principal point moves to the other
/// side, and p2 changes its sign. With colours the depth has been undistorted.
void turnscan_device::describe(turnscan_device_info& info) const {
  turnscan::plugin::put_text(info.model, "kinect-v2");
  turnscan::plugin::put_text(info.serial, serial_);
  turnscan_camera& camera = info.camera;
  camera.width = turnscan::plugin::kWidth;
  camera.height = turnscan::plugin::kHeight;
  camera.fx = camera_.fx;
  camera.fy = camera_.fy;
  camera.cx = mirrored_ ? turnscan::plugin::kWidth - 1 - camera_.cx : camera_.cx;
  camera.cy = camera_.cy;
  if (!with_color_) {
    const double lens[5] = {camera_.k1, camera_.k2, camera_.p1,
                            mirrored_ ? -camera_.p2 : camera_.p2, camera_.k3};
    std::copy(std::begin(lens), std::end(lens), camera.distortion);
  }
  info.depth_kind = TURNSCAN_DEPTH_METRES;
  info.fps = 30.0;
  info.color_kind = with_color_ ? TURNSCAN_COLOR_REGISTERED : TURNSCAN_COLOR_NONE;
  info.live = 1;
}

void turnscan_device::start() {
  if (started_) return;
  if (!device_->startStreams(with_color_, true))
    throw turnscan::plugin::Failure{
        TURNSCAN_FAILED, "the Kinect v2 does not start; check that it is at a USB 3 port"};
  started_ = true;
}

void turnscan_device::stop() {
  if (!started_) return;
  device_->stop();
  started_ = false;
}

void turnscan_device::take(libfreenect2::FrameMap& frames, turnscan_frame& frame) {
  using namespace turnscan::plugin;
  const libfreenect2::Frame* depth = frames[libfreenect2::Frame::Depth];
  libfreenect2::Frame undistorted(kWidth, kHeight, 4), registered(kWidth, kHeight, 4);
  if (with_color_)
    registration_->apply(frames[libfreenect2::Frame::Color], depth, &undistorted, &registered);
  const libfreenect2::Frame* source = with_color_ ? &undistorted : depth;
  depth_m_.resize(kPixels);
  color_.resize(with_color_ ? 3 * kPixels : 0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t to = std::size_t(y) * kWidth + std::size_t(x);
      const std::size_t from =
          std::size_t(y) * kWidth + std::size_t(mirrored_ ? kWidth - 1 - x : x);
      float millimetres = 0.0F;
      std::memcpy(&millimetres, source->data + 4 * from, sizeof millimetres);
      depth_m_[to] = 0.001F * millimetres;
      // Blue, green, red and a byte that is not used.
      for (std::size_t c = 0; with_color_ && c < 3; ++c)
        color_[3 * to + c] = registered.data[4 * from + 2 - c];
    }
  frame = {};
  frame.depth = depth_m_.data();
  frame.width = kWidth;
  frame.height = kHeight;
  frame.color = with_color_ ? color_.data() : nullptr;
  frame.color_width = kWidth;
  frame.color_height = kHeight;
  frame.time_s = depth->timestamp * kTimestamp_s;
  frame.number = depth->sequence;
}

std::int32_t turnscan_device::grab(double timeout_s, turnscan_frame& frame) {
  libfreenect2::FrameMap frames;
  if (!listener_->waitForNewFrame(frames, std::max(1, static_cast<int>(1e3 * timeout_s))))
    return TURNSCAN_NOTHING;
  const bool whole = frames[libfreenect2::Frame::Depth]->status == 0;
  if (whole) take(frames, frame);
  listener_->release(frames);
  return whole ? TURNSCAN_OK : TURNSCAN_NOTHING;
}

namespace turnscan::plugin {
namespace {

std::vector<turnscan_device_entry> find_devices() {
  std::vector<turnscan_device_entry> found;
  const int count = library().enumerateDevices();
  for (int i = 0; i < count; ++i)
    found.push_back(device_entry("kinect-v2", library().getDeviceSerialNumber(i), found.size()));
  return found;
}

constexpr turnscan_parameter_info kParameters[] = {
    {"color", "Also take colours, laid on the depth, which is then undistorted: 0 or 1", "0"},
    {"mirrored", "Whether the camera's image is mirrored and is to be turned back: 0 or 1", "1"}};

constexpr turnscan_plugin kPlugin = plugin_of<turnscan_device, find_devices>(
    "freenect2", "Kinect for Xbox One, Kinect for Windows v2 (libfreenect2)", kParameters);

}  // namespace
}  // namespace turnscan::plugin

TURNSCAN_EXPORT_PLUGIN(kPlugin)
