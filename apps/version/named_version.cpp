#include <turnscan/core/version.hpp>
#include <version/named_version.hpp>

namespace turnscan {

std::string named_version() {
  const std::string revision = kRevision;
  return revision.empty() ? version() : std::string(version()) + " (" + revision + ")";
}

}  // namespace turnscan
