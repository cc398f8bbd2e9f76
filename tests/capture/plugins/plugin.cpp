// A driver of a sensor that does not exist, for the tests: its frames count, their values follow
// from their number, and its address says what goes wrong.

#include <turnscan/capture/source/plugin.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

// What one of the tests' drivers does not get right.
#ifndef PLUGIN_VERSION
#define PLUGIN_VERSION TURNSCAN_PLUGIN_VERSION
#endif
#ifndef PLUGIN_ENTRY
#define PLUGIN_ENTRY turnscan_plugin_entry
#endif

struct turnscan_device {
  std::string address;
  bool metres = false;
  std::uint64_t next = 1;
  std::vector<std::uint16_t> steps;
  std::vector<float> z_m;
  std::vector<std::uint8_t> color;
};

namespace {

std::int32_t say(turnscan_error* error, std::int32_t status, const char* text) {
  std::snprintf(error->text, sizeof error->text, "%s", text);
  return status;
}

std::int32_t list(turnscan_device_entry* entries, std::int32_t capacity, turnscan_error*) {
  const char* names[] = {"counting", "gaps"};
  for (std::int32_t i = 0; i < 2 && i < capacity; ++i) {
    std::snprintf(entries[i].address, sizeof entries[i].address, "%s", names[i]);
    std::snprintf(entries[i].model, sizeof entries[i].model, "counter");
    std::snprintf(entries[i].serial, sizeof entries[i].serial, "A-%d", i);
  }
  return 2;
}

std::int32_t open(const char* address, const turnscan_parameter* parameters, std::int32_t count,
                  turnscan_device** device, turnscan_error* error) {
  if (std::strcmp(address, "busy") == 0) return say(error, TURNSCAN_BUSY, "it is in use");
  if (std::strcmp(address, "denied") == 0) return say(error, TURNSCAN_DENIED, "not for you");
  if (std::strcmp(address, "none") == 0) return say(error, TURNSCAN_NOT_FOUND, "nothing is here");
  if (std::strcmp(address, "mute") == 0) return say(error, TURNSCAN_FAILED, "");
  *device = new turnscan_device{};
  (*device)->address = address;
  for (std::int32_t i = 0; i < count; ++i)
    if (std::strcmp(parameters[i].name, "metres") == 0)
      (*device)->metres = std::strcmp(parameters[i].value, "1") == 0;
  return TURNSCAN_OK;
}

std::int32_t describe(turnscan_device* device, turnscan_device_info* info, turnscan_error*) {
  std::snprintf(info->model, sizeof info->model, "counter");
  std::snprintf(info->serial, sizeof info->serial, "A/1");
  info->camera = {4, 3, 5.0, 5.0, 1.5, 1.0, {}};
  if (device->address == "blind") info->camera.width = 0;
  info->depth_kind = device->metres ? TURNSCAN_DEPTH_METRES : TURNSCAN_DEPTH_STEPS;
  info->depth_unit_m = 1e-3;
  info->fps = 100.0;
  info->color_kind = TURNSCAN_COLOR_REGISTERED;
  info->frame_count = 6;
  return TURNSCAN_OK;
}

std::int32_t start(turnscan_device*, turnscan_error*) { return TURNSCAN_OK; }

std::int32_t grab(turnscan_device* device, double, turnscan_frame* frame, turnscan_error* error) {
  if (device->next > 6) return TURNSCAN_END;
  if (device->address == "unplugged" && device->next > 3)
    return say(error, TURNSCAN_LOST, "it went away; check the cable");
  const std::uint64_t number = device->next++;
  device->steps.assign(12, static_cast<std::uint16_t>(1000 + number));
  device->steps[0] = 0;
  device->steps[1] = 65535;
  device->z_m.assign(12, 0.50004F);
  device->z_m[0] = -1.0F;
  device->z_m[1] = 7.0F;
  device->z_m[2] = 0.0F / (device->z_m[0] + 1.0F);
  device->color.assign(36, static_cast<std::uint8_t>(number));
  frame->depth = device->metres ? static_cast<const void*>(device->z_m.data())
                                : static_cast<const void*>(device->steps.data());
  frame->width = 4;
  frame->height = 3;
  frame->color = device->color.data();
  frame->color_width = 4;
  frame->color_height = 3;
  // Of the address "gaps" every number stands for three frames.
  frame->number = device->address == "gaps" ? 3 * number : number;
  frame->time_s = static_cast<double>(frame->number) / 100.0;
  return TURNSCAN_OK;
}

void stop(turnscan_device*) {}
void close(turnscan_device* device) { delete device; }

const turnscan_parameter_info kParameters[] = {{"metres", "Depth in metres: 0 or 1", "0"}};

const turnscan_plugin kPlugin = {PLUGIN_VERSION, PLUGIN_NAME, "A counter", kParameters, 1,
                                 list,           open,        describe,    start,       grab,
                                 stop,           close};

}  // namespace

extern "C" __attribute__((visibility("default"))) const turnscan_plugin* PLUGIN_ENTRY(void) {
  return &kPlugin;
}
