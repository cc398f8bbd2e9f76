#include <gtest/gtest.h>

#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/workflow/batch/batch_folder.hpp>
#include <turnscan/workflow/batch/batch_run.hpp>
#include <turnscan/workflow/batch/batch_status.hpp>
#include <turnscan/workflow/batch/batch_summary.hpp>
#include <turnscan/workflow/batch/run_task.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using batch::BatchFolder;
using batch::TaskState;

/// Tasks whose program is a shell script: as the command it gets the arguments of a task, in the
/// folder of its outputs.
class ABatch : public ::testing::Test {
 protected:
  void make_tasks(int count) {
    std::vector<BatchTask> tasks;
    for (int i = 0; i < count; ++i) {
      const std::string name = "t" + std::to_string(i);
      testing::write_file(folder / name, "input " + name);
      tasks.push_back({name, "reconstruct", {(folder / name).string()}, {}, 1, 1});
    }
    ASSERT_TRUE(save_batch(path(), tasks));
  }
  void set_program(const std::string& script) {
    testing::write_file(program, "#!/bin/sh\n" + script);
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  Result<> run_one(const std::string& name, const RunContext& context = {}) {
    return run_task(path(), name, {program, 1}, context);
  }
  std::string path() const { return (folder / "batch").string(); }
  batch::TaskRecord record(const std::string& name) const {
    return BatchFolder(path()).record(name);
  }

  testing::TempFolder folder;
  const std::filesystem::path program = folder / "program";
};

TEST_F(ABatch, KeepsTheResultOfATaskBesideItsHash) {
  make_tasks(1);
  set_program("echo $1 > mesh.txt; for input; do :; done; cat \"$input\" >> mesh.txt");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(record("t0").state, TaskState::kDone);
  EXPECT_EQ(record("t0").digest.size(), 64u);
  const auto result = BatchFolder(path()).result_folder("t0");
  EXPECT_EQ(testing::content_of(result / "mesh.txt"), "reconstruct\ninput t0");
  set_program("exit 1");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(record("t0").attempts, 1) << "what is done is not done again";
  testing::write_file(folder / "t0", "another input");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(record("t0").state, TaskState::kFailed) << "but what has changed is";
}

TEST_F(ABatch, KeepsTheReasonOfAFailureAndNothingElseOfIt) {
  make_tasks(2);
  set_program(
      "echo half > mesh.ply; echo note; echo 'turnscan: first: a; b'; "
      "echo 'turnscan: the reason; what to do'; exit 1");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(record("t0").reason, "the reason; what to do");
  set_program("kill -9 $$");
  ASSERT_TRUE(run_one("t1"));
  EXPECT_NE(record("t1").reason.find("memory"), std::string::npos);
  for (const auto& entry :
       std::filesystem::directory_iterator(BatchFolder(path()).result_folder("t0").parent_path()))
    EXPECT_EQ(entry.path().filename().string().find("work-"), std::string::npos);
  const auto text = batch_status_text(path());
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("2 failed"), std::string::npos);
  EXPECT_NE(text->find("the reason; what to do"), std::string::npos);
}

TEST_F(ABatch, NoticesAnInputThatChangesUnderATask) {
  make_tasks(1);
  set_program("for input; do :; done; echo more >> \"$input\"");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(record("t0").state, TaskState::kFailed);
  EXPECT_NE(record("t0").reason.find("changed"), std::string::npos);
}

TEST_F(ABatch, RemovesWhatAKilledAttemptLeft) {
  make_tasks(1);
  const auto left = BatchFolder(path()).result_folder("t0").parent_path() / "work-elsewhere-1";
  std::filesystem::create_directories(left);
  set_program("true");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_FALSE(std::filesystem::exists(left));
}

TEST_F(ABatch, DeletesNothingBehindALinkAndNothingThatItDidNotMake) {
  make_tasks(1);
  namespace fs = std::filesystem;
  const fs::path task = BatchFolder(path()).result_folder("t0").parent_path();
  for (const char* name : {"result", "work-mine"}) {
    fs::create_directories(task / name);
    testing::write_file(task / name / "thesis", "precious");
  }
  set_program("echo made > mesh.txt");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(testing::content_of(task / "result" / "mesh.txt"), "made\n");
  EXPECT_TRUE(fs::exists(task / "work-mine" / "thesis"));
  std::size_t kept = 0;
  for (const auto& entry : fs::directory_iterator(task))
    kept += entry.path().filename().string().starts_with("kept-work-") &&
            fs::exists(entry.path() / "thesis");
  EXPECT_EQ(kept, 1u);
  fs::rename(task, folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", task);
  testing::write_file(folder / "t0", "another input");
  const auto ran = run_one("t0");
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().code, ErrorCode::kNoPermission);
  EXPECT_TRUE(fs::exists(folder / "elsewhere" / "result" / "mesh.txt"));
}

