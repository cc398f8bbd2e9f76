#include <gtest/gtest.h>

#include <turnscan/io/file/existence.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::file {
namespace {

namespace fs = std::filesystem;
using turnscan::testing::TempFolder;

TEST(Existence, OnlyWhatIsNotThereIsMissing) {
  const TempFolder folder;
  folder.put("file", "x");
  fs::create_symlink("nowhere", folder / "dangling");
  EXPECT_TRUE(is_there(folder / "file").value());
  EXPECT_TRUE(is_there(folder.path()).value());
  for (const char* name : {"none", "none/below", "file/below", "dangling"})
    EXPECT_FALSE(is_there(folder / name).value()) << name;
}

TEST(Existence, WhatCannotBeLookedAtIsNotMissing) {
  const TempFolder folder;
  // To the superuser, too, whom no permission stops.
  fs::create_symlink("loop", folder / "loop");
  const std::string long_name(300, 'a');
  for (const auto& path : {folder / "loop", folder / "loop/below", folder / long_name}) {
    const auto there = is_there(path);
    ASSERT_FALSE(there) << path;
    EXPECT_EQ(there.error().code, ErrorCode::kIo);
    EXPECT_EQ(check_exists(path, "file").error().code, ErrorCode::kIo);
  }
}

}  // namespace
}  // namespace turnscan::file
