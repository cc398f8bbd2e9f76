// What `turnscan plan` predicts and chooses, against simulated scans.
//
//   plan_bench model MESHES [SEED] [COUNT] [meshes]
//     random rigs: predicted coverage beside that of the coverage command, predicted median error
//     beside that of the reconstruction (with `meshes`), and the parts of the error model. Seeds
//     from 1000 on take objects to which that was not fitted.
//   plan_bench choices MESHES [OBJECTS]
//     the same of what the planner chooses for one turn, and two. From 1000 on: of so many of the
//     objects to which it was not fitted.
//   plan_bench choice MESHES [N] [OBJECTS] [FIRST]
//     one, two and three turns of each sensor: the planner's choice, simulated and reconstructed,
//     beside the best of N random rigs. Those are drawn from a pool of turns (a place, and the
//     object in one pose), each simulated once with the coverage command's map; what a rig covers
//     is the union of its turns' cells, and the best rig is judged by the command as a whole, too.
//     Random places are 40 over the whole range and 12 more about the two best of them, as densely
//     as 400 would lie there; the object lies in all its poses for 5 of them. Plans of one turn
//     are reconstructed, too. FIRST: position of the first pair of object and sensor.
//
// MESHES: a folder of meshes beside the built-in objects. Takes minutes: a scan is simulated and
// reconstructed for each line.

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

constexpr const char* kModelHeader =
    "case object scanner turns distance mm, elevation deg | covered: predicted command | error mm: "
    "predicted made | parts noise sigma spacing relief relief-6mm-noise\n";

/// What is predicted of a rig, and what a simulated scan makes of it.
void print_prediction(const std::string& title, const PlanRequest& request, const PlanField& field,
                      PlanSearch& search, const Rig& rig, bool reconstruct) {
  const RigScore score = search.score(rig, Prefer::kCovered);
  const SceneDescription scene = scene_of(request, plan_from(field, rig), 0);
  PlanTrial trial;
  trial.median_error_m = std::nan("");
  if (reconstruct) {
    TrialRunner runner(request);
    const auto trials = runner.run({{"trial", scene, &field.objects[0].given}}, {});
    if (trials) trial = trials->front();
  } else {
    const auto simulation = prepare_simulation(scene, field.objects[0].given, {});
    if (simulation) trial.covered = coverage_of(*simulation, {}, {})->covered();
  }
  const auto parts = median_parts(field, rig);
  const std::string& object = request.objects.front();
  fmt::print(
      "{} {} {} {}x{} {:.0f} {:.0f} | {:.2f} {:.2f} | {:.3f} {:.3f} | {:.3f} {:.3f} {:.3f} "
      "{:.3f} {:.3f} {}\n",
      title, object.substr(object.find_last_of("/:") + 1), request.scanners.front().model,
      rig.places.size(), rig.poses[0].size(), 1e3 * rig.places[0].placement.distance_m,
      57.3 * rig.places[0].placement.elevation_rad, 100.0 * score.covered, 100.0 * trial.covered,
      1e3 * score.median_error_m, 1e3 * trial.median_error_m, parts[0], parts[1], parts[2],
      parts[3], parts[4], trial.failure);
  std::fflush(stdout);
}

int run_model(const std::string& meshes, std::uint64_t first, int count, bool reconstruct) {
  const auto objects = first < kFirstHeldOut ? bench_objects(meshes) : held_out(meshes);
  fmt::print(kModelHeader);
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
    PlanSearch search(request, *field);
    print_prediction(std::to_string(seed), request, *field, search,
                     random_rig(request, *field, turns, seed), reconstruct);
  }
  return 0;
}

/// The same of what the planner chooses: one turn, and two.
Result<> predict_choice(const BenchObject& object, const char* scanner) {
  PlanRequest request = request_for(object, scanner);
  request.options.passes = request.options.sensors = 2;
  TURNSCAN_ASSIGN(const PlanField field, make_plan_field(request, {}));
  PlanSearch search(request, field);
  TURNSCAN_TRY(search.look({}));
  TURNSCAN_ASSIGN(const auto rigs, search.choose_all({}));
  for (const ChosenRig& rig : rigs) {
    if (rig.rig.places.size() * rig.passes > 2) continue;
    TURNSCAN_ASSIGN(const ChosenRig refined, search.refined(rig, {}));
    print_prediction("choice", request, field, search, refined.rig, true);
  }
  return {};
}

