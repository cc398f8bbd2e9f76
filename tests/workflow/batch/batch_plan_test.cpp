#include <gtest/gtest.h>

#include <turnscan/workflow/batch/batch_plan.hpp>
#include <turnscan/workflow/batch/batch_table.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

class PlanOf : public ::testing::Test {
 protected:
  /// What find_recordings() takes for one.
  void add_recording(const std::string& name) {
    std::filesystem::create_directories(folder / name);
    testing::write_file(folder / name / "recording.json", "{}");
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string canonical(const std::string& name) const {
    return std::filesystem::weakly_canonical(folder / name).string();
  }
  std::string error_of(const BatchSource& source) const {
    const auto plan = plan_batch(source);
    EXPECT_FALSE(plan);
    return plan ? "" : plan.error().text();
  }
  testing::TempFolder folder;
};

std::vector<std::string> names_of(const std::vector<BatchTask>& tasks) {
  std::vector<std::string> names;
  for (const BatchTask& task : tasks) names.push_back(task.name);
  return names;
}

using Names = std::vector<std::string>;

TEST_F(PlanOf, AFolderHasATaskForEachRecordingBelowIt) {
  for (const char* name : {"b", "a", "shelf/vase 1", "done/tasks/x/result/recording"})
    add_recording(name);
  testing::write_file(folder / "done" / "batch.json", "{}");
  const auto plan = plan_batch({{folder.path().string()}, {}, {}, {}});
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(names_of(*plan), (Names{"a", "b", "shelf_vase_1"})) << "and none of a batch in it";
  EXPECT_EQ(plan->at(2).inputs, Names{canonical("shelf/vase 1")});
  const auto results = plan_batch({{path("done")}, {}, {}, {}});
  ASSERT_TRUE(results) << results.error().text();
  EXPECT_EQ(names_of(*results), Names{"x"}) << "a batch itself gives its results";
}

TEST_F(PlanOf, FilesOfOtherProgramsAreTasksWithTheOptionsOfTheirImport) {
  add_recording("shelf/a");
  testing::write_file(folder / "shelf" / "take.bag", "#ROSBAG V2.0\n");
  testing::write_file(folder / "shelf" / "table.json", "{}");
  const auto plan = plan_batch({{folder.path().string()}, {}, {"import=depth-unit=1mm"}, {}});
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(names_of(*plan), (Names{"shelf_a", "shelf_take"})) << "JSON may be of any program";
  EXPECT_EQ(plan->at(1).options, (BatchOptions{{"import", "depth-unit=1mm"}}));
  const auto alone = plan_batch({{path("shelf/take.bag")}, {}, {}, {}});
  ASSERT_TRUE(alone) << alone.error().text();
  EXPECT_EQ(names_of(*alone), Names{"take"});
  EXPECT_NE(error_of({{path("shelf/take.bag")}, {}, {"import=thinner=1"}, {}}).find("thinner"),
            std::string::npos);
}

TEST_F(PlanOf, ASweepIsEveryCombination) {
  add_recording("a");
  const auto plan = plan_batch({{path("a")},
                                {},
                                {"voxel-size=3mm", "thinner=1"},
                                {"voxel-size=1mm,2mm", "colour=true,false"}});
  ASSERT_FALSE(plan) << "thinner is no option";
  const auto swept = plan_batch(
      {{path("a")}, {}, {"voxel-size=3mm"}, {"voxel-size=1mm,2mm", "colour=true,false"}});
  ASSERT_TRUE(swept) << swept.error().text();
  EXPECT_EQ(names_of(*swept),
            (Names{"a_voxel-size=1mm_colour=true", "a_voxel-size=1mm_colour=false",
                   "a_voxel-size=2mm_colour=true", "a_voxel-size=2mm_colour=false"}));
  EXPECT_EQ(swept->at(1).options, (BatchOptions{{"voxel-size", "1mm"}, {"colour", "false"}}));
  EXPECT_TRUE(plan_batch({{path("a")}, {}, {"up=z"}, {}}));
  EXPECT_FALSE(plan_batch({{path("a")}, {}, {"up=x"}, {}}));
  const auto words = arguments_of(swept->at(1), 2);
  EXPECT_EQ(words, (Names{"reconstruct", "--out=mesh.ply", "--report=report.json", "--threads=2",
                          "--quiet", "--voxel-size=1mm", "--no-colour", "--", canonical("a")}));
}

TEST_F(PlanOf, ACsvTableGivesEachTaskItsOptions) {
  for (const char* name : {"one", "two", "more"}) add_recording(name);
  testing::write_file(folder / "shelf.csv",
                      "name,recording,method,voxel-size\n# a comment\nvase,one,volumetric,1mm\n"
                      "\"jug\",two;more,,\n");
  const auto plan = plan_batch({{path("shelf.csv")}, {}, {"voxel-size=2mm"}, {}});
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(names_of(*plan), (Names{"vase", "jug"}));
  EXPECT_EQ(plan->at(0).options, (BatchOptions{{"method", "volumetric"}, {"voxel-size", "2mm"}}))
      << "the command line takes precedence";
  EXPECT_EQ(plan->at(1).inputs, (Names{canonical("two"), canonical("more")}));
}

TEST_F(PlanOf, ATomlTableHasOptionsSweepsAndTasks) {
  add_recording("one");
  testing::write_file(folder / "table.json", "{}");
  testing::write_file(folder / "shelf.toml",
                      "[options]\nmethod = \"volumetric\"\nturntable = \"table.json\"\n[sweep]\n"
                      "voxel-size = [\"1mm\", \"2mm\"]\n[[task]]\nname = \"vase\"\n"
                      "recording = \"one\"\nmethod = \"poisson\"\n");
  const auto plan = plan_batch({{path("shelf.toml")}, {}, {}, {}});
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(names_of(*plan), (Names{"vase_voxel-size=1mm", "vase_voxel-size=2mm"}));
  EXPECT_EQ(plan->at(0).options, (BatchOptions{{"turntable", canonical("table.json")},
                                               {"method", "poisson"},
                                               {"voxel-size", "1mm"}}))
      << "paths are seen from the table's folder";
}

TEST_F(PlanOf, SimulationsAreNamedAfterTheirObjects) {
  const auto plan = plan_batch(
      {{"builtin:doll"}, "simulate", {"frames=12"}, {"scanner=kinect-v2;realsense-d435"}});
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(names_of(*plan), (Names{"doll_scanner=kinect-v2", "doll_scanner=realsense-d435"}));
  EXPECT_EQ(plan->at(0).frames, 12u);
}

TEST_F(PlanOf, WhatIsWrongIsSaidBeforeTheWorkBegins) {
  add_recording("one");
  testing::write_file(folder / "bad.csv", "name,recording,voxel-size\na,one,1mm\na,one,2mm\n");
  EXPECT_NE(error_of({{path("bad.csv")}, {}, {}, {}}).find("bad.csv:3"), std::string::npos);
  testing::write_file(folder / "few.csv", "name,recording\na\n");
  EXPECT_NE(error_of({{path("few.csv")}, {}, {}, {}}).find("few.csv:2"), std::string::npos);
  testing::write_file(folder / "none.csv", "name\na\n");
  EXPECT_NE(error_of({{path("none.csv")}, {}, {}, {}}).find("recording"), std::string::npos);
  EXPECT_NE(error_of({{path("one")}, {}, {"voxel-size=large"}, {}}).find("voxel-size"),
            std::string::npos);
  EXPECT_NE(error_of({{path("one")}, {}, {"voxel-sise=1mm"}, {}}).find("voxel-size"),
            std::string::npos)
      << "the nearest option is named";
  EXPECT_NE(error_of({{path("one")}, {}, {"voxel-size"}, {}}).find("NAME=VALUE"),
            std::string::npos);
  EXPECT_NE(error_of({{path("one")}, "melt", {}, {}}).find("simulate"), std::string::npos);
  std::filesystem::create_directories(folder / "empty");
  EXPECT_NE(error_of({{path("empty")}, {}, {}, {}}).find("no recording"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
