#include <gtest/gtest.h>
#include <unistd.h>

#include <turnscan/io/file/folder.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::file {
namespace {

namespace fs = std::filesystem;

class AFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(base / "own" / "tree" / "deep");
    fs::create_directories(base / "others");
    testing::write_file(base / "others" / "precious", "precious");
    fs::create_directory_symlink(base / "others", base / "own" / "link");
    fs::create_symlink(base / "others" / "precious", base / "own" / "file");
  }
  void expect_precious() const {
    EXPECT_EQ(testing::content_of(base / "others" / "precious"), "precious");
  }
  testing::TempFolder base;
};

TEST_F(AFolder, RefusesLinksInsideButNotToItself) {
  fs::create_directory_symlink(base / "own", base / "to-own");
  const auto folder = Folder::open(base / "to-own");
  ASSERT_TRUE(folder);
  ASSERT_TRUE(folder->subfolder("tree"));
  EXPECT_EQ(folder->subfolder("none").error().code, ErrorCode::kNotFound);
  for (const auto& refused : {folder->subfolder("link"), folder->make_subfolder("link")}) {
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kNoPermission);
  }
  EXPECT_FALSE(folder->read("file")) << "a link is not read";
}

TEST_F(AFolder, RemovesAndReplacesLinksRatherThanWhatTheyLeadTo) {
  fs::create_directory_symlink(base / "others", base / "own" / "tree" / "deep" / "link");
  const auto folder = Folder::open(base / "own");
  ASSERT_TRUE(folder);
  EXPECT_TRUE(folder->write("file", "mine"));
  EXPECT_EQ(testing::content_of(base / "own" / "file"), "mine");
  for (const char* name : {"link", "tree", "none"}) EXPECT_TRUE(folder->remove(name));
  EXPECT_EQ(folder->names(), std::vector<std::string>{"file"});
  expect_precious();
}

TEST_F(AFolder, StaysTheSameFolderWhateverItsNameLeadsTo) {
  const auto folder = Folder::open(base / "own");
  ASSERT_TRUE(folder);
  fs::rename(base / "own", base / "moved");
  fs::create_directory_symlink(base / "others", base / "own");
  EXPECT_TRUE(folder->write("precious", "mine"));
  EXPECT_TRUE(folder->remove("precious"));
  EXPECT_TRUE(fs::exists(folder->anchor() / "tree"));
  expect_precious();
}

TEST_F(AFolder, ExchangesTwoNamesOrLeavesBothAsTheyWere) {
  const auto folder = Folder::open(base / "own");
  ASSERT_TRUE(folder);
  ASSERT_TRUE(folder->write("old", "old") && folder->write("new", "new"));
  ASSERT_TRUE(folder->exchange("new", "old"));
  EXPECT_EQ(*folder->read("old"), "new");
  EXPECT_EQ(*folder->read("new"), "old");
  ASSERT_TRUE(folder->exchange("new", "first"));
  EXPECT_FALSE(folder->has("new"));
  EXPECT_FALSE(folder->exchange("none", "old"));
  EXPECT_EQ(*folder->read("old"), "new");
}

TEST_F(AFolder, OfAnotherUserIsRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only the superuser can give a folder away";
  ASSERT_EQ(::chown((base / "own" / "tree").c_str(), 65534, 65534), 0);
  const auto folder = Folder::open(base / "own");
  ASSERT_TRUE(folder);
  EXPECT_EQ(folder->subfolder("tree").error().code, ErrorCode::kNoPermission);
}

}  // namespace
}  // namespace turnscan::file
