#pragma once
// A driver's device as a source of frames.

#include <turnscan/capture/source/plugin.h>
#include <turnscan/capture/source/grabber.hpp>

namespace turnscan::source {

/// Loads the driver for a scheme. What is loaded stays until the process ends. Fails with kNotFound
/// when no folder has one, kLibrary when it cannot be loaded or was made for another version.
Result<const turnscan_plugin*> load_plugin(const std::string& scheme);

/// The error of a driver's function that returned this status.
tl::unexpected<Error> plugin_failure(const turnscan_plugin& plugin, std::int32_t status,
                                     const turnscan_error& error);

/// Fails as load_plugin, with kInvalidOption for parameters that the driver does not know, and as
/// the driver says.
Result<std::unique_ptr<Grabber>> open_plugin(const SourceUri& uri, const RunContext& context);

/// The device of a driver that is there. Fails as open_plugin() then does.
Result<std::unique_ptr<Grabber>> open_device(const turnscan_plugin& plugin, const SourceUri& uri);

}  // namespace turnscan::source
