#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/turntable/motion_input/depth_steps.hpp>

namespace turnscan::motion {
namespace {

/// Depths from 0.6 to 1.3 m in whole millimetres, as triangulation tells them: in steps of
/// disparity.
std::vector<float> triangulated(double step_per_square_m) {
  std::vector<float> out;
  for (int k = 0; k < 200000; ++k) {
    const double inverse = 1.0 / (0.6 + 0.7 * k / 200000.0);
    const double rounded = std::round(inverse / step_per_square_m) * step_per_square_m;
    out.push_back(float(std::round(1e3 / rounded) * 1e-3));
  }
  return out;
}

TEST(DepthSteps, GrowWithTheSquareOfTheDepth) {
  const DepthSteps steps({triangulated(0.003)}, 0.001);
  EXPECT_NEAR(steps.at(0.8), 0.003 * 0.64, 0.001);
  EXPECT_NEAR(steps.at(1.2), 0.003 * 1.44, 0.001);
}

TEST(DepthSteps, AreTheUnitWhereASensorTellsEveryDepth) {
  const DepthSteps steps({triangulated(1e-6)}, 0.001);
  EXPECT_NEAR(steps.at(0.8), 0.001, 1e-5);
  EXPECT_NEAR(steps.at(1.2), 0.001, 1e-5);
}

TEST(DepthSteps, OfFewDepthsAreUnknown) {
  const DepthSteps steps({std::vector<float>(1000, 0.8f)}, 0.001);
  EXPECT_EQ(steps.at(0.8), 0.0);
  EXPECT_EQ(DepthSteps().at(0.8), 0.0);
}

}  // namespace
}  // namespace turnscan::motion
