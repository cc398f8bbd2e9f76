// Azure Kinect, and Orbbec Femto through Orbbec's library of the same interface.

#include <k4a/k4a.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../plugin_support.hpp"

namespace turnscan::plugin {
namespace {

constexpr double kMaxMisfit_px = 0.3;
constexpr int kSamples = 400;

std::string serial_of(k4a_device_t device) {
  char text[64] = {};
  std::size_t size = sizeof text;
  return k4a_device_get_serialnum(device, text, &size) == K4A_BUFFER_RESULT_SUCCEEDED
             ? std::string(text)
             : std::string();
}

double radial(const k4a_calibration_intrinsic_parameters_t& p, double r2) {
  const auto& c = p.param;
  return (1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3))) /
         (1.0 + r2 * (c.k4 + r2 * (c.k5 + r2 * c.k6)));
}

/// The sensor's radial distortion is a fraction of two polynomials, ours is one polynomial: the
/// nearest one, by least squares over the image's radii. Returns the largest misfit in pixels.
double fit_polynomial(const k4a_calibration_camera_t& camera, double (&k)[3]) {
  const auto& parameters = camera.intrinsics.parameters;
  const double focal = parameters.param.fx;
  const double largest =
      0.5 * std::hypot(camera.resolution_width, camera.resolution_height) / focal;
  // Normal equations of r^3, r^5, r^7 against r (radial - 1), solved by elimination.
  double a[3][4] = {};
  for (int i = 1; i <= kSamples; ++i) {
    const double r = largest * i / kSamples, r2 = r * r;
    const double base[3] = {r * r2, r * r2 * r2, r * r2 * r2 * r2};
    const double value = r * (radial(parameters, r2) - 1.0);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) a[row][column] += base[row] * base[column];
      a[row][3] += base[row] * value;
    }
  }
  for (int pivot = 0; pivot < 3; ++pivot)
    for (int row = 0; row < 3; ++row) {
      if (row == pivot) continue;
      const double share = a[row][pivot] / a[pivot][pivot];
      for (int column = pivot; column < 4; ++column) a[row][column] -= share * a[pivot][column];
    }
  for (int row = 0; row < 3; ++row) k[row] = a[row][3] / a[row][row];
  double misfit = 0.0;
  for (int i = 1; i <= kSamples; ++i) {
    const double r = largest * i / kSamples, r2 = r * r;
    const double ours = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]));
    misfit = std::max(misfit, focal * r * std::abs(ours - radial(parameters, r2)));
  }
  return misfit;
}

k4a_depth_mode_t mode_of(const std::string& text) {
  if (text == "nfov") return K4A_DEPTH_MODE_NFOV_UNBINNED;
  if (text == "nfov-binned") return K4A_DEPTH_MODE_NFOV_2X2BINNED;
  if (text == "wfov-binned") return K4A_DEPTH_MODE_WFOV_2X2BINNED;
  throw Failure{TURNSCAN_BAD_PARAMETER,
                "mode = " + text + " is none of nfov, nfov-binned and wfov-binned"};
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
  k4a_device_t device_ = nullptr;
  k4a_device_configuration_t configuration_ = K4A_DEVICE_CONFIG_INIT_DISABLE_ALL;
  std::string serial_;
  std::vector<std::uint16_t> depth_;
  bool started_ = false;
};

turnscan_device::turnscan_device(const std::string& address, const turnscan_parameter* parameters,
                                 std::int32_t count) {
  using namespace turnscan::plugin;
  configuration_.depth_mode = mode_of(value_of(parameters, count, "mode", "nfov"));
  configuration_.camera_fps = K4A_FRAMES_PER_SECOND_30;
  const std::uint32_t found = k4a_device_get_installed_count();
  if (found == 0)
    throw Failure{TURNSCAN_NOT_FOUND, "no Azure Kinect or Femto is connected; plug it in"};
  bool refused = false;
  for (std::uint32_t i = 0; i < found; ++i) {
    k4a_device_t device = nullptr;
    if (k4a_device_open(i, &device) != K4A_RESULT_SUCCEEDED) {
      refused = true;
      continue;
    }
    serial_ = serial_of(device);
    if (address.empty() || address == serial_ || address == std::to_string(i)) {
      device_ = device;
      return;
    }
    k4a_device_close(device);
  }
  if (refused)
    throw Failure{
        TURNSCAN_BUSY,
        "the Azure Kinect cannot be opened: another program uses it, or this user may "
        "not open it; close that program, or install the udev rule of docs/reference/devices.md"};
  throw Failure{TURNSCAN_NOT_FOUND, "there is no Azure Kinect with the number or serial number " +
                                        address + "; 'turnscan devices' lists them"};
}

turnscan_device::~turnscan_device() {
  stop();
  k4a_device_close(device_);
}

