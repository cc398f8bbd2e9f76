#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/reconstruction/views/profiles.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan::views {
namespace {

TEST(Profiles, ThatSawNothingPartTheirGroup) {
  const LightSheet sheet{Vec3d::UnitZ(), Vec3d::UnitY()};
  FramePoints line;
  for (int i = 0; i < 40; ++i) line.cloud.points.emplace_back(0.0f, 0.001f * float(i), 0.5f);
  line = in_sheet_order(line, sheet);
  const FramePoints nothing = in_sheet_order(FramePoints(), sheet);
  std::vector<Profile> group;
  for (const FramePoints& points : {line, nothing, line, line, nothing}) {
    group.push_back({points, Pose::Identity()});
    group.back().T_table_sensor.translation().x() = 0.001 * double(group.size());
  }
  const DepthView view = view_of_profiles(group, sheet, {0.01, 0.001});
  ASSERT_FALSE(view.empty());
  std::size_t between = 0;  // the pixels of the two lines beside each other, and between them
  for (const std::uint32_t word : view.pixels) between += (word & 0xffffu) != 0 ? 1 : 0;
  EXPECT_GT(between, 3u * 39u);
  EXPECT_LT(between, 6u * 80u);
  EXPECT_TRUE(view_of_profiles(std::vector<Profile>{group[1]}, sheet, {}).empty());
}

TEST(Profiles, AreToldFromRangeScans) {
  FramePoints line, plate, few;
  for (int i = 0; i < 40; ++i) {
    line.cloud.points.emplace_back(0.0f, 0.01f * float(i), 0.5f + 0.02f * float(i % 3));
    // A plate in a plane that does not hold the viewpoint.
    plate.cloud.points.emplace_back(0.01f * float(i % 6), 0.01f * float(i / 6), 0.5f);
  }
  few.cloud.points.assign(line.cloud.points.begin(), line.cloud.points.begin() + 9);
  const auto sheet = find_sheet(line);
  ASSERT_TRUE(sheet);
  EXPECT_NEAR(std::abs(sheet->across.x()), 0.0, 1e-6);
  EXPECT_FALSE(find_sheet(plate));
  EXPECT_FALSE(find_sheet(few));
}

TEST(Profiles, AreOrderedAlongTheLineWithGapsInTheirCells) {
  FramePoints line;
  for (const int i : {3, 0, 12, 1, 2, 11, 13, 10, 4, 5})
    line.cloud.points.emplace_back(0.0f, 0.001f * float(i), 0.5f);
  const FramePoints row = in_sheet_order(line, {Vec3d::UnitZ(), Vec3d::UnitY()});
  for (std::size_t i = 1; i < row.cloud.size(); ++i)
    EXPECT_GT(row.cloud.points[i].y(), row.cloud.points[i - 1].y());
  EXPECT_EQ(row.cell, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 7, 8, 9, 10}));
}

TEST(Profiles, AreGroupedWhileTheyAreSeenFromNearlyTheSamePlace) {
  ProfileGroups groups;
  std::vector<std::size_t> sizes;
  for (int i = 0; i < 40; ++i) {
    Profile profile;
    profile.points.cloud.points = {Vec3f(0, 0, 0.4f)};
    profile.T_table_sensor = rotation_about_y(i * std::numbers::pi / 180.0);
    profile.T_table_sensor.translate(Vec3d(0, 0, -0.4));
    const auto done = groups.add(profile);
    if (!done.empty()) sizes.push_back(done.size());
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{9, 9, 9, 9}));  // of 1 degree each, one shared
  EXPECT_EQ(groups.flush().size(), 8u);
  EXPECT_TRUE(groups.flush().empty());
}

}  // namespace
}  // namespace turnscan::views
