#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <turnscan/io/file/file_lock.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::file {
namespace {

class LockedFile : public ::testing::Test {
 protected:
  testing::TempFolder folder;
  const Folder opened = std::move(*Folder::open(folder.path()));
};

TEST_F(LockedFile, HasOneHolderAtATime) {
  EXPECT_FALSE(FileLock::held(opened, "lock")) << "there is no such file";
  auto first = FileLock::try_lock(opened, "lock");
  ASSERT_TRUE(first && *first);
  EXPECT_TRUE(FileLock::held(opened, "lock"));
  const auto second = FileLock::try_lock(opened, "lock");
  ASSERT_TRUE(second);
  EXPECT_FALSE(*second);
  first->reset();
  EXPECT_FALSE(FileLock::held(opened, "lock"));
  EXPECT_TRUE(*FileLock::try_lock(opened, "lock"));
}

TEST_F(LockedFile, IsFreeWhenItsHolderIsKilled) {
  const pid_t child = ::fork();
  if (child == 0) {
    const auto lock = FileLock::try_lock(opened, "lock");
    ::raise(SIGKILL);
    ::_exit(lock ? 0 : 1);
  }
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(*FileLock::try_lock(opened, "lock"));
}

TEST_F(LockedFile, IsWaitedForUntilCancelled) {
  const auto held = FileLock::try_lock(opened, "lock");
  RunContext context;
  context.cancel();
  const auto lock = FileLock::wait(opened, "lock", context);
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().code, ErrorCode::kCancelled);
}

TEST_F(LockedFile, FailsWhereItCannotBeMade) {
  const auto lock = FileLock::try_lock(opened, "no/lock");
  ASSERT_FALSE(lock);
  EXPECT_EQ(lock.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace turnscan::file
