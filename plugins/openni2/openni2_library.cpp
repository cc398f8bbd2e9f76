#include "openni2_library.hpp"

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

std::vector<turnscan_device_entry> find_devices() {
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

}  // namespace turnscan::plugin
