#pragma once

namespace turnscan {

/// Version of the library, e.g. "0.1.0".
const char* version();

}  // namespace turnscan
