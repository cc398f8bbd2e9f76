#pragma once

#include <filesystem>
#include <string_view>

namespace turnscan::testing {

/// A folder of real data that is not part of the project: under $TURNSCAN_TEST_DATA, else under
/// ../shared/data from the project's root. May not exist; then the test skips.
std::filesystem::path shared_data(std::string_view name);

}  // namespace turnscan::testing

#define TURNSCAN_NEEDS_DATA(path) \
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "there is no " << (path)
