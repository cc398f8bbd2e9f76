#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/recording/recording.hpp>

#include "tests/recording/sequences.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::color_image;
using ::testing::Contains;
using testing::depth_frame;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::scan_frame;
using testing::scanner_header;
using testing::small_header;
using testing::TempFolder;

void write_all(const fs::path& folder, const SequenceHeader& header,
               const std::vector<Frame>& frames, bool finish = true) {
  auto writer = RecordingWriter::create(folder, header);
  ASSERT_TRUE(writer) << writer.error().text();
  for (const Frame& frame : frames) {
    const auto done = writer->append(frame);
    ASSERT_TRUE(done) << done.error().text();
  }
  if (finish) {
    ASSERT_TRUE(writer->finish());
  }
}

/// A finished recording of three depth frames with colour.
fs::path three_frames(const TempFolder& temp) {
  std::vector<Frame> frames;
  for (std::uint32_t i = 0; i < 3; ++i) {
    frames.push_back(depth_frame(i));
    frames.back().color = color_image(i);
  }
  write_all(temp / "r", small_header(), frames);
  return temp / "r";
}

Recording opened(const fs::path& folder) {
  auto recording = Recording::open(folder);
  EXPECT_TRUE(recording) << recording.error().text();
  return recording ? std::move(*recording) : throw std::runtime_error("not opened");
}

Error refusal(const fs::path& folder) {
  const auto recording = Recording::open(folder);
  EXPECT_FALSE(recording);
  return recording ? Error{} : recording.error();
}

void append_text(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::app | std::ios::binary) << text;
}

void truncate_by(const fs::path& path, std::uintmax_t bytes) {
  fs::resize_file(path, fs::file_size(path) - bytes);
}

TEST(Recording, DepthAndColourFramesAreReadBackExactly) {
  const TempFolder temp;
  const Recording recording = opened(three_frames(temp));
  EXPECT_THAT(recording.notes(), IsEmpty());
  EXPECT_TRUE(recording.complete());
  ASSERT_EQ(recording.frames().size(), 3u);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto frame = recording.read(i);
    ASSERT_TRUE(frame) << frame.error().text();
    EXPECT_EQ(frame->depth.pixels, depth_frame(i).depth.pixels);
    EXPECT_EQ(frame->color.pixels, color_image(i).pixels);
    EXPECT_EQ(frame->info.index, i);
    EXPECT_EQ(frame->info.time_s, depth_frame(i).info.time_s);
    EXPECT_NEAR(*frame->info.angle_rad, *depth_frame(i).info.angle_rad, 1e-11);
    EXPECT_EQ(frame->info.file, fmt::format("depth/{:06}.png", i));
  }
}

TEST(Recording, ScansKeepTheirGridAndPose) {
  const TempFolder temp;
  Frame scan = scan_frame(4);
  scan.info.T_table_sensor = rotation_about_y(1.0);
  write_all(temp / "r", scanner_header(), {scan});
  const Recording recording = opened(temp / "r");
  EXPECT_EQ(recording.header().sensors[0].viewpoint.value, Vec3d(0.1, 0.2, 0.3));
  const auto frame = recording.read(0);
  ASSERT_TRUE(frame) << frame.error().text();
  EXPECT_EQ(frame->points.points, scan.points.points);
  EXPECT_EQ(frame->grid, scan.grid);
  EXPECT_EQ(frame->grid_width, 2);
  EXPECT_EQ(frame->grid_height, 2);
  EXPECT_TRUE(frame->info.T_table_sensor->isApprox(*scan.info.T_table_sensor, 1e-11));
}

TEST(Recording, DroppedFramesKeepTheirLine) {
  const TempFolder temp;
  Frame dropped = depth_frame(1);
  dropped.info.status = FrameStatus::kDropped;
  write_all(temp / "r", small_header(), {depth_frame(0), dropped});
  const Recording recording = opened(temp / "r");
  ASSERT_EQ(recording.frames().size(), 2u);
  EXPECT_EQ(recording.frames()[1].status, FrameStatus::kDropped);
  EXPECT_EQ(recording.read(1).error().code, ErrorCode::kMissingData);
  EXPECT_THAT(recording.notes(), IsEmpty());
}

TEST(Recording, UnfinishedRecordingSaysSo) {
  const TempFolder temp;
  write_all(temp / "r", small_header(), {depth_frame(0)}, false);
  const Recording recording = opened(temp / "r");
  EXPECT_FALSE(recording.complete());
  EXPECT_THAT(recording.notes(), ElementsAre(HasSubstr("not finished")));
  EXPECT_TRUE(recording.read(0));
}

TEST(Recording, LineHalfWrittenAtTheEndIsLeftOut) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  truncate_by(folder / "frames.csv", 10);
  const Recording recording = opened(folder);
  EXPECT_EQ(recording.frames().size(), 2u);
  EXPECT_THAT(recording.notes(), Contains(HasSubstr("half written")));
  EXPECT_THAT(recording.notes(), Contains(HasSubstr("lists 2 frames, but 3 were recorded")));
}

