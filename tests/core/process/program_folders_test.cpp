#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <turnscan/core/process/program_folders.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::process {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

TEST(ProgramFolders, CodeThatOthersCanReplaceIsNotTrusted) {
  const TempFolder temp;
  fs::create_directory(temp / "plugins");
  const fs::path file = temp.put("plugins/turnscan-x.so", "");
  fs::permissions(file, fs::perms(0755));
  fs::create_symlink(file, temp / "link.so");
  EXPECT_EQ(*trusted(temp / "link.so"), fs::canonical(file)) << "what is judged is what is loaded";
  fs::permissions(file, fs::perms(0757));
  EXPECT_EQ(trusted(file).error().code, ErrorCode::kNoPermission);
  fs::permissions(file, fs::perms(0755));
  fs::permissions(temp / "plugins", fs::perms(0777));
  const auto in_open_folder = trusted(file);
  ASSERT_FALSE(in_open_folder);
  EXPECT_THAT(in_open_folder.error().message, ::testing::HasSubstr("plugins can be written"));
  // Others cannot take away what lies in a folder with the sticky bit.
  fs::permissions(temp / "plugins", fs::perms(01777));
  EXPECT_TRUE(trusted(file));
}

TEST(ProgramFolders, CodeOfOtherUsersIsNotTrusted) {
  if (::geteuid() != 0) GTEST_SKIP() << "only the superuser can give files away";
  const TempFolder temp;
  const fs::path file = temp.put("helper", "");
  ASSERT_EQ(::chown(file.c_str(), 65534, 0), 0);
  EXPECT_THAT(trusted(file).error().message, ::testing::HasSubstr("another user"));
}

TEST(ProgramFolders, WhoCanReplaceTheProgramMayReplaceItsHelpers) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path folder = program.parent_path();
  const auto before = fs::status(folder).permissions();
  fs::permissions(folder, fs::perms(0777));
  EXPECT_TRUE(trusted(program));
  fs::permissions(folder, before);
}

TEST(ProgramFolders, VariablesNameAbsoluteFolders) {
  ::setenv("TURNSCAN_TEST_FOLDERS", "/a::/b/c", 1);
  EXPECT_EQ(*folders_of_variable("TURNSCAN_TEST_FOLDERS"), (std::vector<fs::path>{"/a", "/b/c"}));
  ::setenv("TURNSCAN_TEST_FOLDERS", "/a:b", 1);
  EXPECT_EQ(folders_of_variable("TURNSCAN_TEST_FOLDERS").error().code, ErrorCode::kInvalidOption);
  ::unsetenv("TURNSCAN_TEST_FOLDERS");
  EXPECT_TRUE(folders_of_variable("TURNSCAN_TEST_FOLDERS")->empty());
}

TEST(ProgramFolders, AProgramOfTheBuildTreeHasItsFolder) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto folders = own_folders("lib/turnscan");
  ASSERT_EQ(folders.size(), 1u);
  EXPECT_TRUE(program.string().starts_with(folders[0].parent_path().parent_path().string()));
}

}  // namespace
}  // namespace turnscan::process