TEST_F(ABatch, KeepsTheOldResultUntilTheNewOneIsInPlace) {
  make_tasks(1);
  set_program("echo first > mesh.txt");
  ASSERT_TRUE(run_one("t0"));
  testing::write_file(folder / "t0", "another input");
  // Its outputs are gone when they are to be put in place.
  set_program("rm -r ../work-*");
  ASSERT_TRUE(run_one("t0"));
  EXPECT_EQ(record("t0").state, TaskState::kFailed);
  EXPECT_EQ(testing::content_of(BatchFolder(path()).result_folder("t0") / "mesh.txt"), "first\n");
}

TEST_F(ABatch, ACancelledTaskIsWaitingAgain) {
  make_tasks(1);
  set_program("sleep 100");
  RunContext context;
  context.cancel();
  const auto ran = run_one("t0", context);
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(record("t0").state, TaskState::kWaiting);
}

TEST_F(ABatch, IsRunByOneAtATime) {
  make_tasks(1);
  const auto lock = file::FileLock::try_lock(*BatchFolder(path()).open(), BatchFolder::kLock);
  BatchRequest request;
  request.folder = path();
  request.program = program;
  const auto ran = run_batch(request, RunContext());
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().code, ErrorCode::kAlreadyExists);
  EXPECT_FALSE(save_batch(path(), {}));
}

/// The engine's program: it does what `turnscan batch task` does, without the real program.
TEST_F(ABatch, BeginsTasksAnewWhoseProcessIsLostAndGivesUpInTheEnd) {
  make_tasks(2);
  set_program("echo x >> '" + (folder / "calls").string() + "'; kill -9 $$");
  BatchRequest request;
  request.folder = path();
  request.program = program;
  request.options.jobs = 1;
  request.options.restarts = 2;
  const auto outcome = run_batch(request, RunContext());
  ASSERT_TRUE(outcome) << outcome.error().text();
  EXPECT_EQ(outcome->failed, 2u);
  EXPECT_EQ(testing::content_of(folder / "calls"), "x\nx\nx\nx\nx\nx\n") << "three times each";
  EXPECT_NE(record("t0").reason.find("signal 9"), std::string::npos);
  EXPECT_EQ(run_batch(request, RunContext())->failed, 2u) << "failures are left alone";
  request.retry = {"t1"};
  request.retry_failed = true;
  request.options.restarts = 0;
  ASSERT_TRUE(run_batch(request, RunContext()));
  EXPECT_EQ(testing::content_of(folder / "calls"), "x\nx\nx\nx\nx\nx\nx\n");
  request.retry = {"t7"};
  EXPECT_EQ(run_batch(request, RunContext()).error().code, ErrorCode::kInvalidOption);
}

TEST_F(ABatch, SaysNothingThatASpreadsheetTakesForAFormula) {
  BatchTask task{"t", "reconstruct", {"=cmd|' /C calc'!A0"}, {{"base-height", "-5mm"}}, 1, 1};
  batch::TaskRecord failed;
  failed.state = TaskState::kFailed;
  failed.reason = "=HYPERLINK(\"http://example.com\")\n+A1*(B2)";
  const std::string csv = batch::summary_csv({{{&task, failed, {}, {}}}});
  EXPECT_NE(csv.find(",\"'=HYPERLINK(\"\"http://example.com\"\") +A1*(B2)\","), std::string::npos)
      << csv;
  EXPECT_NE(csv.find(",'=cmd|' /C calc'!A0,-5mm\n"), std::string::npos) << csv;
}

TEST_F(ABatch, IsSummarisedWithWhatTheReportsSay) {
  make_tasks(2);
  set_program(
      R"sh(for input; do :; done; case $input in *t1) echo 'turnscan: a, "b" <i>; c'; exit 1;; esac
cat > report.json <<END
{"frames": 9, "objects": [
 {"triangles": 5, "mesh": {"watertight": true}, "verdict": {"colour": "green", "sentences": []}},
 {"triangles": 7, "mesh": {"watertight": true}, "verdict": {"colour": "amber", "sentences": [
  {"level": "fair", "text": "few frames"}, {"level": "good", "text": "all well"}]}}]}
END
)sh");
  ASSERT_TRUE(run_one("t0"));
  ASSERT_TRUE(run_one("t1"));
  const BatchFolder opened(path());
  const auto tasks = *opened.load_plan();
  const auto summary = batch::summarize(opened, tasks);
  const std::string csv = batch::summary_csv(summary), page = batch::summary_page(summary, "shelf"),
                    json = batch::summary_json(summary);
  EXPECT_NE(csv.find("t0,done,amber,2,12,yes,9,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"a, \"\"b\"\" <i>; c\""), std::string::npos) << csv;
  EXPECT_NE(page.find("&lt;i&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<i>"), std::string::npos);
  EXPECT_NE(json.find("few frames"), std::string::npos);
  EXPECT_EQ(json.find("all well"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
