#pragma once
// Drivers of real sensors: shared libraries that are searched for at run time
// (capture/source/plugin.h defines their interface).

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// A device found by a driver.
struct FoundDevice {
  std::string uri;  ///< as accepted by open_source
  std::string model;
  std::string serial;  ///< empty: not known
};

/// A driver and its status.
struct DriverState {
  std::string name;         ///< URI scheme
  std::string description;  ///< empty if it could not be loaded
  std::filesystem::path file;
  std::string error;  ///< one sentence on why it cannot be used; empty: it works
  std::vector<FoundDevice> devices;
  struct Parameter {
    std::string name, help, default_value;
  };
  std::vector<Parameter> parameters;
};

/// Folders in which drivers are searched for, in order: those of the variable TURNSCAN_PLUGINS
/// (separated by ':') and no others if it is set; else lib/turnscan/plugins next to the folder of
/// the running program or one of the three above it; else the installation folder.
std::vector<std::filesystem::path> plugin_folders();

/// All drivers, sorted by name. Asks each for its devices, which some take a moment to answer.
std::vector<DriverState> list_drivers();

}  // namespace turnscan
