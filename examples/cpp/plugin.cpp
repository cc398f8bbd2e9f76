// turnscan-tilted-plane.so: a driver of a depth sensor, here one that sees a tilted plane. turnscan
// finds it in the folders of the variable TURNSCAN_PLUGINS:
//   turnscan capture --device tilted-plane: --frames 10 -o plane

#include <turnscan/capture/source/plugin.h>

#include <cstring>
#include <vector>

struct turnscan_device {
  std::vector<uint16_t> depth = std::vector<uint16_t>(320 * 240);
  uint64_t count = 0;
};

namespace {

int32_t list(turnscan_device_entry* entries, int32_t capacity, turnscan_error*) {
  if (capacity > 0) entries[0] = {"", "tilted plane", "1"};
  return 1;
}

int32_t open(const char*, const turnscan_parameter*, int32_t, turnscan_device** device,
             turnscan_error*) {
  *device = new turnscan_device;
  return TURNSCAN_OK;
}

int32_t describe(turnscan_device*, turnscan_device_info* info, turnscan_error*) {
  *info = {};
  std::strcpy(info->model, "tilted plane");
  info->camera = {320, 240, 300.0, 300.0, 159.5, 119.5, {}};
  info->depth_unit_m = 1e-4;
  info->fps = 30.0;
  return TURNSCAN_OK;
}

int32_t start(turnscan_device*, turnscan_error*) { return TURNSCAN_OK; }

int32_t grab(turnscan_device* device, double, turnscan_frame* frame, turnscan_error*) {
  for (std::size_t i = 0; i < device->depth.size(); ++i) device->depth[i] = 5000 + i / 320;
  *frame = {};
  frame->depth = device->depth.data();
  frame->width = 320;
  frame->height = 240;
  frame->number = ++device->count;
  frame->time_s = static_cast<double>(device->count) / 30.0;
  return TURNSCAN_OK;
}

void stop(turnscan_device*) {}
void close(turnscan_device* device) { delete device; }

constexpr turnscan_plugin kPlugin{TURNSCAN_PLUGIN_VERSION,
                                  "tilted-plane",
                                  "An example of a driver",
                                  nullptr,
                                  0,
                                  list,
                                  open,
                                  describe,
                                  start,
                                  grab,
                                  stop,
                                  close};

}  // namespace

extern "C" const turnscan_plugin* turnscan_plugin_entry() { return &kPlugin; }
