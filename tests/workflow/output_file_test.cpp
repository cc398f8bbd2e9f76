#include <gtest/gtest.h>

#include <turnscan/workflow/output_file.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

TEST(OutputFile, HasTheEndingThatIsAskedForAndAFolder) {
  const TempFolder folder;
  EXPECT_TRUE(check_output_file("", ".json"));
  EXPECT_TRUE(check_output_file((folder / "a.JSON").string(), ".json"));
  EXPECT_TRUE(check_output_file("/dev/null", ".json"));
  EXPECT_EQ(check_output_file((folder / "a.txt").string(), ".json").error().code,
            ErrorCode::kInvalidOption);
  EXPECT_EQ(check_output_file((folder / "no/a.json").string(), ".json").error().code,
            ErrorCode::kNotFound);
}

TEST(OutputFile, AFolderIsNewOrEmpty) {
  const TempFolder folder;
  EXPECT_TRUE(check_output_folder(folder.path().string()));
  EXPECT_TRUE(check_output_folder((folder / "new/deep").string()));
  folder.put("file", "");
  EXPECT_EQ(check_output_folder(folder.path().string()).error().code, ErrorCode::kAlreadyExists);
  EXPECT_EQ(check_output_folder((folder / "file").string()).error().code,
            ErrorCode::kAlreadyExists);
  EXPECT_EQ(check_output_folder((folder / "file/below").string()).error().code, ErrorCode::kIo);
}

TEST(OutputFile, GetsASuffixBeforeItsEnding) {
  EXPECT_EQ(with_suffix("dir/bear.ply", "-2"), "dir/bear-2.ply");
  EXPECT_EQ(with_suffix("bear", "-2"), "bear-2");
  EXPECT_EQ(ending_of("dir.d/bear.PLY"), ".ply");
  EXPECT_EQ(ending_of("dir.d/bear"), "");
}

}  // namespace
}  // namespace turnscan
