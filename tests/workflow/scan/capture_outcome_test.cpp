#include <gtest/gtest.h>

#include <turnscan/workflow/scan/capture_outcome.hpp>

namespace turnscan {
namespace {

TEST(CaptureOutcome, IsGoodWhereSomethingWasRecordedToTheEnd) {
  CaptureResult result;
  result.recorded = result.complete = true;
  EXPECT_TRUE(capture_outcome(result, "rec"));
}

TEST(CaptureOutcome, SaysThatNothingWasRecorded) {
  const auto outcome = capture_outcome(CaptureResult(), "rec");
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kMissingData);
}

TEST(CaptureOutcome, SaysWhatTheFolderHolds) {
  CaptureResult result;
  result.recorded = result.complete = true;
  result.recorder.written = 7;
  result.error = Error{ErrorCode::kCancelled, "cancelled", ""};
  auto outcome = capture_outcome(result, "rec");
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(outcome.error().message,
            "stopped; rec holds the 7 frames until then and is complete "
            "(--resume goes on with it)");
  result.complete = false;
  result.error = Error{ErrorCode::kIo, "disk full; make room", ""};
  outcome = capture_outcome(result, "rec");
  EXPECT_EQ(outcome.error().message,
            "disk full; make room - rec holds the 7 frames until then and can be finished with "
            "'turnscan info --repair'");
}

}  // namespace
}  // namespace turnscan