void turnscan_device::describe(turnscan_device_info& info) const {
  using namespace turnscan::plugin;
  k4a_calibration_t calibration{};
  if (k4a_device_get_calibration(device_, configuration_.depth_mode, K4A_COLOR_RESOLUTION_OFF,
                                 &calibration) != K4A_RESULT_SUCCEEDED)
    throw Failure{TURNSCAN_FAILED, "the sensor does not tell its calibration; plug it in again"};
  const k4a_calibration_camera_t& from = calibration.depth_camera_calibration;
  const auto& parameters = from.intrinsics.parameters.param;
  double k[3] = {};
  const double misfit = fit_polynomial(from, k);
  if (!(misfit <= kMaxMisfit_px))
    throw Failure{TURNSCAN_UNSUPPORTED,
                  "the lens of this mode is not described well enough by turnscan's model (" +
                      std::to_string(misfit) + " pixels off); use mode=nfov"};
  put_text(info.model, "azure-kinect");
  put_text(info.serial, serial_);
  turnscan_camera& camera = info.camera;
  camera.width = from.resolution_width;
  camera.height = from.resolution_height;
  camera.fx = parameters.fx;
  camera.fy = parameters.fy;
  camera.cx = parameters.cx;
  camera.cy = parameters.cy;
  const double lens[5] = {k[0], k[1], parameters.p1, parameters.p2, k[2]};
  std::copy(std::begin(lens), std::end(lens), camera.distortion);
  info.depth_kind = TURNSCAN_DEPTH_STEPS;
  info.depth_unit_m = 1e-3;
  info.fps = 30.0;
  info.live = 1;
}

void turnscan_device::start() {
  if (started_) return;
  if (k4a_device_start_cameras(device_, &configuration_) != K4A_RESULT_SUCCEEDED)
    throw turnscan::plugin::Failure{TURNSCAN_FAILED,
                                    "the sensor does not start; check that it is at a USB 3 port "
                                    "and that its depth engine is installed"};
  started_ = true;
}

void turnscan_device::stop() {
  if (started_) k4a_device_stop_cameras(device_);
  started_ = false;
}

std::int32_t turnscan_device::grab(double timeout_s, turnscan_frame& frame) {
  k4a_capture_t capture = nullptr;
  const auto result =
      k4a_device_get_capture(device_, &capture, std::max(1, static_cast<int>(1e3 * timeout_s)));
  if (result == K4A_WAIT_RESULT_TIMEOUT) return TURNSCAN_NOTHING;
  if (result != K4A_WAIT_RESULT_SUCCEEDED)
    throw turnscan::plugin::Failure{
        TURNSCAN_LOST, "the sensor stopped answering; check the cable and the power supply"};
  k4a_image_t image = k4a_capture_get_depth_image(capture);
  k4a_capture_release(capture);
  if (image == nullptr) return TURNSCAN_NOTHING;
  frame = {};
  frame.width = k4a_image_get_width_pixels(image);
  frame.height = k4a_image_get_height_pixels(image);
  frame.time_s = 1e-6 * static_cast<double>(k4a_image_get_device_timestamp_usec(image));
  const auto width = static_cast<std::size_t>(frame.width);
  const auto stride = static_cast<std::size_t>(k4a_image_get_stride_bytes(image));
  depth_.resize(width * static_cast<std::size_t>(frame.height));
  const std::uint8_t* from = k4a_image_get_buffer(image);
  for (std::size_t y = 0; y < static_cast<std::size_t>(frame.height); ++y)
    std::memcpy(depth_.data() + y * width, from + y * stride, width * sizeof(std::uint16_t));
  k4a_image_release(image);
  frame.depth = depth_.data();
  return TURNSCAN_OK;
}

namespace turnscan::plugin {
namespace {

std::vector<turnscan_device_entry> find_devices() {
  std::vector<turnscan_device_entry> found;
  const std::uint32_t count = k4a_device_get_installed_count();
  for (std::uint32_t i = 0; i < count; ++i) {
    std::string serial;
    k4a_device_t device = nullptr;
    if (k4a_device_open(i, &device) == K4A_RESULT_SUCCEEDED) {
      serial = serial_of(device);
      k4a_device_close(device);
    }
    found.push_back(device_entry("azure-kinect", serial, i));
  }
  return found;
}

constexpr turnscan_parameter_info kParameters[] = {
    {"mode", "nfov (640x576), nfov-binned (320x288) or wfov-binned (512x512)", "nfov"}};

constexpr turnscan_plugin kPlugin = plugin_of<turnscan_device, find_devices>(
    "k4a", "Azure Kinect, Orbbec Femto (k4a)", kParameters);

}  // namespace
}  // namespace turnscan::plugin

TURNSCAN_EXPORT_PLUGIN(kPlugin)