int run_choices(std::vector<BenchObject> objects, std::size_t most_objects) {
  objects.resize(std::min(objects.size(), most_objects));
  fmt::print(kModelHeader);
  for (const BenchObject& object : objects)
    for (const char* scanner : {"kinect-v2", "realsense-d435"})
      if (const auto done = predict_choice(object, scanner); !done)
        fmt::print("{} {}\n", object.name, done.error().text());
  return 0;
}

double command_covered(const PlanRequest& request, const PlanField& field, const Rig& rig) {
  const SceneDescription scene = scene_of(request, plan_from(field, rig), 0);
  const auto simulation = prepare_simulation(scene, field.objects[0].given, {});
  return simulation ? coverage_of(*simulation, {}, {})->covered() : 0.0;
}

/// Cells of the coverage map that one turn covers: a place, and the object in one pose.
struct TurnCover {
  std::vector<std::uint8_t> cells;
  bool there() const { return !cells.empty(); }
};

/// Turns, each simulated once. A rig covers a cell where one of its turns does.
class CoverPool {
 public:
  CoverPool(const PlanRequest& request, const PlanField& field)
      : request_(request), field_(field), poses_(field.objects[0].poses.size()) {}

  std::size_t add(const PlanPlace& place, bool all_poses) {
    places_.push_back(place);
    turns_.emplace_back(poses_);
    for (std::size_t q = 0; q < (all_poses ? poses_ : 1); ++q) simulate(places_.size() - 1, q);
    if (all_poses) laid_.push_back(places_.size() - 1);
    return places_.size() - 1;
  }
  const PlanPlace& place(std::size_t i) const { return places_[i]; }
  std::size_t places() const { return places_.size(); }
  std::size_t simulated() const { return simulated_; }
  /// Places from which the object was simulated in all poses.
  const std::vector<std::size_t>& laid() const { return laid_; }

  double covered(const std::vector<std::size_t>& places,
                 const std::vector<std::uint32_t>& poses) const {
    double area = 0.0;
    for (std::size_t c = 0; c < area_m2_.size(); ++c) {
      const bool seen = std::any_of(places.begin(), places.end(), [&](std::size_t i) {
        return std::any_of(poses.begin(), poses.end(), [&](std::uint32_t q) {
          return turns_[i][q].there() && turns_[i][q].cells[c] != 0;
        });
      });
      if (seen) area += area_m2_[c];
    }
    return area / total_m2_;
  }

 private:
  /// The coverage command's map of this turn alone, on the cells of the first pass.
  void simulate(std::size_t place, std::size_t pose) {
    Rig rig{{places_[place]}, {{0}}};
    if (pose > 0) rig.poses[0].push_back(std::uint32_t(pose));
    const SceneDescription scene = scene_of(request_, plan_from(field_, rig), 0);
    const auto made = prepare_simulation(scene, field_.objects[0].given, {});
    if (!made) std::abort();
    const std::size_t pass = pose > 0 ? 1 : 0;
    const auto T_table_object = [&](std::size_t k) {
      return made->scan.pass(k).T_table_given() * made->placed[k].T_table_object;
    };
    std::vector<CoveragePass> further;
    if (pass > 0)
      further.push_back(
          {&made->scan.pass(1).scene(), T_table_object(0) * T_table_object(1).inverse()});
    std::vector<CoveragePose> poses;
    for (std::size_t i = 0; i < made->scan.frames().size(); ++i)
      if (const auto [k, there] = made->scan.place_of(i); k == pass)
        poses.push_back({0, made->scan.pass(k).T_table_sensor(there),
                         made->scan.pass(k).T_table_world(there), std::uint32_t(k)});
    CoverageMapOptions options;
    options.noise = true;  // as the coverage command does with the noise of a plan
    const std::vector<ScannerModel> scanners{field_.scanners[places_[place].scanner].model};
    const VirtualScan& first = made->scan.pass(0);
    const auto map = coverage_map(first.scene(), first.objects(), scanners, poses, options, {},
                                  first.room(), further);
    if (!map) std::abort();
    std::vector<std::uint8_t>& cells = turns_[place][pose].cells;
    area_m2_.clear();
    for (const CoverageCell& cell : map->cells) {
      area_m2_.push_back(cell.area_m2);
      cells.push_back(cell.state == CoverageState::kCovered || cell.state == CoverageState::kThin);
    }
    total_m2_ = map->area_m2;
    ++simulated_;
  }

