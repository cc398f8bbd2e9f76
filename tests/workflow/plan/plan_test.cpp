#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/core/parallel.hpp>
#include <turnscan/workflow/plan/plan_search.hpp>
#include <turnscan/workflow/plan/plan_trial.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using namespace workflow;
using testing::content_of;
using testing::TempFolder;

/// Few candidates of a small object.
PlanRequest small_request() {
  PlanRequest request;
  request.objects = {"builtin:letter-a"};
  request.scanners = {{"kinect-v2", {}}};
  request.scene.object_placement.height_m = 0.12;
  request.scene.motion.frames = 12;
  request.options.distances = 2;
  request.options.elevations = 3;
  request.options.spots = 600;
  request.options.trials = 0;
  return request;
}

TEST(Plan, PredictsWhatTheCoverageCommandCounts) {
  PlanRequest request = small_request();
  request.options.spots = 3000;
  request.options.passes = 2;
  const auto field = make_plan_field(request, {});
  ASSERT_TRUE(field) << field.error().text();
  PlanSearch search(request, *field);
  for (const std::size_t place : {0u, 2u, 4u}) {
    Plan plan;
    plan.sensors = {entry_of(*field, field->places[place])};
    plan.next_passes = {{}};
    const Rig rig{{field->places[place]}, {{0}}};
    const auto simulation = prepare_simulation(scene_of(request, plan, 0), {});
    ASSERT_TRUE(simulation) << simulation.error().text();
    const auto map = coverage_of(*simulation, {}, {});
    ASSERT_TRUE(map);
    EXPECT_NEAR(search.score(rig, Prefer::kCovered).covered, map->covered(), 0.01) << place;
  }
}

TEST(PlanTrials, SayWhyAScanGaveNoMesh) {
  PlanRequest request = small_request();
  request.options.passes = 2;
  const auto field = make_plan_field(request, {});
  ASSERT_TRUE(field) << field.error().text();
  // Laid on its back the letter looks the same turned by half a turn.
  Plan plan;
  plan.sensors = {entry_of(*field, field->places[0])};
  plan.next_passes = {{field->objects[0].poses[1].entry}};
  TrialRunner runner(request);
  const auto trials =
      runner.run({{"trial", scene_of(request, plan, 0), &field->objects[0].given}}, {});
  ASSERT_TRUE(trials) << trials.error().text();
  ASSERT_EQ(trials->size(), 1u);
  EXPECT_THAT(trials->front().failure, ::testing::HasSubstr("not joined"));
  EXPECT_GT(trials->front().covered, 0.5);
}

TEST(Plan, LaysTheObjectAsItsScenesDo) {
  PlanRequest request = small_request();
  request.options.passes = 2;
  const auto field = make_plan_field(request, {});
  ASSERT_TRUE(field) << field.error().text();
  const PlanObject& object = field->objects.front();
  ASSERT_GT(object.poses.size(), 2u);
  for (const PlanPose& pose : object.poses) {
    double lowest = 1.0;
    for (const Vec3f& p : object.mesh.vertices)
      lowest = std::min(lowest, (pose.T_table_first * p.cast<double>()).y());
    EXPECT_NEAR(lowest, 0.0, 1e-5);
  }
}

TEST(Plan, MoreSensorsAndPassesCoverMoreAndNothingIsBeaten) {
  PlanRequest request = small_request();
  request.options.sensors = request.options.passes = 2;
  const auto outcome = run_plan(request, {});
  ASSERT_TRUE(outcome) << outcome.error().text();
  ASSERT_GE(outcome->plans.size(), 2u);
  for (std::size_t i = 1; i < outcome->plans.size(); ++i)
    EXPECT_LE(outcome->plans[i].covered, outcome->plans[i - 1].covered);
  for (const Plan& plan : outcome->plans) {
    EXPECT_LE(plan.covered, plan.most_covered + 1e-12);
    EXPECT_GT(plan.median_error_m, 0.0);
    EXPECT_FALSE(plan.unseen.empty());
    EXPECT_FALSE(plan.trial);
  }
  EXPECT_GT(outcome->plans.front().turns(), outcome->plans.back().turns());
}

TEST(Plan, KeepsToItsLimits) {
  PlanRequest request = small_request();
  request.options.sensors = request.options.passes = 3;
  request.options.time_budget_s = 80.0;  // one pass of 30 s; two take 90 s
  request.options.least_distance_m = 0.7;
  request.options.greatest_distance_m = 0.75;
  request.options.lowest_elevation_rad = 0.3;
  request.options.highest_elevation_rad = 0.5;
  const auto outcome = run_plan(request, {});
  ASSERT_TRUE(outcome) << outcome.error().text();
  for (const Plan& plan : outcome->plans) {
    EXPECT_EQ(plan.passes(), 1u);
    EXPECT_LE(plan.sensors.size(), 3u);
    const auto options = scan_options(scene_of(request, plan, 0));
    ASSERT_TRUE(options);
    for (const VirtualScanner& scanner : options->scanners) {
      EXPECT_GE(scanner.placement.distance_m, 0.7 - 1e-6);
      EXPECT_LE(scanner.placement.distance_m, 0.75 + 1e-6);
      EXPECT_GE(scanner.placement.elevation_rad, 0.3 - 1e-5);
      EXPECT_LE(scanner.placement.elevation_rad, 0.5 + 1e-5);
    }
  }
}

