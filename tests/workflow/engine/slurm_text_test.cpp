#include <gtest/gtest.h>

#include <turnscan/workflow/engine/slurm_text.hpp>

namespace turnscan::engine {
namespace {

TEST(SlurmText, StatesOfElementsAreReadAndStepsLeftOut) {
  const auto states = parse_slurm_states(
      "12_0|PENDING|Resources\n12_3|RUNNING|None\n12_4.batch|COMPLETED|\n12|FAILED|\n\n"
      "12_[5-9]|PENDING|Priority\n12_4|CANCELLED by 1000|None\n13_2|NODE_FAIL|NodeDown");
  ASSERT_EQ(states.size(), 4u);
  EXPECT_EQ(states.at({"12", 0}).reason, "Resources");
  EXPECT_EQ(states.at({"12", 4}).state, "CANCELLED");
  EXPECT_TRUE(is_live(states.at({"12", 0})));
  EXPECT_TRUE(is_live(states.at({"12", 3})));
  EXPECT_FALSE(is_live(states.at({"12", 4})));
  EXPECT_TRUE(is_lost(states.at({"13", 2})));
  EXPECT_FALSE(is_lost(states.at({"12", 4})));
}

TEST(SlurmText, ReasonsSayWhatToDo) {
  EXPECT_EQ(reason_of({"COMPLETED", "None"}), "");
  EXPECT_NE(reason_of({"OUT_OF_MEMORY", ""}).find("--mem"), std::string::npos);
  EXPECT_NE(reason_of({"TIMEOUT", "TimeLimit"}).find("--time"), std::string::npos);
  EXPECT_EQ(reason_of({"CANCELLED", "None"}), "Slurm: CANCELLED");
}

TEST(SlurmText, NumbersOfJobsAreRead) {
  EXPECT_EQ(parse_job_number("123\n"), "123");
  EXPECT_EQ(parse_job_number("123;cluster\n"), "123");
  EXPECT_FALSE(parse_job_number("sbatch: error"));
  EXPECT_FALSE(parse_job_number(""));
}

TEST(SlurmText, ValuesOfTheConfigurationAreRead) {
  const std::string config = "Configuration data\nMaxArraySize            = 1001\nX = a=b\n";
  EXPECT_EQ(config_value(config, "MaxArraySize"), "1001");
  EXPECT_EQ(config_value(config, "X"), "a=b");
  EXPECT_FALSE(config_value(config, "Max"));
}

TEST(SlurmText, WordsAreSplitAsAShellSplitsThem) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(split_words(" --mem=4G  --comment='a b' -p \"x\"y ''"),
            (Words{"--mem=4G", "--comment=a b", "-p", "xy", ""}));
  EXPECT_EQ(split_words(""), Words());
  EXPECT_FALSE(split_words("'open"));
  EXPECT_EQ(quoted_word("it's"), "'it'\\''s'");
}

}  // namespace
}  // namespace turnscan::engine
