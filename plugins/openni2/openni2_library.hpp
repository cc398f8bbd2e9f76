#pragma once
// OpenNI 2 itself: its start, its reasons, what it hands out.

#include <OpenNI.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <thread>

#include "../plugin_support.hpp"

namespace turnscan::plugin {

/// Why the last call failed, on one line.
std::string last_error();

/// What `why` means for who wants to open a device.
Failure open_failure(const std::string& why);

/// Calls OpenNI 2 from a thread that never ends, for as long as this object lives; another one may
/// get the thread after it. The library keeps messages for each thread that ever called it, and
/// asks the system by pthread_kill() whether the thread still exists, which is undefined for one
/// that has ended: it crashed once the memory of its stack was gone.
class Caller {
 public:
  Caller();
  ~Caller();
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  /// What the function returns or throws.
  template <class Function>
  auto call(const Function& function) {
    using Task = std::packaged_task<decltype(function())()>;
    const auto task = std::make_shared<Task>(function);
    auto result = task->get_future();
    run([task] { (*task)(); });
    return result.get();
  }

  struct Thread;

 private:
  /// Does not wait for its end.
  void run(std::function<void()> job);

  Thread* thread_;
};

/// Started once in a process. It is not shut down: drivers leave threads behind that would then run
/// without their library.
void start_library();

/// What is connected, asked by a Caller of its own.
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
