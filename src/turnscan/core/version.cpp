#include <turnscan/core/version.hpp>

namespace turnscan {

const char* version() { return TURNSCAN_VERSION; }

}  // namespace turnscan
