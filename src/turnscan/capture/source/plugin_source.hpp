#pragma once
// A driver's device as a source of frames.

#include <turnscan/capture/source/plugin.h>
#include <turnscan/capture/source/grabber.hpp>

namespace turnscan::source {

/// Loads the driver for a scheme. A loaded driver stays until the process ends. Fails with
/// kNotFound if no folder has one, kLibrary if it cannot be loaded or was built for another
/// version.
Result<const turnscan_plugin*> load_plugin(const std::string& scheme);

/// Converts the status returned by a driver's function into an error.
tl::unexpected<Error> plugin_failure(const turnscan_plugin& plugin, std::int32_t status,
                                     const turnscan_error& error);

/// Fails as load_plugin, with kInvalidOption for parameters that the driver does not know, and with
/// the driver's own errors.
Result<std::unique_ptr<Grabber>> open_plugin(const SourceUri& uri, const RunContext& context);

/// Opens the device with a loaded driver. Fails as open_plugin() does after loading.
Result<std::unique_ptr<Grabber>> open_device(const turnscan_plugin& plugin, const SourceUri& uri);

}  // namespace turnscan::source
