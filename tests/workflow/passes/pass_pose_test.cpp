#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <turnscan/workflow/passes/pass_pose.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

Result<PassPose> from_file(const testing::TempFolder& folder, const std::string& content) {
  const auto path = folder / "pose.txt";
  std::ofstream(path) << content;
  return parse_pass_pose("3=" + path.string());
}

TEST(PassPoseText, TurnsAboutFixedAxesAndThenShifts) {
  const auto pose = parse_pass_pose("2=90deg,0deg,90deg,10mm,0,-2cm");
  ASSERT_TRUE(pose) << pose.error().message;
  EXPECT_EQ(pose->pass, 2u);
  // About x, y goes to z; then about z, z stays.
  const Vec3d moved = pose->T_first_table * Vec3d::UnitY();
  EXPECT_LT((moved - Vec3d(0.01, 0.0, 1.0 - 0.02)).norm(), 1e-12) << moved.transpose();
  const Vec3d x = pose->T_first_table.linear() * Vec3d::UnitX();
  EXPECT_LT((x - Vec3d::UnitY()).norm(), 1e-12) << x.transpose();
}

TEST(PassPoseText, ReadsTheRowsOfAMatrix) {
  const testing::TempFolder folder;
  const auto pose = from_file(folder, "1 0 0 0.5\n0 0 -1 0\n0 1 0 0\n0 0 0 1\n");
  ASSERT_TRUE(pose) << pose.error().text();
  EXPECT_EQ(pose->pass, 3u);
  EXPECT_LT((pose->T_first_table * Vec3d::UnitY() - Vec3d(0.5, 0, 1)).norm(), 1e-9);
  EXPECT_TRUE(from_file(folder, "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"));
}

TEST(PassPoseText, RefusesWhatIsNoPose) {
  for (const char* text :
       {"1", "x=0,0,0,0,0,0", "1=", "1=0,0,0,0,0", "-1=0,0,0,0,0,0", "1.5=0,0,0,0,0,0",
        "1=90,0,0,0,0,0", "1=0,0,0,5,0,0", "1=nandeg,0,0,0,0,0", "1=/nowhere/pose.txt"})
    EXPECT_FALSE(parse_pass_pose(text)) << text;
  const testing::TempFolder folder;
  EXPECT_FALSE(from_file(folder, "1 0 0 0\n0 1 0 0\n0 0 1 0\n"));
  EXPECT_FALSE(from_file(folder, "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n7"));
  EXPECT_FALSE(from_file(folder, "1 0 0 0\n0 1 0 x\n0 0 1 0\n0 0 0 1\n"));
  const auto mirrored = from_file(folder, "-1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  ASSERT_FALSE(mirrored);
  EXPECT_NE(mirrored.error().text().find("pose.txt"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
