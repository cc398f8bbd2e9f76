#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <turnscan/core/process/process_setup.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::process {
namespace {

TEST(ProcessSetup, NoFileGetsTheNumberOfAClosedStandardStream) {
  const testing::TempFolder temp;
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int standard : {0, 1, 2}) ::close(standard);
    set_up_process();
    const int file = ::open((temp / "a").c_str(), O_WRONLY | O_CREAT, 0666);
    const bool spoken = ::write(1, "words", 5) == 5;
    ::_exit(file > 2 && spoken ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(testing::content_of(temp / "a"), "");
}

}  // namespace
}  // namespace turnscan::process
