#include <gtest/gtest.h>

#include <turnscan/workflow/simulation/coverage_sweep.hpp>

#include "tests/workflow/scenes.hpp"

namespace turnscan {
namespace {

TEST(CoverageSweep, ReadsFromToAndStepWithTheirUnits) {
  const auto range = parse_sweep_range("roll=-45deg..45deg/10deg", {});
  ASSERT_TRUE(range) << range.error().text();
  EXPECT_EQ(range->option, "roll");
  ASSERT_EQ(range->values.size(), 10u);
  EXPECT_NEAR(range->values.front(), -EIGEN_PI / 4, 1e-12);
  EXPECT_NEAR(range->values.back(), EIGEN_PI / 4, 1e-12);
  EXPECT_EQ(parse_sweep_range("distance=0.5m..0.7m/10cm", {})->values.size(), 3u);
  EXPECT_EQ(parse_sweep_range("roll=-30deg..30deg/10deg", {})->values[3], 0.0);
  const auto speeds = parse_sweep_range("speed=10deg/s..30deg/s/5deg/s", {});
  ASSERT_TRUE(speeds) << speeds.error().text();
  EXPECT_EQ(speeds->values.size(), 5u);
}

TEST(CoverageSweep, RefusesWhatIsNoRangeOfANumberOfTheScene) {
  for (const char* text : {"roll", "roll=1deg", "roll=1deg..2deg", "roll=1..2/1",
                           "roll=2deg..1deg/1deg", "roll=0deg..1deg/0deg", "roll=0deg..1deg/-1deg",
                           "roll=0deg..90deg/0.01deg", "noise=1..2/1", "rol=0deg..1deg/1deg"}) {
    const auto range = parse_sweep_range(text, {});
    ASSERT_FALSE(range) << text;
    EXPECT_EQ(range.error().code, ErrorCode::kInvalidOption) << text;
    // A window has no such option.
    EXPECT_EQ(range.error().text().find("--sweep"), std::string::npos) << range.error().text();
  }
  for (const char* text : {"roll=wide..2deg/1deg", "roll=2deg..1deg/1deg"})
    EXPECT_EQ(parse_sweep_range(text, {}).error().text().substr(0, 6), "roll: ") << text;
}

TEST(CoverageSweep, GivesTheCoverageOfEachValueAndNamesTheBest) {
  SceneDescription scene = testing::cylinder_scene(3);
  const SweepRange range = *parse_sweep_range("elevation=0deg..60deg/30deg", scene);
  const auto swept = sweep_coverage(scene, range, {}, RunContext());
  ASSERT_TRUE(swept) << swept.error().text();
  ASSERT_EQ(swept->size(), 3u);
  scene.placement.elevation_rad = range.values[1];
  const auto simulation = prepare_simulation(scene, RunContext());
  const auto map = coverage_of(*simulation, {}, RunContext());
  EXPECT_EQ((*swept)[1].covered, map->covered());
  // Level with the cylinder its top is not seen.
  EXPECT_LT((*swept)[0].covered + 0.05, (*swept)[1].covered);
  const std::string text = sweep_text(range, *swept);
  const auto best = (*swept)[1].covered >= (*swept)[2].covered ? "30deg" : "60deg";
  EXPECT_NE(text.find(std::string("elevation = ") + best + " covers most"), std::string::npos)
      << text;
  const std::string svg = sweep_svg(range, *swept);
  EXPECT_TRUE(svg.starts_with("<svg xmlns"));
  EXPECT_NE(svg.find("elevation in deg"), std::string::npos);
}

TEST(CoverageSweep, FailsWithAValueThatTheSceneRefuses) {
  const SceneDescription scene = testing::cylinder_scene(2);
  const SweepRange range = *parse_sweep_range("elevation=80deg..100deg/20deg", scene);
  EXPECT_EQ(sweep_coverage(scene, range, {}, RunContext()).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
