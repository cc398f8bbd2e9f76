#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <turnscan/io/file/atomic_file.hpp>

#include "tests/io/scarcity.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::content_of;
using testing::FullDisk;
using ::testing::HasSubstr;
using testing::NoPrivileges;
using testing::TempFolder;

TEST(AtomicFile, GivesTheBytesThatWereWritten) {
  const TempFolder folder;
  for (const std::size_t size : {0U, 1U, 65535U, 65536U, 65537U, 300000U}) {
    std::string text(size, 'x');
    for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>(i * 31 >> 3);
    ASSERT_TRUE(write_file_atomically(folder / "f", std::string_view(text)));
    const auto back = read_file(folder / "f");
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, text);
  }
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, KeepsTheOrderOfSmallAndLargePieces) {
  const TempFolder folder;
  std::string expected;
  const auto body = [&expected](FileSink& sink) -> Result<> {
    for (std::size_t i = 0; i < 200; ++i) {
      const std::string piece(i * i % 90000, static_cast<char>('a' + i % 26));
      expected += piece;
      TURNSCAN_TRY(sink.write(piece));
    }
    return {};
  };
  ASSERT_TRUE(write_file_atomically(folder / "f", body));
  EXPECT_EQ(content_of(folder / "f"), expected);
}

TEST(AtomicFile, LeavesTheOldContentWhenTheBodyFails) {
  const TempFolder folder;
  const auto path = folder.put("f", "old");
  const auto body = [](FileSink& sink) -> Result<> {
    TURNSCAN_TRY(sink.write(std::string(100000, 'n')));
    return fail(ErrorCode::kCancelled, "cancelled");
  };
  const auto result = write_file_atomically(path, body);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, LeavesTheOldContentWhenTheBodyThrows) {
  const TempFolder folder;
  const auto path = folder.put("f", "old");
  const auto body = [](FileSink&) -> Result<> { throw std::runtime_error("broken"); };
  EXPECT_THROW((void)write_file_atomically(path, body), std::runtime_error);
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, FullDiskIsAnIoErrorInTheSystemsWordsAndLeavesNothing) {
  const TempFolder folder;
  const auto path = folder.put("f", "old");
  Result<> result;
  {
    const FullDisk full(100000);
    result = write_file_atomically(path, std::string_view(std::string(200000, 'x')));
  }
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kIo);
  EXPECT_THAT(result.error().text(), HasSubstr("File too large"));
  EXPECT_THAT(result.error().text(), HasSubstr(path.string()));
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(folder.count(), 1U);
}

TEST(AtomicFile, DeviceIsWrittenToDirectlyAndTellsWhenItIsFull) {
  const TempFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "full");
  const auto result = write_file_atomically(folder / "full", "text");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kIo);
  EXPECT_THAT(result.error().text(), HasSubstr("No space left on device"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  std::filesystem::create_symlink("/dev/null", folder / "null");
  EXPECT_TRUE(write_file_atomically(folder / "null", "text"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, FollowsASymbolicLink) {
  const TempFolder folder;
  std::filesystem::create_symlink("target", folder / "link");
  ASSERT_TRUE(write_file_atomically(folder / "link", "text"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(content_of(folder / "target"), "text");
}

TEST(AtomicFile, KeepsThePermissionsOfAFileThatItReplaces) {
  const TempFolder folder;
  const auto path = folder.put("f", "old");
  ::chmod(path.c_str(), 0640);
  ASSERT_TRUE(write_file_atomically(path, "new"));
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST(AtomicFile, NewFileGetsThePermissionsOfTheUmask) {
  const TempFolder folder;
  const mode_t old = ::umask(027);
  ASSERT_TRUE(write_file_atomically(folder / "f", "new"));
  ::umask(old);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "f").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST(AtomicFile, MissingFolderIsNotFound) {
  const TempFolder folder;
  const auto result = write_file_atomically(folder / "no/such/f", "text");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(result.error().text(), HasSubstr("No such file or directory"));
}

TEST(AtomicFile, FolderAsAFileIsAnIoError) {
  const TempFolder folder;
  for (const auto& error :
       {write_file_atomically(folder.path(), "text").error(), read_file(folder.path()).error()}) {
    EXPECT_EQ(error.code, ErrorCode::kIo);
    EXPECT_THAT(error.text(), HasSubstr("Is a directory"));
  }
}

TEST(AtomicFile, DeniedPermissionIsAnIoError) {
  const TempFolder folder;
  const auto path = folder.put("f", "text");
  ::chmod(path.c_str(), 0);
  ::chmod(folder.path().c_str(), 0555);
  {
    const NoPrivileges nobody;
    for (const auto& result : {write_file_atomically(folder / "g", "text"),
                               read_file(path).map([](const std::string&) {})}) {
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, ErrorCode::kIo);
      EXPECT_THAT(result.error().text(), HasSubstr("Permission denied"));
    }
  }
  ::chmod(folder.path().c_str(), 0755);
}

TEST(ReadFile, RefusesWhatIsMissingTooLongOrNotAFile) {
  const TempFolder folder;
  const auto path = folder.put("f", "12345");
  EXPECT_EQ(read_file(folder / "none").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_file(path / "below").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_file(path, 4).error().code, ErrorCode::kResourceLimit);
  EXPECT_EQ(read_file(path, 5).value(), "12345");
  EXPECT_EQ(read_file("/dev/zero").error().code, ErrorCode::kIo);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_file(folder / "pipe").error().code, ErrorCode::kIo);
}

TEST(AtomicFile, WhatAKilledProcessOfTheSameNumberLeftIsNoObstacle) {
  const TempFolder folder;
  for (int i = 0; i < 300; ++i)
    folder.put(fmt::format(".a.{}-{}.part", ::getpid(), i), "left behind");
  ASSERT_TRUE(write_file_atomically(folder / "a", std::string_view("new")));
  EXPECT_EQ(testing::content_of(folder / "a"), "new");
  EXPECT_EQ(folder.count(), 301u);
}

TEST(AtomicFile, VerifiedWritingReplacesTheWholeFile) {
  const TempFolder folder;
  folder.put("a", "old");
  ASSERT_TRUE(write_file_verified(folder / "a", "new"));
  EXPECT_EQ(testing::content_of(folder / "a"), "new");
  EXPECT_FALSE(write_file_verified(folder / "no/a", "new"));
}

}  // namespace
}  // namespace turnscan
