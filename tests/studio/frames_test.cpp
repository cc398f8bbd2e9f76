// The frames of a recording, looked at one by one.

#include <gtest/gtest.h>

#include <QLabel>
#include <QSlider>
#include <QTest>
#include <atomic>
#include <thread>
#include <turnscan/recording/recording.hpp>

#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/loading.hpp"
#include "explorer/looking/frame_panel.hpp"
#include "explorer/looking/frame_picture.hpp"
#include "explorer/model_list.hpp"
#include "view/scene_view.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

constexpr int kWidth = 64, kHeight = 48;

SequenceHeader header_of_a_turn() {
  SequenceHeader header;
  SensorInfo sensor;
  sensor.intrinsics.width = kWidth;
  sensor.intrinsics.height = kHeight;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 60.0;
  sensor.intrinsics.cx = kWidth / 2.0;
  sensor.intrinsics.cy = kHeight / 2.0;
  header.sensors.push_back(sensor);
  TurntableInfo table;
  table.center_m = {0.0, 0.1, 0.8};
  table.axis = -Vec3d::UnitY();
  table.speed_rad_s = 0.5;
  header.turntable = table;
  return header;
}

/// A slope in front of a hole on the left. The colour says which frame it is.
Frame frame_of(std::uint32_t index) {
  Frame frame;
  frame.info.index = index;
  frame.info.time_s = 0.1 * index;
  frame.depth = DepthImage(kWidth, kHeight, 0);
  for (int y = 0; y < kHeight; ++y)
    for (int x = kWidth / 4; x < kWidth; ++x) frame.depth.at(x, y) = std::uint16_t(7000 + 20 * x);
  frame.color = ColorImage(kWidth, kHeight, Rgb{std::uint8_t(40 + 10 * index), 90, 120});
  return frame;
}

/// Frames of a real sensor's size, made at the moment when they are read.
class SlowSequence : public FrameSequence {
 public:
  explicit SlowSequence(std::size_t count) : header_(header_of_a_turn()) {
    header_.sensors[0].intrinsics.width = 512;
    header_.sensors[0].intrinsics.height = 424;
    for (std::size_t i = 0; i < count; ++i) {
      FrameInfo& info = frames_.emplace_back();
      info.index = std::uint32_t(i);
      info.time_s = double(i) / 30.0;
    }
  }
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t position) const override {
    ++reads;
    std::this_thread::sleep_for(std::chrono::milliseconds(30));  // as a slow disk
    Frame frame;
    frame.info = frames_[position];
    frame.depth = DepthImage(512, 424, std::uint16_t(5000 + position));
    return frame;
  }
  mutable std::atomic<int> reads{0};

 private:
  SequenceHeader header_;
  std::vector<FrameInfo> frames_;
};

