#pragma once
// What the plug-ins share: errors, texts and parameters across the C interface.

#include <turnscan/capture/plugin.h>

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <utility>

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

/// The table of a driver whose device is a class with a constructor (address, parameters, count),
/// describe(info), start(), stop() and grab(timeout_s, frame).
template <class Device>
constexpr turnscan_plugin plugin_of(const char* name, const char* description,
                                    const turnscan_parameter_info* parameters, std::int32_t count,
                                    std::int32_t (*list)(turnscan_device_entry*, std::int32_t,
                                                         turnscan_error*)) {
  turnscan_plugin plugin{};
  plugin.version = TURNSCAN_PLUGIN_VERSION;
  plugin.name = name;
  plugin.description = description;
  plugin.parameters = parameters;
  plugin.parameter_count = count;
  plugin.list = list;
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

#define TURNSCAN_PLUGIN_EXPORT extern "C" __attribute__((visibility("default")))
