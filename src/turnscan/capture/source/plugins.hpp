#pragma once
// Drivers of real sensors: shared libraries that are looked for when the program runs
// (capture/source/plugin.h is what they offer).

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// A device that a driver has found.
struct FoundDevice {
  std::string uri;  ///< that open_source takes
  std::string model;
  std::string serial;  ///< empty: unknown
};

/// A driver, and whether it works.
struct DriverState {
  std::string name;         ///< scheme of its URIs
  std::string description;  ///< empty where it could not be loaded
  std::filesystem::path file;
  std::string error;  ///< why it cannot be used, one sentence; empty: it can
  std::vector<FoundDevice> devices;
  struct Parameter {
    std::string name, help, default_value;
  };
  std::vector<Parameter> parameters;
};

/// Folders in which drivers are looked for, the first one first: those of the variable
/// TURNSCAN_PLUGINS (with ':' between them) and no others where it is set; else
/// lib/turnscan/plugins beside the folder of the running program or one of the three above it; else
/// where they were to be installed.
std::vector<std::filesystem::path> plugin_folders();

/// All drivers, sorted by name. Asks each for its devices, which takes a moment with some.
std::vector<DriverState> list_drivers();

}  // namespace turnscan
