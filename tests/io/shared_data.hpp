#pragma once

#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace turnscan::testing {

/// A folder of real data that is not part of the project: under $TURNSCAN_TEST_DATA, else under
/// ../shared/data from the project's root. May not exist; then the test skips.
inline std::filesystem::path shared_data(std::string_view name) {
  const char* stated = std::getenv("TURNSCAN_TEST_DATA");
  const std::filesystem::path root =
      stated != nullptr ? std::filesystem::path(stated)
                        : std::filesystem::path(TURNSCAN_SOURCE_DIR) / "../shared/data";
  return root / name;
}

}  // namespace turnscan::testing

#define TURNSCAN_NEEDS_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "there is no " << (path)
