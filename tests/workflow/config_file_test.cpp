#include <gtest/gtest.h>

#include <turnscan/workflow/config_file.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

class ConfigFile : public ::testing::Test {
 protected:
  ConfigFile() {
    groups[0].table.number("voxel-size", size_m, Quantity::kLength, {1e-4, 0.1}, "");
    groups[1].table.flag("colour", color, "");
  }
  Result<> read(std::string_view text) {
    return read_config_file(folder.put("options.toml", text).string(), groups);
  }
  std::string error_of(std::string_view text) {
    const auto result = read(text);
    return result ? "" : result.error().message;
  }

  TempFolder folder;
  double size_m = 0.01;
  bool color = false;
  std::deque<OptionGroup> groups{{"voxels", {}}, {"surface", {}}};
};

TEST_F(ConfigFile, SetsFieldsAtTheTopAndInTheirTables) {
  ASSERT_TRUE(read("colour = true\n[voxels]\nvoxel-size = \"2mm\"\n"));
  EXPECT_TRUE(color);
  EXPECT_DOUBLE_EQ(size_m, 0.002);
}

TEST_F(ConfigFile, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_NE(error_of("\nvoxel-sise = \"2mm\"\n").find("options.toml:2: "), std::string::npos);
  EXPECT_NE(error_of("voxel-sise = \"2mm\"\n").find("voxel-size"), std::string::npos);
  EXPECT_NE(error_of("[surface]\nvoxel-size = \"2mm\"\n").find("move it to [voxels]"),
            std::string::npos);
  EXPECT_NE(error_of("[voxel]\n").find("use one of [voxels], [surface]"), std::string::npos);
  EXPECT_NE(error_of("voxel-size = \"2m\"\n"), "");
  EXPECT_NE(error_of("voxel-size = [1, 2]\n"), "");
  EXPECT_NE(error_of("voxel-size = \n").find("not TOML"), std::string::npos);
}

TEST_F(ConfigFile, MustExist) {
  const auto result = read_config_file((folder / "none.toml").string(), groups);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kNotFound);
}

TEST_F(ConfigFile, WhatTheParserCannotBearIsRefusedBefore) {
  const auto expect = [this](const std::string& text, const std::string& why) {
    const std::string error = error_of("# first\n" + text);
    EXPECT_NE(error.find("options.toml:2: this line " + why), std::string::npos)
        << error.substr(0, 300);
    EXPECT_LT(error.size(), 300u);
  };
  std::string dots = "a";
  for (int i = 0; i < 1000; ++i) dots += ".a";
  expect("[" + dots + "]", "has a key of more than 32 parts");
  expect(dots + " = 1", "has a key of more than 32 parts");
  expect(std::string(1000000, 'k') + " = 1", "has more than 4096 bytes");
  expect("a = " + std::string(2000, '['), "nests lists and tables more than 32 deep");
}

}  // namespace
}  // namespace turnscan