TEST(Plan, CountsOnlyWhatIsAsExactAsAskedFor) {
  EXPECT_EQ(worth_of(0.4e-3, 0.3e-3, Prefer::kCovered), 0);
  EXPECT_GT(worth_of(0.2e-3, 0.3e-3, Prefer::kCovered), worth_of(0.3e-3, 0.3e-3, Prefer::kCovered));
  EXPECT_GT(double(worth_of(5e-3, {}, Prefer::kCovered)), 0.99 * kFullWorth);
  PlanRequest request = small_request();
  const auto all = run_plan(request, {});
  request.options.max_error_m = all->plans.front().median_error_m;
  const auto some = run_plan(request, {});
  ASSERT_TRUE(all && some);
  EXPECT_LT(some->plans.front().covered, all->plans.front().covered);
}

TEST(Plan, WritesTheSameBytesForEveryNumberOfThreads) {
  const TempFolder folder;
  PlanRequest request = small_request();
  request.folder = (folder / "many").string();
  const auto many = run_plan(request, {});
  ASSERT_TRUE(many) << many.error().text();
  const std::string first = content_of(folder / "many" / "plan.json");
  const std::string picture = content_of(folder / "many" / "plan-1.png");
  run_on_this_thread([&] { ASSERT_TRUE(run_plan(request, {})); });
  EXPECT_EQ(content_of(folder / "many" / "plan.json"), first);
  EXPECT_EQ(content_of(folder / "many" / "plan-1.png"), picture);
  SceneDescription scene;
  ASSERT_TRUE(read_scene(folder / "many" / "plan-1.toml", scene));
  EXPECT_EQ(scene.scanners.size(), many->plans.front().sensors.size());
}

TEST(Plan, CanBeCancelledAndSaysHowFarItIs) {
  RunContext context;
  std::vector<std::string> phases;
  context.set_listener([&](const Progress& progress) {
    if (phases.empty() || phases.back() != progress.phase) phases.push_back(progress.phase);
    if (progress.phase == "candidates") context.cancel();
  });
  const auto outcome = run_plan(small_request(), context);
  context.set_listener({});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(phases.back(), "candidates");
}

TEST(Plan, SaysInOneLineWhatIsWrong) {
  const auto error_of = [](const std::function<void(PlanRequest&)>& change) {
    PlanRequest request = small_request();
    change(request);
    const auto outcome = run_plan(request, {});
    EXPECT_FALSE(outcome);
    const std::string text = outcome ? std::string() : outcome.error().text();
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.objects.clear(); }), "no object"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.scanners.clear(); }), "no scanner"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.scanners[0].model = "gocator"; }), "line"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.options.greatest_distance_m = 0.02; }),
                  "least-distance"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.options.lowest_elevation_rad = 1.4; }),
                  "lowest-elevation"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.options.max_error_m = 1e-5; }), "well enough"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.objects = {"nowhere.ply"}; }), "nowhere.ply"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) { r.options.time_budget_s = 1.0; }), "time-budget"));
  EXPECT_TRUE(has(error_of([](PlanRequest& r) {
                    r.scanners[0].options = {{"distance", "1m"}};
                  }),
                  "distance"));
}

TEST(Plan, LeavesAFolderAloneThatIsNotItsOwn) {
  // The last ones look like files of a plan, and are none.
  for (const char* name : {"letter.txt", "plan-b.ply", "plan-1.ply", "plan-notes.toml"}) {
    const TempFolder folder;
    std::filesystem::create_directories(folder / "kept");
    std::ofstream(folder / "kept" / name) << "mine";
    PlanRequest request = small_request();
    request.folder = (folder / "kept").string();
    const auto outcome = run_plan(request, {});
    ASSERT_FALSE(outcome) << name;
    EXPECT_EQ(outcome.error().code, ErrorCode::kAlreadyExists);
    EXPECT_EQ(content_of(folder / "kept" / name), "mine");
  }
}

TEST(PlanScanners, AreDividedAtNamesWithoutValues) {
  const auto scanners = parse_plan_scanners({"kinect-v2,roll=90deg,realsense-d435", "kinect-v1"});
  ASSERT_TRUE(scanners);
  ASSERT_EQ(scanners->size(), 3u);
  EXPECT_EQ((*scanners)[0].options.size(), 1u);
  EXPECT_EQ((*scanners)[1].model, "realsense-d435");
  EXPECT_FALSE(parse_plan_scanners({"kinect-v2,roll=much"}));
}

}  // namespace
}  // namespace turnscan
