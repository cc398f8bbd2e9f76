#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <turnscan/core/arc_tangent.hpp>

namespace turnscan {
namespace {

TEST(ArcTangent, IsThatOfTheLibraryToSevenDigits) {
  for (int i = -7200; i <= 7200; ++i) {
    const double turn = std::numbers::pi * i / 7200.0, length = 1.0 + (i + 7200) % 7;
    const auto y = static_cast<float>(length * std::sin(turn));
    const auto x = static_cast<float>(length * std::cos(turn));
    EXPECT_NEAR(arc_tangent(y, x), std::atan2(double(y), double(x)), 3e-7) << turn;
  }
}

TEST(ArcTangent, IsExactWhereAnAxisPoints) {
  EXPECT_EQ(arc_tangent(0.0f, 0.0f), 0.0f);
  EXPECT_EQ(arc_tangent(0.0f, 2.0f), 0.0f);
  EXPECT_EQ(arc_tangent(2.0f, 0.0f), std::numbers::pi_v<float> / 2.0f);
  EXPECT_EQ(arc_tangent(0.0f, -2.0f), std::numbers::pi_v<float>);
  EXPECT_EQ(arc_tangent(-2.0f, 0.0f), -std::numbers::pi_v<float> / 2.0f);
}

TEST(ArcTangent, HasTheseBitsOnEveryMachine) {
  EXPECT_EQ(arc_tangent(1.0f, 3.0f), 0x1.4978fcp-2f);
  EXPECT_EQ(arc_tangent(0.7f, -0.3f), 0x1.f9c6b4p+0f);
}

}  // namespace
}  // namespace turnscan
