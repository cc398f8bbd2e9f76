#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/recording/plausibility/plausibility.hpp>

#include "tests/support/memory_sequence.hpp"

namespace turnscan {
namespace {

using testing::MemorySequence;

constexpr int kWidth = 64, kHeight = 48, kFrames = 12;

/// A bump that moves to the right by a pixel a frame before a wall, with a little noise.
DepthImage bump_at(int column, int number, double wall_steps) {
  DepthImage out(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool bump = std::abs(x - column) < 8 && std::abs(y - 24) < 16;
      out.at(x, y) = std::uint16_t(wall_steps * (bump ? 0.8 : 1.0)) +
                     std::uint16_t((x * 7 + y * 3 + number * 5) % 3);
    }
  return out;
}

MemorySequence scan_of_bump() {
  MemorySequence out;
  SensorInfo camera;
  camera.intrinsics.width = kWidth, camera.intrinsics.height = kHeight;
  camera.intrinsics.fx = camera.intrinsics.fy = 60.0;
  camera.intrinsics.cx = 31.5, camera.intrinsics.cy = 23.5;
  camera.depth_unit_m = 1e-3;
  out.header_value.sensors = {camera};
  for (int i = 0; i < kFrames; ++i) {
    Frame frame;
    frame.info.index = std::uint32_t(i);
    frame.info.time_s = 0.1 * i;
    frame.info.angle_rad = 0.1 * i;
    frame.depth = bump_at(16 + 2 * i, i, 900.0);
    out.add(std::move(frame));
  }
  return out;
}

SensorInfo& sensor_of(MemorySequence& scan) { return scan.header_value.sensors[0]; }

/// The only finding; of none an empty one.
PlausibilityFinding only(const MemorySequence& scan) {
  const auto found = find_implausible(scan, RunContext());
  if (!found || found->size() > 1) {
    ADD_FAILURE() << (found ? (*found)[0].text + "; " + (*found)[1].text : found.error().text());
    return {};
  }
  return found->empty() ? PlausibilityFinding{} : found->front();
}

void expect_implausible(const MemorySequence& scan, const char* text, const char* option = "") {
  const PlausibilityFinding finding = only(scan);
  EXPECT_EQ(finding.level, Plausibility::kImplausible) << finding.text;
  EXPECT_NE(finding.text.find(text), std::string::npos) << finding.text;
  EXPECT_EQ(finding.option, option);
}

TEST(Plausibility, NothingIsSaidOfAnOrdinaryScan) { EXPECT_EQ(only(scan_of_bump()).text, ""); }

TEST(Plausibility, OffersTheUnitThatMakesSense) {
  MemorySequence scan = scan_of_bump();
  sensor_of(scan).depth_unit_m = 1e-2;
  expect_implausible(scan, "--depth-unit (with 1mm it would be 0.7", "depth-unit");
  sensor_of(scan).depth_unit_m = 5e-5;
  expect_implausible(scan, "any sensor sees from 0.07 m to 5 m", "depth-unit");
}

TEST(Plausibility, KnowsTheRangeOfANamedSensor) {
  MemorySequence scan = scan_of_bump();
  sensor_of(scan).depth_unit_m = 2e-4;
  EXPECT_EQ(only(scan).text, "");
  for (const char* name : {"virtual realsense-d455", "d455"}) {
    sensor_of(scan).model = name;
    expect_implausible(scan, "the realsense-d455 sees from 0.52 m", "depth-unit");
  }
  sensor_of(scan).depth_unit_m = 4e-4;
  EXPECT_EQ(only(scan).level, Plausibility::kDoubtful);
  EXPECT_EQ(only(scan).option, "depth-unit");
}

TEST(Plausibility, ATableThatIsNowhereNearWhatIsSeenTellsTheUnit) {
  MemorySequence scan = scan_of_bump();
  scan.header_value.turntable.emplace().center_m = Vec3d(0.0, 0.1, 0.85);
  EXPECT_EQ(only(scan).text, "");
  for (const double unit_m : {2e-4, 5e-3}) {
    sensor_of(scan).depth_unit_m = unit_m;
    expect_implausible(scan, "the unit is another one (with 1mm it would be 0.7");
  }
}

TEST(Plausibility, KnowsSwappedBytes) {
  MemorySequence scan = scan_of_bump();
  for (Frame& frame : scan.data)
    for (std::uint16_t& raw : frame.depth.pixels) raw = std::uint16_t(raw << 8 | raw >> 8);
  expect_implausible(scan, "the bytes of sensor 0's depth are swapped");
}

TEST(Plausibility, KnowsIntrinsicsOfAnotherResolution) {
  for (const double scale : {0.5, 1.5, 2.0}) {
    MemorySequence scan = scan_of_bump();
    sensor_of(scan).intrinsics.cx *= scale, sensor_of(scan).intrinsics.cy *= scale;
    expect_implausible(scan, "the intrinsics are of images of about", "intrinsics");
  }
}

TEST(Plausibility, KnowsTimesThatGoBack) {
  MemorySequence scan = scan_of_bump();
  std::swap(scan.infos[5].time_s, scan.infos[7].time_s);
  expect_implausible(scan, "times go back at frame 6");
}

TEST(Plausibility, TellsAnglesOfOtherFramesFromATableThatIsTurnedBack) {
  MemorySequence scan = scan_of_bump();
  scan.infos[6].angle_rad = 0.45;
  EXPECT_EQ(only(scan).level, Plausibility::kDoubtful);
  for (const std::size_t i : {2, 4, 8})
    std::swap(scan.infos[i].angle_rad, scan.infos[i + 1].angle_rad);
  expect_implausible(scan, "angles go back");
}

TEST(Plausibility, AnglesMayBeginAnewAfterATurn) {
  MemorySequence scan = scan_of_bump();
  for (std::size_t i = 0; i < scan.infos.size(); ++i)
    scan.infos[i].angle_rad = std::fmod(1.0 * double(i), 6.283185307179586);
  EXPECT_EQ(only(scan).text, "");
}

TEST(Plausibility, KnowsAScannerInsideItsScan) {
  MemorySequence scan;
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  scan.header_value.sensors = {scanner};
  Frame frame;
  for (int i = 0; i < 200; ++i)
    frame.points.points.push_back(
        Vec3f(std::sin(float(i)), std::cos(3.0f * float(i)), std::sin(5.0f * float(i))) * 0.3f);
  scan.add(frame);
  expect_implausible(scan, "--sensor-position x,y,z", "sensor-position");
  sensor_of(scan).viewpoint.value = Vec3d(0.0, 0.0, 0.8);
  EXPECT_EQ(only(scan).text, "");
}

TEST(Plausibility, ScansFromADirectionTellTheirUnitByTheirSize) {
  MemorySequence scan;
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  scanner.viewpoint = {Vec3d::UnitZ(), true};
  scan.header_value.sensors = {scanner};
  const auto of_size = [&](float size_m) {
    scan.data.clear(), scan.infos.clear();
    Frame frame;
    for (int i = 0; i < 1000; ++i)
      frame.points.points.push_back(0.5f * size_m *
                                    Vec3f(std::sin(float(i)), std::cos(float(i)), 0.0f));
    scan.add(std::move(frame));
  };
  of_size(0.18f);
  EXPECT_EQ(only(scan).text, "");
  of_size(180.0f);
  expect_implausible(scan, "--point-unit (with mm it would be 0.18 m)", "point-unit");
  of_size(0.18e-3f);
  expect_implausible(scan, "would be 0.000183 m across", "point-unit");
}

TEST(Plausibility, SaysWhereNothingTurns) {
  MemorySequence scan = scan_of_bump();
  for (std::size_t i = 0; i < scan.data.size(); ++i)
    scan.data[i].depth = bump_at(30, int(i), 900.0);
  EXPECT_EQ(only(scan).level, Plausibility::kDoubtful);
  EXPECT_EQ(only(scan).text.find("nothing changes in the images of sensor 0"), 0u);
}

TEST(Plausibility, AFewViewsFarApartShowThatSomethingTurns) {
  MemorySequence scan = scan_of_bump();
  for (std::size_t i = 0; i < scan.data.size(); ++i)
    scan.data[i].depth = bump_at(i % 2 == 0 ? 16 : 40, int(i), 900.0);
  EXPECT_EQ(only(scan).text, "");
}

TEST(Plausibility, KnowsImagesInTheOrderOfNumbersSortedAsText) {
  MemorySequence scan;
  scan.header_value.sensors = scan_of_bump().header_value.sensors;
  std::vector<int> numbers;
  for (int i = 1; i <= 24; ++i) numbers.push_back(i);
  const auto filled = [&] {
    scan = MemorySequence();
    scan.header_value.sensors = scan_of_bump().header_value.sensors;
    for (const int number : numbers) {
      Frame frame;
      frame.info.index = std::uint32_t(scan.data.size());
      frame.info.angle_rad = 0.2 * double(frame.info.index);
      frame.depth = bump_at(8 + number, number, 900.0);
      scan.add(std::move(frame));
    }
    return only(scan).text;
  };
  EXPECT_EQ(filled(), "");
  std::sort(numbers.begin(), numbers.end(),
            [](int a, int b) { return std::to_string(a) < std::to_string(b); });
  EXPECT_EQ(filled().find("the images of sensor 0 are in the order of numbers that were sorted as "
                          "text (1, 10, 11"),
            0u);
}

/// Poses of a camera that goes round a place 0.8 m before it.
MemorySequence scan_around(double distance_m) {
  MemorySequence scan = scan_of_bump();
  for (std::size_t i = 0; i < scan.data.size(); ++i) {
    Pose pose = Pose(Eigen::AngleAxisd(0.3 * double(i), Vec3d::UnitY()));
    pose.translation() = -distance_m * pose.linear().col(2);
    scan.data[i].info.T_table_sensor = scan.infos[i].T_table_sensor = pose;
  }
  return scan;
}

TEST(Plausibility, KnowsPosesThatAreInverted) {
  MemorySequence scan = scan_around(0.8);
  EXPECT_EQ(only(scan).text, "");
  for (std::size_t i = 0; i < scan.data.size(); ++i)
    scan.data[i].info.T_table_sensor = scan.data[i].info.T_table_sensor->inverse();
  expect_implausible(scan, "the poses of sensor 0 turn on the spot");
}

TEST(Plausibility, KnowsPosesThatLookAway) {
  MemorySequence scan = scan_around(-0.8);
  expect_implausible(scan, "the poses of sensor 0 look away");
}

TEST(Plausibility, KnowsDepthThatIsNotWherePosesLook) {
  MemorySequence scan = scan_around(0.8);
  sensor_of(scan).depth_unit_m = 1e-4 * 2;
  expect_implausible(scan, "the lines of sight of the poses meet 800mm from the sensor");
}

/// Two balls of different size on either side of the axis that a camera goes round, 0.8 m away.
MemorySequence scan_of_balls(bool mirrored) {
  MemorySequence scan = scan_around(0.8);
  CameraIntrinsics& camera = sensor_of(scan).intrinsics;
  camera.fx = camera.fy = 130.0;
  const std::array<std::pair<Vec3d, double>, 2> balls{
      {{Vec3d(0.05, 0.0, 0.03), 0.12}, {Vec3d(-0.1, 0.03, 0.0), 0.06}}};
  for (Frame& frame : scan.data) {
    const Pose T_sensor_world = frame.info.T_table_sensor->inverse();
    frame.depth = DepthImage(kWidth, kHeight, kNoReturn);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const Vec3d ray = camera.ray(x, y);
        double nearest = 9.0;
        for (const auto& [center, radius] : balls) {
          const Vec3d c = T_sensor_world * center;
          const double a = ray.squaredNorm(), b = ray.dot(c);
          const double root = b * b - a * (c.squaredNorm() - radius * radius);
          if (root > 0.0) nearest = std::min(nearest, (b - std::sqrt(root)) / a);
        }
        if (nearest < 9.0)
          frame.depth.at(mirrored ? kWidth - 1 - x : x, y) = std::uint16_t(1000.0 * nearest);
      }
  }
  return scan;
}

TEST(Plausibility, KnowsMirroredImagesByTheirPoses) {
  EXPECT_EQ(only(scan_of_balls(false)).text, "");
  expect_implausible(scan_of_balls(true), "the images of sensor 0 are mirrored");
}

TEST(Plausibility, SaysWhereTheSurroundingsMove) {
  MemorySequence scan;
  scan.header_value.sensors = scan_of_bump().header_value.sensors;
  sensor_of(scan).intrinsics.width = 4 * kWidth, sensor_of(scan).intrinsics.height = 4 * kHeight;
  sensor_of(scan).intrinsics.cx *= 4.0, sensor_of(scan).intrinsics.cy *= 4.0;
  for (int i = 0; i < kFrames; ++i) {
    Frame frame;
    frame.info.index = std::uint32_t(i);
    frame.depth = DepthImage(4 * kWidth, 4 * kHeight);
    for (int y = 0; y < 4 * kHeight; ++y)
      for (int x = 0; x < 4 * kWidth; ++x)
        frame.depth.at(x, y) =
            std::uint16_t(900.0 + 2.0 * x + y + 30.0 * i + (x * 7 + y * 3 + i) % 3);
    scan.add(std::move(frame));
  }
  EXPECT_EQ(only(scan).text.find("what surrounds the object moves"), 0u) << only(scan).text;
  for (FrameInfo& info : scan.infos) info.T_table_sensor = Pose::Identity();
  for (std::size_t i = 0; i < scan.data.size(); ++i) scan.data[i].info = scan.infos[i];
  EXPECT_EQ(only(scan).text, "");
}

TEST(Plausibility, StopsWhenItIsCancelled) {
  const RunContext context;
  context.cancel();
  const auto found = find_implausible(scan_of_bump(), context);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
