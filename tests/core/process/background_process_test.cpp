#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>
#include <turnscan/core/process/background_process.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::process {
namespace {

class AProgramBeside : public ::testing::Test {
 protected:
  ProcessEnd end_of(const std::string& script) {
    const std::vector<std::string> arguments{"-c", script};
    auto process = BackgroundProcess::start("/bin/sh", arguments, folder / "log", folder.path());
    EXPECT_TRUE(process);
    return wait(*process);
  }
  static ProcessEnd wait(BackgroundProcess& process) {
    for (;;) {
      if (const auto end = process.poll()) return *end;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  testing::TempFolder folder;
};

TEST_F(AProgramBeside, GivesItsExitCodeAndMemory) {
  const ProcessEnd end = end_of("exit 3");
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.signal, 0);
  EXPECT_GT(end.peak_bytes, 100000u);
}

TEST_F(AProgramBeside, GivesTheSignalThatEndedIt) {
  const ProcessEnd end = end_of("kill -9 $$");
  EXPECT_EQ(end.exit_code, -1);
  EXPECT_EQ(end.signal, SIGKILL);
}

TEST_F(AProgramBeside, RunsInItsFolderAndAppendsItsOutputAndErrors) {
  testing::write_file(folder / "log", "before\n");
  EXPECT_EQ(end_of("echo here > made; echo out; echo err >&2").exit_code, 0);
  EXPECT_EQ(testing::content_of(folder / "log"), "before\nout\nerr\n");
  EXPECT_EQ(testing::content_of(folder / "made"), "here\n");
}

TEST_F(AProgramBeside, ThatIsNotThereExitsAsInAShell) {
  auto process = BackgroundProcess::start(folder / "none", {}, folder / "log");
  ASSERT_TRUE(process);
  EXPECT_EQ(wait(*process).exit_code, 127);
}

TEST_F(AProgramBeside, IsStoppedAndEndsWithItsObject) {
  const std::vector<std::string> arguments{"-c", "sleep 100"};
  auto asked = BackgroundProcess::start("/bin/sh", arguments, folder / "log");
  ASSERT_TRUE(asked);
  EXPECT_FALSE(asked->poll());
  asked->stop(true);
  EXPECT_EQ(wait(*asked).signal, SIGKILL);
  const auto dropped = BackgroundProcess::start("/bin/sh", arguments, folder / "log");
  EXPECT_TRUE(dropped) << "and its destructor does not wait 100 s";
}

}  // namespace
}  // namespace turnscan::process
