// What `turnscan plan` predicts and chooses, against simulated scans.
//
//   plan_bench model MESHES [SEED] [COUNT] [meshes]
//     random rigs: predicted coverage beside that of the coverage command, predicted median error
//     beside that of the reconstruction (with `meshes`), and the parts of the error model. Seeds
//     from 1000 on take objects to which that was not fitted.
//   plan_bench choice MESHES [N] [OBJECTS]
//     one, two and three turns of each sensor: the planner's choice beside the best of N random
//     rigs, both judged by the coverage command; the number of evaluations of each.
//
// MESHES: a folder of meshes beside the built-in objects. Takes minutes: a scan is simulated and
// reconstructed for each line of the first, N of the second are looked at.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <turnscan/core/random.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/workflow/plan/plan_search.hpp>
#include <turnscan/workflow/plan/plan_trial.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace {

using namespace turnscan;
using namespace turnscan::workflow;

struct BenchObject {
  std::string name, height;
};

std::vector<BenchObject> bench_objects(const std::string& folder) {
  return {{folder + "/bunny.off", "160mm"},
          {folder + "/igea_tri.ply", "180mm"},
          {folder + "/rocker-arm.obj", "150mm"},
          {folder + "/spot.obj", "200mm"},
          {"builtin:doll", "180mm"},
          {"builtin:letter-a", "200mm"},
          {folder + "/dino.off", "180mm"},
          {folder + "/camel.off", "200mm"},
          {folder + "/man.off", "200mm"},
          {folder + "/triceratops.off", "120mm"},
          {"builtin:skull", "160mm"},
          {"builtin:scorpion", "60mm"}};
}

/// To which the error model was not fitted.
std::vector<BenchObject> held_out(const std::string& folder) {
  return {{folder + "/nefertiti.obj", "200mm"},        {folder + "/knot1.off", "150mm"},
          {folder + "/couplingdown.off", "120mm"},     {folder + "/turbine.off", "150mm"},
          {folder + "/refined_elephant.off", "180mm"}, {folder + "/anchor_dense.off", "120mm"}};
}
constexpr std::uint64_t kFirstHeldOut = 1000;  // seeds from there on

PlanRequest request_for(const BenchObject& object, const std::string& scanner) {
  PlanRequest request;
  request.objects = {object.name};
  request.scanners = {{scanner, {}}};
  (void)describe(request.scene.object_placement).set("height", object.height);
  return request;
}

double draw(std::uint64_t seed, std::uint64_t what, double least, double greatest) {
  return least + (greatest - least) * uniform01(hash_key(seed, what));
}

/// A place anywhere in the ranges of the request.
PlanPlace random_place(const PlanRequest& request, const PlanField& field, std::uint64_t seed) {
  PlanPlace place = field.places.front();
  const DistanceRange range = *distances_of(request, field, field.scanners[0].model);
  place.placement.distance_m = draw(seed, 1, range.least_m, range.greatest_m);
  place.placement.elevation_rad =
      draw(seed, 2, request.options.lowest_elevation_rad, request.options.highest_elevation_rad);
  return place;
}

Plan plan_from(const PlanField& field, const Rig& rig) {
  Plan plan;
  for (const PlanPlace& place : rig.places) plan.sensors.push_back(entry_of(field, place));
  auto& passes = plan.next_passes.emplace_back();
  for (const std::uint32_t q : rig.poses[0])
    if (q > 0) passes.push_back(field.objects[0].poses[q].entry);
  return plan;
}

/// Turns: sensors times passes. One, two (two sensors, or two passes) or three.
Rig random_rig(const PlanRequest& request, const PlanField& field, std::size_t turns,
               std::uint64_t seed) {
  const bool sensors = uniform01(hash_key(seed, 7)) < 0.5;
  Rig rig;
  rig.poses.push_back({0});
  for (std::size_t k = 0; k < (sensors ? turns : 1); ++k) {
    rig.places.push_back(random_place(request, field, hash_key(seed, 8, k)));
    rig.places.back().placement.azimuth_rad = 1.5 * double(k);
  }
  for (std::size_t k = 1; k < (sensors ? 1 : turns) && k < field.objects[0].poses.size(); ++k) {
    const std::size_t n = field.objects[0].poses.size() - 1;
    const auto pose = std::uint32_t(1 + hash_key(seed, 9, k) % n);
    auto& all = rig.poses[0];
    if (std::find(all.begin(), all.end(), pose) == all.end()) all.push_back(pose);
  }
  return rig;
}

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Medians of the parts of the error model, millimetres.
std::array<double, 5> median_parts(const PlanField& field, const Rig& rig) {
  const PlanObject& object = field.objects[0];
  std::vector<planning::SpotSight> all(object.surface.spots.size());
  for (const PlanPlace& place : rig.places)
    for (const std::uint32_t q : rig.poses[0]) {
      const auto sights = sights_from(field, object, object.poses[q], place);
      for (std::size_t i = 0; i < all.size(); ++i)
        if (sights[i].chance() > 0.0f) all[i] += sights[i];
    }
  std::array<std::vector<double>, 5> parts;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].seen()) continue;
    const auto each = planning::error_parts(object.surface.spots[i], all[i]);
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k].push_back(1e3 * each[k]);
  }
  return {median(parts[0]), median(parts[1]), median(parts[2]), median(parts[3]), median(parts[4])};
}

