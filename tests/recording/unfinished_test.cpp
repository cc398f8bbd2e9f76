#include <gtest/gtest.h>

#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/repair.hpp>
#include <turnscan/recording/unfinished.hpp>

#include "tests/recording/sequences.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

void write_frames(const fs::path& folder, bool finish) {
  auto writer = RecordingWriter::create(folder, testing::small_header());
  ASSERT_TRUE(writer);
  for (std::uint32_t i = 0; i < 3; ++i) ASSERT_TRUE(writer->append(testing::depth_frame(i)));
  if (finish) {
    ASSERT_TRUE(writer->finish());
  }
}

TEST(Unfinished, IsWhatAKilledWriterLeaves) {
  const TempFolder temp;
  write_frames(temp / "r", false);
  temp.put("r/depth/.000003.png.12-3.part", "half");
  EXPECT_TRUE(is_unfinished_recording(temp / "r"));
  ASSERT_TRUE(remove_unfinished_recording(temp / "r"));
  EXPECT_TRUE(fs::is_empty(temp / "r"));
}

TEST(Unfinished, IsABeginningToo) {
  const TempFolder temp;
  fs::create_directory(temp / "r");
  EXPECT_FALSE(is_unfinished_recording(temp / "r"));
  temp.put("r/.recording.json.part", "{");
  EXPECT_TRUE(is_unfinished_recording(temp / "r"));
}

TEST(Unfinished, IsNothingFinishedNorForeign) {
  const TempFolder temp;
  write_frames(temp / "whole", true);
  write_frames(temp / "mixed", false);
  temp.put("mixed/notes.txt", "mine");
  for (const char* name : {"whole", "mixed", "none"}) {
    EXPECT_FALSE(is_unfinished_recording(temp / name)) << name;
    EXPECT_FALSE(remove_unfinished_recording(temp / name)) << name;
  }
  EXPECT_TRUE(fs::exists(temp / "mixed/recording.json"));
}

TEST(Unfinished, IsNothingToWhichAPassWasAddedThatWasNotFinished) {
  const TempFolder temp;
  write_frames(temp / "r", true);
  { ASSERT_TRUE(RecordingWriter::extend(temp / "r")->append(testing::depth_frame(7))); }
  EXPECT_FALSE(is_unfinished_recording(temp / "r"));
  const auto recording = Recording::open(temp / "r");
  EXPECT_FALSE(recording->complete());
  EXPECT_EQ(recording->frames().size(), 4u);
  ASSERT_TRUE(repair_recording(temp / "r"));
  EXPECT_TRUE(Recording::open(temp / "r")->complete());
}

TEST(Unfinished, IsNothingThatIsBeingWritten) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", testing::small_header());
  ASSERT_TRUE(writer);
  EXPECT_FALSE(is_unfinished_recording(temp / "r"));
}

}  // namespace
}  // namespace turnscan