class Frames : public ::testing::Test, FirstStart {
 protected:
  Frames() {
    show_window(window, {1440, 900});
    window.show_mode("explorer");
  }
  QSlider& slider() { return *qobject_cast<QSlider*>(named(window.explorer(), "frame")); }
  std::string text() {
    return qobject_cast<QLabel*>(named(window.explorer(), "frame_text"))->text().toStdString();
  }
  bool shows(int position) {
    return wait_for([&] { return window.explorer().frames().pictured() == position; });
  }
  QColor in_the_middle_of(const QString& name) {
    QWidget* box = named(window.explorer(), name);
    return box->grab().toImage().pixelColor(box->width() / 2, box->height() / 2);
  }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Frames, OfARecordingAreSteppedThroughWithTheirImages) {
  const QString path = folder.filePath("slope");
  {
    auto writer = RecordingWriter::create(path.toStdString(), header_of_a_turn());
    ASSERT_TRUE(writer.has_value());
    for (std::uint32_t i = 0; i < 12; ++i) {
      Frame frame = frame_of(i);
      if (i == 3) frame.info.status = FrameStatus::kDropped;
      ASSERT_TRUE(writer->append(frame));
    }
    ASSERT_TRUE(writer->finish());
  }
  window.open(path);
  ASSERT_TRUE(wait_idle(window));
  EXPECT_TRUE(slider().isVisible());
  EXPECT_EQ(slider().maximum(), 11);
  ASSERT_TRUE(shows(0));
  EXPECT_EQ(text(), "Frame 1 of 12 · 0.000 s · 0.0°");
  EXPECT_EQ(in_the_middle_of("frame_color"), QColor(40, 90, 120));
  slider().setFocus();
  for (int i = 1; i <= 2; ++i) {
    QTest::keyClick(&slider(), Qt::Key_Right);
    ASSERT_TRUE(shows(i));
  }
  keep_picture(window, "frames");
  EXPECT_EQ(in_the_middle_of("frame_color"), QColor(60, 90, 120));
  EXPECT_EQ(text(), "Frame 3 of 12 · 0.200 s · 5.7°");
  QTest::keyClick(&slider(), Qt::Key_Right);
  ASSERT_TRUE(shows(3));
  EXPECT_NE(text().find("lost while it was recorded"), std::string::npos);
  EXPECT_NE(in_the_middle_of("frame_color"), QColor(60, 90, 120));
  QTest::keyClick(&slider(), Qt::Key_End);
  ASSERT_TRUE(shows(11));
  EXPECT_EQ(in_the_middle_of("frame_color"), QColor(150, 90, 120));
  // Another model has no frames.
  window.explorer().list().select(
      window.explorer().store().add("cloud", cloud_model(PointCloud(), {})));
  EXPECT_FALSE(slider().isVisible());
}

/// One frame in memory.
class OneFrame : public FrameSequence {
 public:
  OneFrame() : header_(header_of_a_turn()), frame_(frame_of(0)), frames_{frame_.info} {}
  const SequenceHeader& header() const override { return header_; }
  const std::vector<FrameInfo>& frames() const override { return frames_; }
  Result<Frame> read(std::size_t /*position*/) const override { return frame_; }

 private:
  SequenceHeader header_;
  Frame frame_;
  std::vector<FrameInfo> frames_;
};

TEST(FramePicture, IsColouredByDepthAndAsWideAsWanted) {
  const auto full = frame_picture(OneFrame(), 0, 4 * kWidth);
  ASSERT_TRUE(full.has_value());
  EXPECT_EQ(full->depth.size(), QSize(kWidth, kHeight));
  EXPECT_EQ(full->depth.pixelColor(2, 9).alpha(), 0);  // not measured
  const QColor near = full->depth.pixelColor(kWidth / 4, 9);
  const QColor far = full->depth.pixelColor(kWidth - 1, 9);
  EXPECT_GT(near.red(), near.blue());  // yellow
  EXPECT_GT(far.blue(), far.green());  // violet
  EXPECT_NEAR(full->near_m, 0.7 + 2e-3 * (kWidth / 4), 3e-3);
  EXPECT_NEAR(full->far_m, 0.7 + 2e-3 * (kWidth - 1), 3e-3);
  EXPECT_EQ(frame_picture(OneFrame(), 0, kWidth / 2)->color.size(), QSize(kWidth / 2, kHeight / 2));
}

TEST_F(Frames, AreDecodedBesideTheWindowTheLatestWantedFirst) {
  const auto sequence = std::make_shared<SlowSequence>(920);
  FramePanel panel;
  panel.resize(360, 700);
  panel.show();
  panel.show_recording(sequence, {});
  auto* slider = qobject_cast<QSlider*>(named(panel, "frame"));
  StallWatch watch;
  for (int i = 0; i < 920; ++i) {
    slider->setValue(i);
    QTest::qWait(1);
  }
  const double stall = watch.longest_cpu_ms();
  ASSERT_TRUE(wait_for([&] { return panel.pictured() == 919; }));
  std::printf("%d of 920 frames were read; longest stall %.0f ms of processor time\n",
              sequence->reads.load(), stall);
  EXPECT_LT(sequence->reads.load(), 300);
  EXPECT_LT(stall, 50.0);
}

}  // namespace
}  // namespace turnscan::studio