  const PlanRequest& request_;
  const PlanField& field_;
  std::size_t poses_, simulated_ = 0;
  std::vector<PlanPlace> places_;
  std::vector<std::vector<TurnCover>> turns_;  ///< [place][pose]
  std::vector<std::size_t> laid_;
  std::vector<double> area_m2_;
  double total_m2_ = 0.0;
};

constexpr std::size_t kPoolPlaces = 40, kLaidPlaces = 3, kNearPlaces = 12;

/// Places anywhere; then, about the two of these that cover most, as densely as 400 would lie
/// there; the best one and others with the object in all its poses.
CoverPool make_pool(const PlanRequest& request, const PlanField& field) {
  CoverPool pool(request, field);
  for (std::size_t i = 0; i < kPoolPlaces; ++i)
    pool.add(random_place(request, field, hash_key(21, i)), i < kLaidPlaces);
  std::vector<std::size_t> order(pool.places());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return pool.covered({a}, {0}) > pool.covered({b}, {0});
  });
  const DistanceRange range = *distances_of(request, field, field.scanners[0].model);
  const PlanOptions& o = request.options;
  for (std::size_t i = 0; i < kNearPlaces; ++i) {
    PlanPlace place = pool.place(order[i % 2]);
    const auto moved = [&](std::uint64_t what, double at, double least, double greatest) {
      const double reach = 0.06 * (greatest - least);
      return std::clamp(at + draw(hash_key(22, i), what, -reach, reach), least, greatest);
    };
    auto& at = place.placement;
    at.distance_m = moved(1, at.distance_m, range.least_m, range.greatest_m);
    at.elevation_rad = moved(2, at.elevation_rad, o.lowest_elevation_rad, o.highest_elevation_rad);
    pool.add(place, i < 2);
  }
  return pool;
}

/// Positions in the pool, and poses, of random_rig()'s kind.
struct PooledRig {
  std::vector<std::size_t> places;
  std::vector<std::uint32_t> poses{0};
  double covered = 0.0;
};

PooledRig random_pooled(const CoverPool& pool, std::size_t poses, std::size_t turns,
                        std::uint64_t seed) {
  PooledRig rig;
  const bool sensors = turns == 1 || uniform01(hash_key(seed, 7)) < 0.5;
  if (sensors)
    for (std::size_t k = 0; k < turns; ++k)
      rig.places.push_back(hash_key(seed, 8, k) % pool.places());
  else
    rig.places.push_back(pool.laid()[hash_key(seed, 8) % pool.laid().size()]);
  for (std::size_t k = 1; k < (sensors ? 1 : turns) && k < poses; ++k)
    if (const auto q = std::uint32_t(1 + hash_key(seed, 9, k) % (poses - 1));
        std::find(rig.poses.begin(), rig.poses.end(), q) == rig.poses.end())
      rig.poses.push_back(q);
  rig.covered = pool.covered(rig.places, rig.poses);
  return rig;
}

Rig rig_of(const CoverPool& pool, const PooledRig& pooled) {
  Rig rig;
  for (const std::size_t i : pooled.places) {
    rig.places.push_back(pool.place(i));
    rig.places.back().placement.azimuth_rad = 1.5 * double(rig.places.size() - 1);
  }
  rig.poses.push_back(pooled.poses);
  return rig;
}

/// The most covered of n random rigs of the pool.
PooledRig best_random(const CoverPool& pool, std::size_t poses, std::size_t turns, int n) {
  PooledRig best;
  for (int i = 0; i < n; ++i) {
    PooledRig rig = random_pooled(pool, poses, turns, hash_key(11, turns, std::uint64_t(i)));
    if (rig.covered > best.covered) best = std::move(rig);
  }
  return best;
}

struct ChoiceCounts {
  int all = 0, kept = 0, area_near = 0, errors = 0, errors_near = 0;
};

