#include <gtest/gtest.h>

#include <set>
#include <turnscan/workflow/engine/local_engine.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::engine {
namespace {

/// Jobs are shell scripts: their name is the last argument, $0.
class ALocalEngine : public ::testing::Test {
 protected:
  std::unique_ptr<Engine> engine(const std::string& script, const LocalLimits& limits) {
    return make_local_engine({"/bin/sh", {"-c", "cd '" + folder.path().string() + "'; " + script}},
                             limits, std::move(*file::Folder::open(folder.path())));
  }
  static std::vector<Ended> run(Engine& engine, std::size_t count) {
    std::vector<Ended> all;
    while (all.size() < count) {
      const auto ended = engine.poll();
      if (!ended) break;
      all.insert(all.end(), ended->begin(), ended->end());
    }
    return all;
  }
  testing::TempFolder folder;
};

TEST_F(ALocalEngine, RunsEveryJobOnceInTheirOrder) {
  const auto e = engine("echo $0 >> order", {1, 1000});
  ASSERT_TRUE(e->submit({{"c", 1}, {"a", 1}, {"b", 1}}));
  EXPECT_EQ(run(*e, 3).size(), 3u);
  EXPECT_EQ(testing::content_of(folder / "order"), "c\na\nb\n");
}

TEST_F(ALocalEngine, NeverRunsMoreAtOnceThanMemoryAllows) {
  // Each writes how many are there, and stays a while.
  const auto e = engine("touch in.$0; ls in.* | wc -l >> counts; sleep 0.05; rm in.$0", {8, 250});
  ASSERT_TRUE(e->submit({{"a", 100}, {"b", 100}, {"c", 100}, {"d", 100}, {"big", 900}}));
  EXPECT_EQ(run(*e, 5).size(), 5u) << "what is larger than all memory runs alone";
  for (const char c : testing::content_of(folder / "counts"))
    if (c != '\n') {
      EXPECT_LE(c, '2');
    }
}

TEST_F(ALocalEngine, SaysWhyAJobHasEnded) {
  const auto e = engine(
      "if [ $0 = bad ]; then echo first; echo the reason; exit 1; fi; "
      "if [ $0 = killed ]; then kill -9 $$; fi",
      {1, 1000});
  ASSERT_TRUE(e->submit({{"bad", 1}, {"killed", 1}, {"good", 1}}));
  const auto ended = run(*e, 3);
  ASSERT_EQ(ended.size(), 3u);
  EXPECT_EQ(ended[0].reason, "the reason");
  EXPECT_NE(ended[1].reason.find("signal 9"), std::string::npos);
  EXPECT_TRUE(ended[1].lost);
  EXPECT_FALSE(ended[0].lost);
  EXPECT_EQ(ended[2].reason, "");
}

TEST_F(ALocalEngine, CancelsWhatRunsAndWhatWaits) {
  const auto e = engine("touch began.$0; sleep 100", {2, 1000});
  ASSERT_TRUE(e->submit({{"a", 1}, {"b", 1}, {"c", 1}}));
  e->cancel();
  EXPECT_FALSE(std::filesystem::exists(folder / "began.c"));
}

}  // namespace
}  // namespace turnscan::engine
