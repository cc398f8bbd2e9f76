#include <gtest/gtest.h>

#include <turnscan/simulator/noise/noise.hpp>

namespace turnscan {
namespace {

TEST(NoiseOptions, KnowsEachKind) {
  EXPECT_EQ(parse_noise_options("none")->kind, NoiseKind::kNone);
  EXPECT_EQ(parse_noise_options("model")->kind, NoiseKind::kModel);
  EXPECT_EQ(parse_noise_options("physics")->kind, NoiseKind::kPhysics);
  const auto gaussian = parse_noise_options("gaussian:1.5mm");
  ASSERT_TRUE(gaussian);
  EXPECT_EQ(gaussian->kind, NoiseKind::kGaussian);
  EXPECT_DOUBLE_EQ(gaussian->sigma_m, 1.5e-3);
}

TEST(NoiseOptions, RefusesWhatIsNoNoise) {
  for (const char* text : {"", "None", "gaussian", "gaussian:", "gaussian:1.5", "gaussian:-1mm",
                           "gaussian:2m", "gaussian:nanmm", "models"}) {
    const auto options = parse_noise_options(text);
    ASSERT_FALSE(options) << text;
    EXPECT_EQ(options.error().code, ErrorCode::kInvalidOption) << text;
    EXPECT_NE(options.error().message.find("noise"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace turnscan
