// Stands in for libfreenect where fakenect does not: a Kinect that registers its depth to its
// colours. It shows a few frames of a pattern (pattern.hpp), colours first, and is then unplugged.

#include <libfreenect.h>

#include <cstdlib>
#include <cstring>
#include <vector>

#include "tests/capture/freenect/pattern.hpp"

namespace pattern = turnscan::testing::pattern;

struct _freenect_context {
  freenect_device* open = nullptr;
};

struct _freenect_device {
  freenect_context* context = nullptr;
  void* user = nullptr;
  void* depth = nullptr;
  void* video = nullptr;
  freenect_depth_cb on_depth = nullptr;
  freenect_video_cb on_video = nullptr;
  bool depth_runs = false, video_runs = false;
  std::uint32_t next = 0;
};

namespace {

char serial[] = "A00366A00000000A";

freenect_frame_mode mode(std::int32_t bytes_per_pixel) {
  freenect_frame_mode out{};
  out.resolution = FREENECT_RESOLUTION_MEDIUM;
  out.width = pattern::kWidth;
  out.height = pattern::kHeight;
  out.bytes = pattern::kWidth * pattern::kHeight * bytes_per_pixel;
  out.framerate = 30;
  out.is_valid = 1;
  return out;
}

}  // namespace

extern "C" {

int freenect_init(freenect_context** context, freenect_usb_context*) {
  *context = new freenect_context();
  return 0;
}
int freenect_shutdown(freenect_context* context) {
  delete context;
  return 0;
}
void freenect_set_log_level(freenect_context*, freenect_loglevel) {}
void freenect_set_log_callback(freenect_context*, freenect_log_cb) {}
void freenect_select_subdevices(freenect_context*, freenect_device_flags) {}
int freenect_num_devices(freenect_context*) { return 1; }

int freenect_list_device_attributes(freenect_context*, freenect_device_attributes** list) {
  *list = new freenect_device_attributes{nullptr, serial};
  return 1;
}
void freenect_free_device_attributes(freenect_device_attributes* list) { delete list; }

int freenect_open_device(freenect_context* context, freenect_device** device, int) {
  *device = new freenect_device();
  (*device)->context = context;
  context->open = *device;
  return 0;
}
int freenect_close_device(freenect_device* device) {
  device->context->open = nullptr;
  delete device;
  return 0;
}

int freenect_get_depth_mode_count() {
  return std::getenv(pattern::kUnregistered) != nullptr ? 1 : 2;
}
freenect_frame_mode freenect_get_depth_mode(int number) {
  freenect_frame_mode out = mode(2);
  out.depth_format = number == 0 ? FREENECT_DEPTH_MM : FREENECT_DEPTH_REGISTERED;
  return out;
}
freenect_frame_mode freenect_find_video_mode(freenect_resolution, freenect_video_format format) {
  freenect_frame_mode out = mode(3);
  out.video_format = format;
  return out;
}
int freenect_set_depth_mode(freenect_device*, const freenect_frame_mode) { return 0; }
int freenect_set_video_mode(freenect_device*, const freenect_frame_mode) { return 0; }
int freenect_set_depth_buffer(freenect_device* device, void* buffer) {
  device->depth = buffer;
  return 0;
}
int freenect_set_video_buffer(freenect_device* device, void* buffer) {
  device->video = buffer;
  return 0;
}
void freenect_set_depth_callback(freenect_device* device, freenect_depth_cb callback) {
  device->on_depth = callback;
}
void freenect_set_video_callback(freenect_device* device, freenect_video_cb callback) {
  device->on_video = callback;
}
void freenect_set_user(freenect_device* device, void* user) { device->user = user; }
void* freenect_get_user(freenect_device* device) { return device->user; }

int freenect_start_depth(freenect_device* device) {
  device->depth_runs = true;
  return 0;
}
int freenect_start_video(freenect_device* device) {
  device->video_runs = true;
  return 0;
}
int freenect_stop_depth(freenect_device* device) {
  device->depth_runs = false;
  return 0;
}
int freenect_stop_video(freenect_device* device) {
  device->video_runs = false;
  return 0;
}

int freenect_process_events_timeout(freenect_context* context, timeval*) {
  freenect_device* device = context->open;
  if (device == nullptr) return 0;
  const std::uint32_t frame = device->next++;
  if (frame == pattern::kFrames) return -1;
  const std::uint32_t ticks = frame * 2000000U;
  if (device->video_runs) {
    const auto colors = pattern::colors(frame);
    std::memcpy(device->video, colors.data(), colors.size());
    device->on_video(device, device->video, ticks);
  }
  if (device->depth_runs) {
    const auto depth = pattern::depth_mm(frame);
    std::memcpy(device->depth, depth.data(), depth.size() * sizeof(depth[0]));
    device->on_depth(device, device->depth, ticks);
  }
  return 0;
}

}  // extern "C"
