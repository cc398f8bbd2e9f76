// A driver of OpenNI 2 for a sensor that does not exist. It opens two kinds of addresses:
//   test:film:FILE     a sensor that shows the frames of a film
//   test:refuse:TEXT   a sensor that cannot be opened, with that text as the reason

#include <OniCTypes.h>

// What OpenNI's own drivers take from its platform library.
#define XN_NEW(Type, ...) new Type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>
#include <OniCProperties.h>

#include <atomic>
#include <condition_variable>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "tests/capture/openni2/film.hpp"

namespace {

using turnscan::testing::Film;

constexpr const char* kFilm = "test:film:";
constexpr const char* kRefuse = "test:refuse:";

/// Frames that may be shown.
struct Allowance {
  std::mutex mutex;
  std::condition_variable changed;
  int frames = 0;
};

Allowance& allowance() {
  static Allowance instance;
  return instance;
}

template <class Value>
OniStatus give(const Value& value, void* data, const int* size) {
  if (*size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  return ONI_STATUS_OK;
}

class Stream : public oni::driver::StreamBase {
 public:
  Stream(const Film& film, OniSensorType type) : film_(film), type_(type) {
    mode_ = {type == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888,
             film.header.width, film.header.height, film.header.fps};
  }

  OniStatus start() override {
    started_ = true;
    return ONI_STATUS_OK;
  }
  void stop() override { started_ = false; }

  OniBool isPropertySupported(int id) override {
    return id <= ONI_STREAM_PROPERTY_MAX_VALUE || id == ONI_STREAM_PROPERTY_MIRRORING;
  }

  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode_, data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(film_.header.hfov_rad, data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(film_.header.vfov_rad, data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(65535, data, size);
      case ONI_STREAM_PROPERTY_CROPPING:  // without it OpenNI's player shows nothing of a recording
        return give(OniCropping{}, data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(mirrored_, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }

  OniStatus setProperty(int id, const void* data, int size) override {
    if (id == ONI_STREAM_PROPERTY_VIDEO_MODE && size == static_cast<int>(sizeof mode_)) {
      OniVideoMode mode;
      std::memcpy(&mode, data, sizeof mode);
      if (mode.resolutionX != mode_.resolutionX || mode.resolutionY != mode_.resolutionY)
        return ONI_STATUS_NOT_SUPPORTED;
      mode_ = mode;
      return ONI_STATUS_OK;
    }
    if (id != ONI_STREAM_PROPERTY_MIRRORING || size != static_cast<int>(sizeof mirrored_))
      return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(&mirrored_, data, sizeof mirrored_);
    return ONI_STATUS_OK;
  }

  void show(int index) {
    if (!started_) return;
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    const std::size_t bytes = film_.header.pixels() * (type_ == ONI_SENSOR_DEPTH ? 2 : 3);
    frame->dataSize = static_cast<int>(bytes);
    fill(frame->data, static_cast<std::size_t>(index));
    frame->sensorType = type_;
    frame->frameIndex = index + 1;
    frame->timestamp =
        static_cast<std::uint64_t>(index) * 1000000U / static_cast<std::uint64_t>(film_.header.fps);
    frame->videoMode = mode_;
    frame->width = mode_.resolutionX;
    frame->height = mode_.resolutionY;
    frame->stride = static_cast<int>(bytes) / frame->height;
    frame->croppingEnabled = frame->cropOriginX = frame->cropOriginY = 0;
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

 private:
  void fill(void* to, std::size_t index) const {
    if (type_ == ONI_SENSOR_COLOR) {
      std::memcpy(to, film_.color[index].data(), film_.color[index].size());
      return;
    }
    std::vector<std::uint16_t> depth = film_.depth[index];
    if (mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_1_MM)
      for (std::uint16_t& value : depth) value = static_cast<std::uint16_t>((value + 5) / 10);
    std::memcpy(to, depth.data(), depth.size() * sizeof(std::uint16_t));
  }

  const Film& film_;
  OniSensorType type_;
  OniVideoMode mode_{};
  OniBool mirrored_ = TRUE;
  std::atomic<bool> started_ = false;
};

class Driver;

class Device : public oni::driver::DeviceBase {
 public:
  Device(Driver& driver, const OniDeviceInfo& info, Film film)
      : driver_(driver), info_(info), film_(std::move(film)) {
    const auto& h = film_.header;
    depth_modes_[0] = {ONI_PIXEL_FORMAT_DEPTH_1_MM, h.width, h.height, h.fps};
    depth_modes_[1] = {ONI_PIXEL_FORMAT_DEPTH_100_UM, h.width, h.height, h.fps};
    color_mode_ = {ONI_PIXEL_FORMAT_RGB888, h.width, h.height, h.fps};
    sensors_[0] = {ONI_SENSOR_DEPTH, 2, depth_modes_};
    sensors_[1] = {ONI_SENSOR_COLOR, 1, &color_mode_};
    {
      const std::lock_guard lock(allowance().mutex);
      allowance().frames = 0;
    }
    thread_ = std::thread([this] { show_film(); });
  }
  ~Device() override {
    {
      const std::lock_guard lock(allowance().mutex);
      closing_ = true;
    }
    allowance().changed.notify_all();
    thread_.join();
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = film_.header.color != 0 ? 2 : 1;
    return ONI_STATUS_OK;
  }

  oni::driver::StreamBase* createStream(OniSensorType type) override {
    const std::lock_guard lock(streams_mutex_);
    auto& stream = streams_[type];
    stream = std::make_unique<Stream>(film_, type);
    return stream.get();
  }
  void destroyStream(oni::driver::StreamBase* gone) override {
    const std::lock_guard lock(streams_mutex_);
    std::erase_if(streams_, [&](const auto& entry) { return entry.second.get() == gone; });
  }

  OniStatus getProperty(int id, void* data, int* size) override {
    if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return give(registration_, data, size);
    constexpr char kSerial[] = "T-1";
    if (id != ONI_DEVICE_PROPERTY_SERIAL_NUMBER || *size < static_cast<int>(sizeof kSerial))
      return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(data, kSerial, sizeof kSerial);
    *size = sizeof kSerial;
    return ONI_STATUS_OK;
  }
  OniStatus setProperty(int id, const void* data, int size) override {
    if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ||
        size != static_cast<int>(sizeof registration_))
      return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(&registration_, data, sizeof registration_);
    return ONI_STATUS_OK;
  }
  OniBool isPropertySupported(int id) override {
    return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override {
    return film_.header.color;
  }

 private:
  void show_film();

  Driver& driver_;
  OniDeviceInfo info_;
  Film film_;
  OniVideoMode depth_modes_[2], color_mode_;
  OniSensorInfo sensors_[2];
  OniImageRegistrationMode registration_ = ONI_IMAGE_REGISTRATION_OFF;
  std::mutex streams_mutex_;
  std::map<OniSensorType, std::unique_ptr<Stream>> streams_;
  bool closing_ = false;  ///< guarded by the allowance's mutex
  std::thread thread_;
};

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus tryDevice(const char* uri) override {
    const std::string text = uri;
    if (!text.starts_with(kFilm) && !text.starts_with(kRefuse)) return ONI_STATUS_ERROR;
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof info.uri, "%s", uri);
    std::snprintf(info.vendor, sizeof info.vendor, "turnscan");
    std::snprintf(info.name, sizeof info.name, "Film");
    deviceConnected(&info);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    const std::string text = uri;
    if (text.starts_with(kRefuse)) {
      getServices().errorLoggerAppend("%s", text.substr(std::strlen(kRefuse)).c_str());
      return nullptr;
    }
    Film film = Film::read(text.substr(std::strlen(kFilm)));
    if (film.depth.empty()) {
      getServices().errorLoggerAppend("There is no film");
      return nullptr;
    }
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof info.uri, "%s", uri);
    return new Device(*this, info, std::move(film));
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {}
  void unplug(const OniDeviceInfo& info) { deviceDisconnected(&info); }
};

void Device::show_film() {
  Allowance& allowed = allowance();
  for (int i = 0; i < film_.header.count; ++i) {
    if (i == film_.header.unplugged_after) {
      driver_.unplug(info_);
      return;
    }
    std::unique_lock lock(allowed.mutex);
    allowed.changed.wait(lock, [&] { return closing_ || allowed.frames > 0; });
    if (closing_) return;
    --allowed.frames;
    lock.unlock();
    // Colour first: it is then there when its depth is taken.
    const std::lock_guard streams(streams_mutex_);
    for (const OniSensorType type : {ONI_SENSOR_COLOR, ONI_SENSOR_DEPTH})
      if (const auto found = streams_.find(type); found != streams_.end()) found->second->show(i);
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void turnscan_test_allow_frames(int frames);
extern "C" __attribute__((visibility("default"))) void turnscan_test_allow_frames(int frames) {
  {
    const std::lock_guard lock(allowance().mutex);
    allowance().frames += frames;
  }
  allowance().changed.notify_all();
}

ONI_EXPORT_DRIVER(Driver)
