#pragma once
// What the plug-ins share: errors, texts and parameters across the C interface.

#include <turnscan/capture/source/plugin.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace turnscan::plugin {

/// Thrown inside a plug-in, made a status and a text at its border.
struct Failure {
  turnscan_status status;
  std::string text;
};

template <std::size_t N>
void put_text(char (&to)[N], const std::string& text) {
  std::snprintf(to, N, "%s", text.c_str());
}

/// Runs the body of an interface function; nothing thrown leaves it.
template <class Body>
std::int32_t guarded(turnscan_error* error, const Body& body) {
  try {
    return body();
  } catch (const Failure& failure) {
    put_text(error->text, failure.text);
    return failure.status;
  } catch (const std::exception& exception) {
    put_text(error->text, exception.what());
  } catch (...) {
    put_text(error->text, "the driver threw something that is not an exception");
  }
  return TURNSCAN_FAILED;
}

/// The value of a parameter, or what stands for it.
inline std::string value_of(const turnscan_parameter* parameters, std::int32_t count,
                            const char* name, const std::string& otherwise) {
  for (std::int32_t i = 0; i < count; ++i)
    if (std::strcmp(parameters[i].name, name) == 0) return parameters[i].value;
  return otherwise;
}

inline bool flag_of(const turnscan_parameter* parameters, std::int32_t count, const char* name,
                    bool otherwise) {
  const std::string text = value_of(parameters, count, name, otherwise ? "1" : "0");
  if (text == "1" || text == "true") return true;
  if (text == "0" || text == "false") return false;
  throw Failure{TURNSCAN_BAD_PARAMETER,
                std::string(name) + " = " + text + " is neither 0 nor 1; write one of them"};
}

/// As list() of the interface, of the devices that `find` gives.
inline std::int32_t list_devices(std::vector<turnscan_device_entry> (*find)(),
                                 turnscan_device_entry* entries, std::int32_t capacity,
                                 turnscan_error* error) {
  return guarded(error, [&] {
    const std::vector<turnscan_device_entry> found = find();
    const auto fits = std::min(found.size(), static_cast<std::size_t>(std::max(capacity, 0)));
    std::copy_n(found.begin(), fits, entries);
    return static_cast<std::int32_t>(found.size());
  });
}

/// A device for the list; where it has no serial number, it is called by its place.
inline turnscan_device_entry device_entry(const std::string& model, const std::string& serial,
                                          std::size_t place) {
  turnscan_device_entry entry{};
  put_text(entry.address, serial.empty() ? std::to_string(place) : serial);
  put_text(entry.model, model);
  put_text(entry.serial, serial);
  return entry;
}

/// The table of a driver whose devices are found by the function `find`, and are a class with a
/// constructor (address, parameters, count), describe(info), start(), stop() and
/// grab(timeout_s, frame).
template <class Device, std::vector<turnscan_device_entry> (*find)(), std::size_t N>
constexpr turnscan_plugin plugin_of(const char* name, const char* description,
                                    const turnscan_parameter_info (&parameters)[N]) {
  turnscan_plugin plugin{};
  plugin.version = TURNSCAN_PLUGIN_VERSION;
  plugin.name = name;
  plugin.description = description;
  plugin.parameters = parameters;
  plugin.parameter_count = static_cast<std::int32_t>(N);
  plugin.list = [](turnscan_device_entry* entries, std::int32_t capacity, turnscan_error* error) {
    return list_devices(find, entries, capacity, error);
  };
  plugin.open = [](const char* address, const turnscan_parameter* given, std::int32_t given_count,
                   turnscan_device** device, turnscan_error* error) {
    return guarded(error, [&] {
      *device = new Device(address, given, given_count);
      return std::int32_t(TURNSCAN_OK);
    });
  };
  plugin.describe = [](turnscan_device* device, turnscan_device_info* info, turnscan_error* error) {
    return guarded(error, [&] {
      *info = {};
      static_cast<Device*>(device)->describe(*info);
      return std::int32_t(TURNSCAN_OK);
    });
  };
  plugin.start = [](turnscan_device* device, turnscan_error* error) {
    return guarded(error, [&] {
      static_cast<Device*>(device)->start();
      return std::int32_t(TURNSCAN_OK);
    });
  };
  plugin.grab = [](turnscan_device* device, double timeout_s, turnscan_frame* frame,
                   turnscan_error* error) {
    return guarded(error, [&] { return static_cast<Device*>(device)->grab(timeout_s, *frame); });
  };
  plugin.stop = [](turnscan_device* device) { static_cast<Device*>(device)->stop(); };
  plugin.close = [](turnscan_device* device) { delete static_cast<Device*>(device); };
  return plugin;
}

}  // namespace turnscan::plugin

/// Makes the table of a driver, a constant in turnscan::plugin, what the library exports.
#define TURNSCAN_EXPORT_PLUGIN(table)                                                             \
  extern "C" __attribute__((visibility("default"))) const turnscan_plugin* turnscan_plugin_entry( \
      void) {                                                                                     \
    return &turnscan::plugin::table;                                                              \
  }