int run_model(const std::string& meshes, std::uint64_t first, int count, bool reconstruct) {
  const auto objects = first < kFirstHeldOut ? bench_objects(meshes) : held_out(meshes);
  fmt::print(
      "seed object scanner turns | covered: predicted command | error mm: predicted made | "
      "parts noise sigma spacing relief relief-6mm\n");
  for (std::uint64_t seed = first; seed < first + std::uint64_t(count); ++seed) {
    const BenchObject& object = objects[seed % objects.size()];
    const std::string scanner = hash_key(seed, 3) % 2 == 0 ? "kinect-v2" : "realsense-d435";
    const std::size_t turns = 1 + hash_key(seed, 4) % 3;
    PlanRequest request = request_for(object, scanner);
    request.options.passes = 3;
    const auto field = make_plan_field(request, {});
    if (!field) {
      fmt::print("{} {}\n", seed, field.error().text());
      continue;
    }
    const Rig rig = random_rig(request, *field, turns, seed);
    PlanSearch search(request, *field);
    const RigScore score = search.score(rig, Prefer::kCovered);
    const Plan plan = plan_from(*field, rig);
    const SceneDescription scene = scene_of(request, plan, 0);
    PlanTrial trial;
    trial.median_error_m = std::nan("");
    if (reconstruct) {
      TrialRunner runner(request);
      const auto trials = runner.run({{"trial", scene, &field->objects[0].given}}, {});
      if (trials) trial = trials->front();
    } else {
      const auto simulation = prepare_simulation(scene, field->objects[0].given, {});
      if (simulation) trial.covered = coverage_of(*simulation, {}, {})->covered();
    }
    const auto parts = median_parts(*field, rig);
    fmt::print(
        "{} {} {} {}x{} {:.0f} {:.0f} | {:.2f} {:.2f} | {:.3f} {:.3f} | {:.3f} {:.3f} {:.3f} "
        "{:.3f} {}\n",
        seed, object.name.substr(object.name.find_last_of("/:") + 1), scanner, rig.places.size(),
        rig.poses[0].size(), 1e3 * rig.places[0].placement.distance_m,
        57.3 * rig.places[0].placement.elevation_rad, 100.0 * score.covered, 100.0 * trial.covered,
        1e3 * score.median_error_m, 1e3 * trial.median_error_m, parts[0], parts[1], parts[2],
        parts[3], parts[4], trial.failure);
    std::fflush(stdout);
  }
  return 0;
}

double command_covered(const PlanRequest& request, const PlanField& field, const Rig& rig) {
  const SceneDescription scene = scene_of(request, plan_from(field, rig), 0);
  const auto simulation = prepare_simulation(scene, field.objects[0].given, {});
  return simulation ? coverage_of(*simulation, {}, {})->covered() : 0.0;
}

int run_choice(const std::string& meshes, int n, std::size_t most_objects) {
  auto objects = bench_objects(meshes);
  objects.resize(std::min(objects.size(), most_objects));
  fmt::print(
      "object scanner turns | plan: covered, turns looked at, s | best of {} random: covered, s\n",
      n);
  int kept = 0, all = 0;
  for (const BenchObject& object : objects) {
    for (const char* scanner : {"kinect-v2", "realsense-d435"}) {
      PlanRequest request = request_for(object, scanner);
      request.options.passes = request.options.sensors = 3;
      auto begin = std::chrono::steady_clock::now();
      const auto field = make_plan_field(request, {});
      if (!field) {
        fmt::print("{} {}\n", object.name, field.error().text());
        continue;
      }
      PlanSearch search(request, *field);
      if (!search.look({})) return 1;
      const auto rigs = search.choose_all({});
      if (!rigs) return 1;
      const double look_s = seconds_since(begin);
      for (std::size_t turns = 1; turns <= 3; ++turns) {
        begin = std::chrono::steady_clock::now();
        const ChosenRig* best = nullptr;
        for (const ChosenRig& rig : *rigs)
          if (!rig.error_first && rig.rig.places.size() * rig.passes <= turns &&
              (best == nullptr || rig.score.covered > best->score.covered))
            best = &rig;
        if (best == nullptr) continue;
        const auto refined = search.refined(*best, {});
        if (!refined) return 1;
        const double plan_s = look_s + seconds_since(begin);
        const double mine = command_covered(request, *field, refined->rig);
        begin = std::chrono::steady_clock::now();
        double random = 0.0;
        for (int i = 0; i < n; ++i)
          random =
              std::max(random, command_covered(request, *field,
                                               random_rig(request, *field, turns,
                                                          hash_key(11, turns, std::uint64_t(i)))));
        ++all, kept += mine >= random - 0.005 ? 1 : 0;
        fmt::print("{} {} {} | {:.2f} {} {:.1f} | {:.2f} {:.1f}\n",
                   object.name.substr(object.name.find_last_of("/:") + 1), scanner, turns,
                   100.0 * mine, search.turns(), plan_s, 100.0 * random, seconds_since(begin));
        std::fflush(stdout);
      }
    }
  }
  fmt::print("{} of {} at least the best random one minus 0.5 %\n", kept, all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print("Usage: plan_bench model|choice MESHES ...\n");
    return 2;
  }
  const auto number = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  if (std::strcmp(argv[1], "model") == 0)
    return run_model(argv[2], std::uint64_t(number(3, 1)), number(4, 12), argc > 5);
  return run_choice(argv[2], number(3, 2000), std::size_t(number(4, 6)));
}