/// A line of the table: the planner's choice of so many turns beside the best random rig.
Result<> compare_turns(const PlanRequest& request, const PlanField& field, PlanSearch& search,
                       const std::vector<ChosenRig>& rigs, const CoverPool& pool, std::size_t turns,
                       int n, ChoiceCounts& counts) {
  const ChosenRig* best = nullptr;
  for (const ChosenRig& rig : rigs)
    if (rig.rig.places.size() * rig.passes <= turns &&
        (best == nullptr || rig.score.covered > best->score.covered))
      best = &rig;
  if (best == nullptr) return {};
  TURNSCAN_ASSIGN(const ChosenRig mine, search.refined(*best, {}));
  PlanTrial trial;
  trial.median_error_m = std::nan("");
  if (turns == 1) {
    TrialRunner runner(request);
    const SceneDescription scene = scene_of(request, plan_from(field, mine.rig), 0);
    TURNSCAN_ASSIGN(const auto trials, runner.run({{"trial", scene, &field.objects[0].given}}, {}));
    trial = trials.front();
  } else {
    trial.covered = command_covered(request, field, mine.rig);
  }
  const PooledRig random = best_random(pool, field.objects[0].poses.size(), turns, n);
  const double judged = command_covered(request, field, rig_of(pool, random));
  const bool made = std::isfinite(trial.median_error_m);
  ++counts.all;
  counts.kept += trial.covered >= std::max(judged, random.covered) - 0.005 ? 1 : 0;
  counts.area_near += std::abs(mine.score.covered - trial.covered) <= 0.01 ? 1 : 0;
  counts.errors += made ? 1 : 0;
  counts.errors_near +=
      made && std::abs(mine.score.median_error_m / trial.median_error_m - 1.0) <= 0.2 ? 1 : 0;
  fmt::print("{} | {}x{} {:.2f} {:.2f} | {:.3f} {:.3f} | {:.2f} {:.2f} {}x{} | {} {} {}\n", turns,
             mine.rig.places.size(), mine.rig.poses[0].size(), 100.0 * trial.covered,
             100.0 * mine.score.covered, 1e3 * mine.score.median_error_m,
             1e3 * trial.median_error_m, 100.0 * random.covered, 100.0 * judged,
             random.places.size(), random.poses.size(), search.turns(), pool.simulated(),
             trial.failure);
  std::fflush(stdout);
  return {};
}

Result<> choice_of(const BenchObject& object, const char* scanner, int n, ChoiceCounts& counts) {
  PlanRequest request = request_for(object, scanner);
  request.options.passes = request.options.sensors = 3;
  TURNSCAN_ASSIGN(const PlanField field, make_plan_field(request, {}));
  auto begin = std::chrono::steady_clock::now();
  PlanSearch search(request, field);
  TURNSCAN_TRY(search.look({}));
  TURNSCAN_ASSIGN(const auto rigs, search.choose_all({}));
  const double plan_s = seconds_since(begin);
  begin = std::chrono::steady_clock::now();
  const CoverPool pool = make_pool(request, field);
  fmt::print("{} {}: looked and chosen in {:.0f} s, {} turns simulated in {:.0f} s\n",
             object.name.substr(object.name.find_last_of("/:") + 1), scanner, plan_s,
             pool.simulated(), seconds_since(begin));
  for (std::size_t turns = 1; turns <= 3; ++turns)
    TURNSCAN_TRY(compare_turns(request, field, search, rigs, pool, turns, n, counts));
  return {};
}

int run_choice(const std::string& meshes, int n, std::size_t most_objects, std::size_t first) {
  auto objects = bench_objects(meshes);
  objects.resize(std::min(objects.size(), most_objects));
  fmt::print(
      "turns | plan: sensors x passes, covered, predicted | error mm: predicted, made | best of {} "
      "random: covered by the union, by the command, sensors x passes | turns looked at, pool\n",
      n);
  ChoiceCounts counts;
  constexpr std::array kScanners{"kinect-v2", "realsense-d435"};
  for (std::size_t i = first; i < objects.size() * kScanners.size(); ++i) {
    const BenchObject& object = objects[i / kScanners.size()];
    if (const auto done = choice_of(object, kScanners[i % kScanners.size()], n, counts); !done)
      fmt::print("{} {}\n", object.name, done.error().text());
  }
  fmt::print(
      "{} of {} at least the best random one minus 0.5 %; {} areas within 1 %; {} of {} errors "
      "within 20 %\n",
      counts.kept, counts.all, counts.area_near, counts.errors_near, counts.errors);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print("Usage: plan_bench model|choices|choice MESHES ...\n");
    return 2;
  }
  const auto number = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  if (std::strcmp(argv[1], "model") == 0)
    return run_model(argv[2], std::uint64_t(number(3, 1)), number(4, 12), argc > 5);
  if (std::strcmp(argv[1], "choices") == 0) {
    const int objects = number(3, 6);
    const bool others = objects >= int(kFirstHeldOut);
    return run_choices(others ? held_out(argv[2]) : bench_objects(argv[2]),
                       std::size_t(others ? objects - int(kFirstHeldOut) : objects));
  }
  return run_choice(argv[2], number(3, 2000), std::size_t(number(4, 6)), std::size_t(number(5, 0)));
}
