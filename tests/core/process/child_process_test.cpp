#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>
#include <turnscan/core/process/child_process.hpp>

namespace turnscan::process {
namespace {

Result<ChildResult> shell(const std::string& script, double seconds = 60.0,
                          const RunContext& ctx = {}) {
  const std::vector<std::string> arguments{"-c", script};
  return run_child("/bin/sh", arguments, seconds, ctx);
}

TEST(ChildProcess, GivesExitCodeAndBothOutputs) {
  const auto child = shell("echo out; echo err >&2; exit 7");
  ASSERT_TRUE(child) << child.error().text();
  EXPECT_EQ(child->exit_code, 7);
  EXPECT_EQ(child->signal, 0);
  EXPECT_EQ(child->output, "out\n");
  EXPECT_EQ(child->errors, "err\n");
}

TEST(ChildProcess, PassesArgumentsAsTheyAre) {
  const std::vector<std::string> arguments{"%s|", "a b", "", "$x'\""};
  const auto child = run_child("/usr/bin/printf", arguments, 60.0, {});
  ASSERT_TRUE(child);
  EXPECT_EQ(child->output, "a b||$x'\"|");
}

TEST(ChildProcess, ManyBytesDoNotBlockIt) {
  const auto child = shell("head -c 3000000 /dev/zero");
  ASSERT_TRUE(child);
  EXPECT_EQ(child->output, std::string(3000000, '\0'));
}

TEST(ChildProcess, HasNoInput) { EXPECT_EQ(shell("cat")->output, ""); }

TEST(ChildProcess, TellsTheSignalThatEndedIt) {
  const auto child = shell("kill -SEGV $$");
  ASSERT_TRUE(child);
  EXPECT_EQ(child->signal, SIGSEGV);
  EXPECT_EQ(child->exit_code, -1);
}

TEST(ChildProcess, IsEndedWithItsOwnChildrenAfterTheTimeLimit) {
  const auto child = shell("sleep 600 & wait", 0.05);
  ASSERT_FALSE(child);
  EXPECT_EQ(child.error().code, ErrorCode::kResourceLimit);
}

TEST(ChildProcess, IsEndedWhenCancelled) {
  const RunContext ctx;
  std::thread canceller([&ctx] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ctx.cancel();
  });
  const auto child = shell("sleep 600", 500.0, ctx);
  canceller.join();
  ASSERT_FALSE(child);
  EXPECT_EQ(child.error().code, ErrorCode::kCancelled);
}

TEST(ChildProcess, MissingProgramIsAnError) {
  const auto child = run_child("/no/such/program", {}, 60.0, {});
  // Depending on the C library, starting fails or the child ends with 127.
  if (child) {
    EXPECT_EQ(child->exit_code, 127);
  } else {
    EXPECT_EQ(child.error().code, ErrorCode::kIo);
  }
}

}  // namespace
}  // namespace turnscan::process
