#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>

#include "tests/support/sanitizers.hpp"
#include "tests/support/temp_folder.hpp"
#include "tests/workflow/scenes.hpp"

namespace turnscan {
namespace {

using Names = std::set<std::string>;
using testing::TempFolder;

Names names_in(const PhasePlan& plan) {
  Names names;
  for (const PlannedPhase& phase : plan) names.insert(phase.name);
  return names;
}

/// The phases of a run, by name.
struct Watched {
  Watched() {
    context.set_listener([this](const Progress& progress) { names.insert(progress.phase); });
  }
  RunContext context;
  Names names;
};

Result<Simulation> cylinder() {
  return prepare_simulation(testing::cylinder_scene(30), RunContext());
}

class PhasesOfAReconstruction : public ::testing::TestWithParam<SurfaceMethod> {};

TEST_P(PhasesOfAReconstruction, AreThoseOfThePlan) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const auto scan = cylinder();
  ASSERT_TRUE(scan) << scan.error().text();
  ReconstructRequest request;
  request.options.surface.method = GetParam();
  request.options.voxels.size_m = 0.004;
  Watched watched;
  const auto run = run_reconstruction(scan->scan, request, watched.context);
  ASSERT_TRUE(run) << run.error().text();
  EXPECT_EQ(watched.names, names_in(reconstruct_phases({{"", &scan->scan}}, request)));
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, PhasesOfAReconstruction,
                         ::testing::Values(SurfaceMethod::kVolumetric, SurfaceMethod::kPoisson,
                                           SurfaceMethod::kConcaveHull));

TEST(PhasesOfASimulation, AreThoseOfThePlan) {
  const TempFolder folder;
  SimulateRequest request;
  request.scene = testing::cylinder_scene(3);
  request.recording = (folder / "rec").string();
  request.samples = true;
  request.coverage = (folder / "coverage.ply").string();
  Watched watched;
  const auto made = simulate(request, watched.context);
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(watched.names, names_in(simulate_phases(request)));
}

TEST(PhasesOfTwoPasses, AreReadOneByOneAndThenTogether) {
  const auto scan = cylinder();
  ASSERT_TRUE(scan) << scan.error().text();
  const std::vector<NamedSequence> two{{"a", &scan->scan}, {"b", &scan->scan}};
  const PhasePlan plan = reconstruct_phases(two, ReconstructRequest());
  const auto times = [&](const std::string& name) {
    return std::count_if(plan.begin(), plan.end(),
                         [&](const PlannedPhase& phase) { return phase.name == name; });
  };
  EXPECT_EQ(times("read frames"), 3);
  EXPECT_EQ(times("join passes"), 1);
  EXPECT_EQ(times("advise"), 1);
}

}  // namespace
}  // namespace turnscan
