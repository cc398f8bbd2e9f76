#include "tests/support/shared_data.hpp"

#include <cstdlib>

namespace turnscan::testing {

std::filesystem::path shared_data(std::string_view name) {
  const char* stated = std::getenv("TURNSCAN_TEST_DATA");
  const std::filesystem::path root =
      stated != nullptr ? std::filesystem::path(stated)
                        : std::filesystem::path(TURNSCAN_SOURCE_DIR) / "../shared/data";
  return root / name;
}

}  // namespace turnscan::testing
