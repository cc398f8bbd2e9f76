#include <gtest/gtest.h>

#include <turnscan/workflow/batch/batch_folder.hpp>
#include <turnscan/workflow/batch/fingerprint.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::batch {
namespace {

class AFingerprint : public ::testing::Test {
 protected:
  AFingerprint() {
    std::filesystem::create_directories(folder / "scan" / "depth");
    testing::write_file(folder / "scan" / "recording.json", "{}");
    testing::write_file(folder / "scan" / "depth" / "0.png", "first");
    task.name = "scan";
    task.inputs = {(folder / "scan").string()};
    task.options = {{"voxel-size", "1mm"}};
    inputs = *prints_of(task);
    digest = digest_of(task, inputs);
  }
  testing::TempFolder folder;
  BatchTask task;
  std::vector<InputPrint> inputs;
  std::string digest;
};

TEST_F(AFingerprint, HoldsAsLongAsNothingChanges) {
  EXPECT_TRUE(is_current(task, digest, inputs));
  testing::write_file(folder / "scan" / "depth" / "0.png", "first");
  EXPECT_TRUE(is_current(task, digest, inputs)) << "another time, the same content";
}

TEST_F(AFingerprint, ChangesWithAnyContent) {
  testing::write_file(folder / "scan" / "depth" / "0.png", "fi7st");
  EXPECT_FALSE(is_current(task, digest, inputs));
}

TEST_F(AFingerprint, ChangesWithTheFilesOfAFolder) {
  testing::write_file(folder / "scan" / "depth" / "1.png", "");
  EXPECT_FALSE(is_current(task, digest, inputs));
  std::filesystem::remove_all(folder / "scan");
  EXPECT_FALSE(is_current(task, digest, inputs)) << "what is missing is not what it was";
}

TEST_F(AFingerprint, ChangesWithTheOptionsAndFilesThatTheyName) {
  BatchTask other = task;
  other.options = {{"voxel-size", "2mm"}};
  EXPECT_FALSE(is_current(other, digest, inputs));
  testing::write_file(folder / "table.json", "{}");
  other.options = {{"turntable", (folder / "table.json").string()}};
  const auto prints = *prints_of(other);
  ASSERT_EQ(prints.size(), 2u);
  const std::string with_file = digest_of(other, prints);
  EXPECT_TRUE(is_current(other, with_file, prints));
  testing::write_file(folder / "table.json", "{1}");
  EXPECT_FALSE(is_current(other, with_file, prints));
}

TEST_F(AFingerprint, DoesNotChangeWithThePlaceOfTheInput) {
  std::filesystem::rename(folder / "scan", folder / "moved");
  task.inputs = {(folder / "moved").string()};
  EXPECT_EQ(digest_of(task, *prints_of(task)), digest);
}

TEST_F(AFingerprint, StandsBesideAResultAndIsReadBack) {
  const BatchFolder batch(folder / "batch");
  ASSERT_TRUE(batch.save_plan({task}));
  EXPECT_EQ(task_json(batch.load_plan()->at(0)), task_json(task));
  EXPECT_EQ(current_record(batch, task).state, TaskState::kWaiting);
  TaskRecord record;
  record.state = TaskState::kDone;
  record.digest = digest;
  record.inputs = inputs;
  record.attempts = 2;
  record.reason = "a \"reason\"\nof two lines";
  ASSERT_TRUE(batch.save_record("scan", record));
  EXPECT_EQ(record_json(batch.record("scan")), record_json(record));
  EXPECT_EQ(current_record(batch, task).state, TaskState::kWaiting) << "there is no result";
  std::filesystem::create_directories(batch.result_folder("scan"));
  EXPECT_EQ(current_record(batch, task).state, TaskState::kDone);
  testing::write_file(folder / "scan" / "recording.json", "{ }");
  EXPECT_EQ(current_record(batch, task).state, TaskState::kWaiting) << "the input has changed";
}

TEST_F(AFingerprint, OfARunningTaskThatNobodyHoldsWasKilled) {
  const BatchFolder batch(folder / "batch");
  ASSERT_TRUE(batch.save_plan({task}));
  TaskRecord record;
  record.state = TaskState::kRunning;
  ASSERT_TRUE(batch.save_record("scan", record));
  EXPECT_EQ(batch.record("scan").state, TaskState::kWaiting);
  testing::write_file(batch.result_folder("scan").parent_path() / "state.json", "{\"state\": \"do");
  EXPECT_EQ(batch.record("scan").state, TaskState::kWaiting) << "a damaged state is none";
}

TEST_F(AFingerprint, NoBatchTakesThePlaceOfOtherFiles) {
  const auto saved = BatchFolder(folder / "scan").save_plan({task});
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, ErrorCode::kAlreadyExists);
}

}  // namespace
}  // namespace turnscan::batch