TEST(Recording, FrameWhoseFileIsMissingIsDroppedWithANote) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  fs::remove(folder / "depth/000001.png");
  const Recording recording = opened(folder);
  EXPECT_EQ(recording.frames()[1].status, FrameStatus::kDropped);
  EXPECT_EQ(recording.frames()[2].status, FrameStatus::kOk);
  EXPECT_THAT(recording.notes(), ElementsAre(HasSubstr("depth/000001.png is missing")));
}

TEST(Recording, ManyLostFilesAreOneNote) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  fs::remove(folder / "depth/000001.png");
  fs::remove(folder / "depth/000002.png");
  EXPECT_THAT(opened(folder).notes(), ElementsAre(HasSubstr("and 1 more like it")));
}

TEST(Recording, TruncatedImagesAreDroppedWithANote) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  truncate_by(folder / "depth/000002.png", 1);
  fs::resize_file(folder / "depth/000000.png", 0);
  const Recording recording = opened(folder);
  EXPECT_EQ(recording.frames()[0].status, FrameStatus::kDropped);
  EXPECT_EQ(recording.frames()[1].status, FrameStatus::kOk);
  EXPECT_EQ(recording.frames()[2].status, FrameStatus::kDropped);
  EXPECT_FALSE(recording.notes().empty());
}

TEST(Recording, LostColourLeavesTheFrameWithoutColour) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  fs::remove(folder / "color/000000.png");
  truncate_by(folder / "color/000001.png", 3);
  const Recording recording = opened(folder);
  EXPECT_TRUE(recording.read(0)->color.empty());
  EXPECT_TRUE(recording.read(1)->color.empty());
  EXPECT_FALSE(recording.read(2)->color.empty());
  EXPECT_THAT(recording.notes(), ElementsAre(HasSubstr("without colour")));
}

TEST(Recording, TruncatedScansAreDropped) {
  // Any cut of the last scan; cuts within the vertices of an earlier one.
  for (const std::uintmax_t cut : {1u, 5u, 20u}) {
    const TempFolder temp;
    write_all(temp / "r", scanner_header(), {scan_frame(0), scan_frame(1)});
    truncate_by(temp / "r/points/000001.ply", cut);
    const Recording recording = opened(temp / "r");
    EXPECT_EQ(recording.frames()[1].status, FrameStatus::kDropped) << cut;
    EXPECT_EQ(recording.frames()[0].status, FrameStatus::kOk);
    EXPECT_FALSE(recording.notes().empty());
  }
  const TempFolder temp;
  write_all(temp / "r", scanner_header(), {scan_frame(0), scan_frame(1)});
  truncate_by(temp / "r/points/000000.ply", 25);
  EXPECT_EQ(opened(temp / "r").frames()[0].status, FrameStatus::kDropped);
}

TEST(Recording, TwoFramesWithOneIndexAreAnErrorThatNamesTheFile) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  append_text(folder / "frames.csv", "1,,0,0,0,,,,,,,,,depth/000000.png,,ok\n");
  const Error error = refusal(folder);
  EXPECT_EQ(error.code, ErrorCode::kFormat);
  EXPECT_THAT(error.text(), HasSubstr("frames.csv: lines 3 and 5"));
}

TEST(Recording, NumberThatIsNotFiniteIsAnError) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  append_text(folder / "frames.csv", "3,nan,0,0,0,,,,,,,,,depth/000000.png,,ok\n");
  EXPECT_THAT(refusal(folder).text(), HasSubstr("line 5: column time_s"));
}

TEST(Recording, FolderWithoutRecordingIsNotFound) {
  const TempFolder temp;
  EXPECT_EQ(refusal(temp.path()).code, ErrorCode::kNotFound);
  EXPECT_EQ(refusal(temp / "nowhere").code, ErrorCode::kNotFound);
}

TEST(Recording, MissingTableIsARecordingWithoutFrames) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  fs::remove(folder / "frames.csv");
  const Recording recording = opened(folder);
  EXPECT_TRUE(recording.frames().empty());
  EXPECT_THAT(recording.notes(), Contains(HasSubstr("frames.csv is missing")));
}

TEST(Recording, ImageOfAnotherSizeThanItsSensorIsAnError) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  fs::copy_file(folder / "color/000000.png", folder / "depth/000000.png",
                fs::copy_options::overwrite_existing);
  EXPECT_FALSE(opened(folder).read(0));
}

TEST(Recording, HugeDescriptionIsRefused) {
  const TempFolder temp;
  const fs::path folder = three_frames(temp);
  append_text(folder / "recording.json", std::string(std::size_t(5) << 20, ' '));
  EXPECT_EQ(refusal(folder).code, ErrorCode::kResourceLimit);
}

TEST(Recording, PositionBeyondTheEndThrows) {
  const TempFolder temp;
  const Recording recording = opened(three_frames(temp));
  EXPECT_THROW((void)recording.read(3), std::invalid_argument);
}

TEST(Recording, OpeningIsCancelled) {
  const TempFolder temp;
  RunContext context;
  EXPECT_TRUE(Recording::open(three_frames(temp), context));
  context.cancel();
  const auto recording = Recording::open(temp / "r", context);
  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
