#include <unistd.h>

#include <array>
#include <turnscan/core/process/host_name.hpp>

namespace turnscan::process {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace turnscan::process
