#include "openni2_library.hpp"

#include <condition_variable>
#include <mutex>

namespace turnscan::plugin {

namespace {

bool says(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (text.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace

std::string last_error() {
  std::string text = openni::OpenNI::getExtendedError();
  for (char& c : text)
    if (c == '\n' || c == '\t' || c == '\r') c = ' ';
  const std::size_t first = text.find_first_not_of(' ');
  const std::size_t last = text.find_last_not_of(" .!");
  if (first == std::string::npos || last < first) return "no reason given";
  return text.substr(first, last - first + 1);
}

/// OpenNI has one status for everything; what it was shows in the text. Its drivers for USB sensors
/// say of whatever libusb refuses that they failed to open the device (which is the user's rights,
/// as a device that is gone is "not found"), or to set its interface (which another program has).
Failure open_failure(const std::string& why) {
  if (says(why, {"no devices found"}))
    return {TURNSCAN_NOT_FOUND, "no OpenNI 2 sensor is connected; plug it in"};
  if (says(why, {"ermission", "ccess denied", "ACCESS", "Failed to open the USB device"}))
    return {TURNSCAN_DENIED,
            "this user may not open the sensor (" + why +
                "); install the udev rule of docs/reference/devices.md and plug it in again"};
  if (says(why, {"busy", "BUSY", "in use", "already open", "Failed to set USB interface"}))
    return {TURNSCAN_BUSY, "another program uses the sensor (" + why + "); close that program"};
  if (says(why, {"disconnected", "NO_DEVICE", "USB device not found"}))
    return {TURNSCAN_LOST, "the sensor went away (" + why + "); check the cable"};
  if (says(why, {"Couldn't open device"}))
    return {TURNSCAN_NOT_FOUND, "no driver of OpenNI 2 opens it (" + why +
                                    "); 'turnscan devices' lists what is connected"};
  return {TURNSCAN_FAILED, "OpenNI 2 failed (" + why + "); plug the sensor in again"};
}

void start_library() {
  static std::mutex mutex;
  static bool started = false;
  const std::lock_guard lock(mutex);
  if (started) return;
  if (openni::OpenNI::initialize() != openni::STATUS_OK)
    throw Failure{TURNSCAN_FAILED, "OpenNI 2 cannot start (" + last_error() +
                                       "); check that its drivers are installed"};
  started = true;
}

struct Caller::Thread {
  std::mutex mutex;
  std::condition_variable changed;
  std::function<void()> job;

  [[noreturn]] void work() {
    for (;;) {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return job != nullptr; });
      const auto next = std::exchange(job, nullptr);
      lock.unlock();
      next();
    }
  }
};

namespace {

/// Threads that nobody uses now. Never destroyed: they wait when the program ends.
struct IdleThreads {
  std::mutex mutex;
  std::vector<Caller::Thread*> threads;

  static IdleThreads& all() {
    static auto* const idle = new IdleThreads;
    return *idle;
  }
};

}  // namespace

Caller::Caller() : thread_(nullptr) {
  IdleThreads& idle = IdleThreads::all();
  const std::lock_guard lock(idle.mutex);
  if (!idle.threads.empty()) {
    thread_ = idle.threads.back();
    idle.threads.pop_back();
    return;
  }
  thread_ = new Thread;
  std::thread([thread = thread_] { thread->work(); }).detach();
}

Caller::~Caller() {
  IdleThreads& idle = IdleThreads::all();
  const std::lock_guard lock(idle.mutex);
  idle.threads.push_back(thread_);
}

void Caller::run(std::function<void()> job) {
  {
    const std::lock_guard lock(thread_->mutex);
    thread_->job = std::move(job);
  }
  thread_->changed.notify_one();
}

namespace {

std::vector<turnscan_device_entry> connected_devices() {
  start_library();
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::vector<turnscan_device_entry> found;
  for (int i = 0; i < devices.getSize(); ++i) {
    turnscan_device_entry& entry = found.emplace_back();
    put_text(entry.address, devices[i].getUri());
    put_text(entry.model, devices[i].getName());
  }
  return found;
}

}  // namespace

std::vector<turnscan_device_entry> find_devices() { return Caller().call(connected_devices); }

}  // namespace turnscan::plugin
