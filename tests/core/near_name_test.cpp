#include <turnscan/core/near_name.hpp>

#include <gtest/gtest.h>

namespace turnscan {
namespace {

const std::vector<std::string> kNames{"pass", "voxel-size", "radius", "texture-size"};

TEST(NearName, IsOneThatIsSpelledAlmostSo) {
  EXPECT_EQ(near_name("radus", kNames), "radius");
  EXPECT_EQ(near_name("voxl-size", kNames), "voxel-size");
}

TEST(NearName, IsOneThatBeginsSo) { EXPECT_EQ(near_name("texture", kNames), "texture-size"); }

TEST(NearName, IsNoneWhereAllAreFar) {
  EXPECT_FALSE(near_name("frames", kNames));
  EXPECT_FALSE(near_name("fps", kNames));
  EXPECT_FALSE(near_name("", kNames));
  EXPECT_FALSE(near_name("radius", {}));
}

}  // namespace
}  // namespace turnscan
