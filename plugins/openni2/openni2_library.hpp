#pragma once
// OpenNI 2 itself: its start, its reasons, what it hands out.

#include <OpenNI.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "../plugin_support.hpp"

namespace turnscan::plugin {

/// Why the last call failed, on one line.
std::string last_error();

/// What `why` means for who wants to open a device.
Failure open_failure(const std::string& why);

/// Started once in a process. It is not shut down: drivers leave threads behind that would then run
/// without their library.
void start_library();

/// What is connected.
std::vector<turnscan_device_entry> find_devices();

class Disconnects : public openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit Disconnects(std::string uri) : uri_(std::move(uri)) {
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  ~Disconnects() override { openni::OpenNI::removeDeviceDisconnectedListener(this); }
  Disconnects(const Disconnects&) = delete;
  Disconnects& operator=(const Disconnects&) = delete;
  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (uri_ == info->getUri()) gone_ = true;
  }
  bool gone() const { return gone_; }

 private:
  std::string uri_;
  std::atomic<bool> gone_ = false;
};

/// Some drivers (OpenNI's own dummy is one) tell their thread to stop and do not wait for it; it
/// would use a stream that is no more.
constexpr auto kThreadEnds = std::chrono::milliseconds(100);

/// A stream that is destroyed before its device.
struct Stream {
  openni::VideoStream stream;
  bool was_started = false;
  Stream() = default;
  ~Stream() {
    if (!stream.isValid()) return;
    stream.stop();
    if (was_started) std::this_thread::sleep_for(kThreadEnds);
    stream.destroy();
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
};

struct Device {
  openni::Device device;
  Device() = default;
  ~Device() { device.close(); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

}  // namespace turnscan::plugin
