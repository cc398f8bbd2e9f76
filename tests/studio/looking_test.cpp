// How things are looked at: surfaces, opacity, isolation, clipping, occlusion, films, colours that
// everyone can tell apart; the frames of a recording.

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <QTest>
#include <atomic>
#include <cmath>
#include <thread>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>

#include "app/jobs.hpp"
#include "driver.hpp"
#include "explorer/explorer.hpp"
#include "explorer/loading.hpp"
#include "explorer/looking/frame_panel.hpp"
#include "explorer/looking/frame_picture.hpp"
#include "explorer/looking/movie.hpp"
#include "explorer/model_list.hpp"
#include "scanner/live_coverage.hpp"
#include "simulator/simulator.hpp"
#include "simulator/simulator_runs.hpp"
#include "view/scene_view.hpp"
#include "view/view_settings.hpp"
#include "widgets/theme.hpp"
#include "window/main_window.hpp"

namespace turnscan::studio {
namespace {

class Looking : public ::testing::Test, FirstStart {
 protected:
  Looking() {
    show_window(window, {1366, 768});
    window.show_mode("explorer");
  }
  void open(const QString& object) {
    const QString file = folder.filePath(object + ".ply");
    ASSERT_TRUE(write_mesh(file.toStdString(), *builtin_object(object.toStdString())));
    window.open(file);
    ASSERT_TRUE(wait_idle(window));
  }
  QImage picture() {
    EXPECT_TRUE(wait_idle(window));
    return window.mode().view().screenshot();
  }
  template <class T>
  T* part(const QString& name) {
    return window.explorer().findChild<T*>(name);
  }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Looking, SurfacesAreDrawnInEachWayAndBackAgain) {
  ASSERT_NO_FATAL_FAILURE(open("letter-a"));
  auto* surface = part<QComboBox>("look_surface");
  ASSERT_NE(surface, nullptr);
  const QImage shaded = picture();
  std::vector<QImage> seen{shaded};
  for (int i = 1; i < surface->count(); ++i) {
    surface->setCurrentIndex(i);
    seen.push_back(picture());
    keep_picture(window, QString("look-%1").arg(i));
    for (std::size_t j = 0; j + 1 < seen.size(); ++j) EXPECT_NE(seen[j], seen.back()) << i << j;
  }
  surface->setCurrentIndex(0);
  EXPECT_EQ(picture(), shaded);
  part<QCheckBox>("look_occlusion")->setChecked(true);
  EXPECT_NE(picture(), shaded);
  keep_picture(window, "look-occlusion");
  part<QCheckBox>("look_occlusion")->setChecked(false);
  EXPECT_EQ(picture(), shaded);
}

TEST_F(Looking, AModelIsMadeTranslucentIsolatedAndClipped) {
  ASSERT_NO_FATAL_FAILURE(open("letter-a"));
  ASSERT_NO_FATAL_FAILURE(open("cylinder"));
  const QImage both = picture();
  ASSERT_TRUE(click(part<QPushButton>("look_isolate")));
  const QImage one = picture();
  EXPECT_NE(one, both);
  window.explorer().list().select(1);
  EXPECT_NE(picture(), one);
  ASSERT_TRUE(click(part<QPushButton>("look_isolate")));
  window.explorer().list().select(2);
  EXPECT_EQ(picture(), both);
  auto* opacity = part<QSlider>("look_opacity");
  opacity->setValue(70);
  opacity->setValue(40);
  EXPECT_NE(picture(), both);
  keep_picture(window, "look-translucent");
  window.mode().undo();  // one step for the whole way of the slider
  EXPECT_EQ(opacity->value(), 100);
  EXPECT_EQ(picture(), both);
  auto* clip = part<QComboBox>("look_clip");
  clip->setCurrentIndex(3);
  EXPECT_NE(picture(), both);
  keep_picture(window, "look-clipped");
  clip->setCurrentIndex(0);
  EXPECT_EQ(picture(), both);
}

TEST_F(Looking, AMovieTurnsTheViewOnceAndLeavesItAsItWas) {
  ASSERT_NO_FATAL_FAILURE(open("letter-a"));
  const QImage before = picture();
  const Vec3d corner(0.05, 0.1, 0.05);
  const QPointF seen = window.mode().view().project(corner).value();
  window.explorer().make_movie(folder.filePath("turn.png"), 6);
  ASSERT_TRUE(
      wait_for([&] { return window.explorer().findChildren<TurntableMovie*>().isEmpty(); }, 60.0));
  const QStringList made = QDir(folder.path()).entryList({"turn-*.png"});
  ASSERT_EQ(made.size(), 6);
  const QImage first(folder.filePath("turn-0001.png")), last(folder.filePath("turn-0006.png"));
  EXPECT_NE(first, last);
  EXPECT_EQ(first.size(), before.size());
  picture();
  const QPointF now = window.mode().view().project(corner).value();
  EXPECT_NEAR(now.x(), seen.x(), 0.01);
  EXPECT_NEAR(now.y(), seen.y(), 0.01);
  if (!can_make_films()) return;
  window.explorer().make_movie(folder.filePath("turn.mp4"), 6);
  ASSERT_TRUE(
      wait_for([&] { return window.explorer().findChildren<TurntableMovie*>().isEmpty(); }, 60.0));
  EXPECT_GT(QFileInfo(folder.filePath("turn.mp4")).size(), 1000);
  EXPECT_TRUE(content(folder.filePath("turn.mp4")).mid(4, 4) == "ftyp");
}

/// The relative luminance and contrast of WCAG 2.1.
double luminance(const QColor& color) {
  const auto linear = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double contrast(const QColor& a, const QColor& b) {
  const double high = std::max(luminance(a), luminance(b)),
               low = std::min(luminance(a), luminance(b));
  return (high + 0.05) / (low + 0.05);
}

TEST(Themes, TextsCanBeReadOnWhatLiesBehindThem) {
  for (const Theme* t : {&light_theme(), &dark_theme()}) {
    SCOPED_TRACE(t->dark ? "dark" : "light");
    for (const QColor& behind : {t->window, t->panel, t->field}) {
      EXPECT_GE(contrast(t->text, behind), 7.0);
      EXPECT_GE(contrast(t->quiet_text, behind), 4.5) << behind.name().toStdString();
      EXPECT_GE(contrast(t->error, behind), 4.5) << behind.name().toStdString();
      EXPECT_GE(contrast(t->good, behind), 4.5) << behind.name().toStdString();
    }
    EXPECT_GE(contrast(t->accent_text, t->accent), 4.5);
    EXPECT_GE(contrast(t->accent_text, t->error), 4.5);  // the button that records
    for (const QColor& behind : {t->view_top, t->view_bottom})
      EXPECT_GE(contrast(t->text, behind), 7.0);
  }
}

TEST_F(Looking, TheRecordButtonCanBeReadInTheDarkTheme) {
  window.settings().set_dark(true);
  window.show_mode("scanner");
  QWidget* record = named(window.mode(), "record");
  ASSERT_NE(record, nullptr);
  record->setEnabled(true);
  run_for(50);
  const QImage button = record->grab().toImage();
  double most = 0.0;
  const QColor behind = button.pixelColor(6, button.height() / 2);
  for (int y = 0; y < button.height(); ++y)
    for (int x = 8; x < button.width() - 8; ++x)
      most = std::max(most, contrast(button.pixelColor(x, y), behind));
  EXPECT_GE(most, 4.5);
  window.settings().set_dark(false);
}

/// As eyes without the receptor for long (protan) or middle (deutan) waves see it: Vienot, Brettel
/// and Mollon 1999, in linear light.
Vec3d seen_without(const Rgb& color, bool protan) {
  const auto linear = [](double v) {
    v /= 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const Vec3d rgb(linear(color.r), linear(color.g), linear(color.b));
  Eigen::Matrix3d m;
  if (protan) {
    m << 0.11238, 0.88762, 0.0, 0.11238, 0.88762, 0.0, 0.00401, -0.00401, 1.0;
  } else {
    m << 0.29275, 0.70725, 0.0, 0.29275, 0.70725, 0.0, -0.02234, 0.02234, 1.0;
  }
  return m * rgb;
}

/// CIE L*a*b* of linear sRGB.
Vec3d lab(const Vec3d& rgb) {
  Eigen::Matrix3d m;
  m << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Vec3d xyz = (m * rgb).cwiseQuotient(Vec3d(0.9505, 1.0, 1.089));
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  return {116.0 * f(xyz.y()) - 16.0, 500.0 * (f(xyz.x()) - f(xyz.y())),
          200.0 * (f(xyz.y()) - f(xyz.z()))};
}

double least_difference(const std::vector<Rgb>& colors) {
  double least = 1e9;
  for (std::size_t i = 0; i < colors.size(); ++i)
    for (std::size_t j = i + 1; j < colors.size(); ++j)
      for (const bool protan : {true, false})
        least = std::min(
            least,
            (lab(seen_without(colors[i], protan)) - lab(seen_without(colors[j], protan))).norm());
  return least;
}

TEST(Colors, OfCoverageAreToldApartByEyesWithoutRedOrGreen) {
  std::vector<Rgb> states, reasons, sides;
  for (std::size_t s = 0; s < kCoverageStateCount; ++s)
    states.push_back(color_of(static_cast<CoverageState>(s)));
  for (int m = 0; m < int(kMissCount); ++m) reasons.push_back(color_of(static_cast<Miss>(m)));
  for (int n = 0; n <= LiveCoverage::kWell; ++n) sides.push_back(color_of_sides(n));
  EXPECT_GT(least_difference(states), 25.0);
  EXPECT_GT(least_difference(sides), 15.0);
  EXPECT_GT(least_difference(reasons), 8.0);
}

class Rig : public ::testing::Test, FirstStart {
 protected:
  Rig() {
    show_window(window, {1366, 768});
    window.show_mode("simulator");
    window.simulator().set_object("builtin:doll");
    window.simulator().set_folder(folder.filePath("scan"));
    EXPECT_TRUE(wait_for([&] { return window.simulator().ready() && view().settled(); }));
  }
  SceneView& view() { return window.simulator().view(); }

  ScansFolder folder;
  MainWindow window;
};

TEST_F(Rig, AddingAScannerThatIsSeenLeavesTheCamera) {
  view().fly_to(Vec3d(0.0, 0.1, 0.0), 4.0, Vec3d(0.3, 0.4, 1.0));
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  const auto before = view().project(Vec3d(0.1, 0.1, 0.1));
  window.simulator().add_scanner("kinect-v1");
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  EXPECT_EQ(view().project(Vec3d(0.1, 0.1, 0.1)), before);
  // One that stands beside what is seen is brought into view.
  view().fly_to(Vec3d(0.0, 0.1, 0.0), 0.1, Vec3d(0.3, 0.4, 1.0));
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  const double scale = view().metres_per_pixel();
  window.simulator().add_scanner("kinect-v1");
  ASSERT_TRUE(wait_for([&] { return view().settled(); }));
  EXPECT_GT(view().metres_per_pixel(), 2.0 * scale);
}

/// Pixels in the colour of a hole that was clicked.
int pixels_of_hole(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const QRgb c = image.pixel(x, y);
      count += qRed(c) > 220 && qGreen(c) < 40 && qBlue(c) > 110 && qBlue(c) < 180 ? 1 : 0;
    }
  return count;
}

TEST_F(Rig, AClickOnAHoleShowsIt) {
  ASSERT_TRUE(type(named(window.simulator(), "option:frames"), "24"));
  ASSERT_TRUE(click(button_with(window.simulator(), "Scan")));
  ASSERT_TRUE(wait_idle(window));
  auto* holes = qobject_cast<QTableWidget*>(named(window.simulator(), "holes"));
  ASSERT_GT(holes->rowCount(), 2);
  for (int row = 0; row < std::min(5, holes->rowCount()); ++row) {
    QTest::mouseClick(holes->viewport(), Qt::LeftButton, {},
                      holes->visualItemRect(holes->item(row, 0)).center());
    ASSERT_TRUE(wait_for([&] { return view().settled(); }));
    keep_picture(window, QString("hole-%1").arg(row));
    EXPECT_GT(pixels_of_hole(view().screenshot()), 300) << row;
  }
}

// The frames of a recording, looked at one by one.
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
