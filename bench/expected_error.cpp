// Whether the stated errors of vertices, and the verdicts, hold: random simulated scans, good and
// bad (random_rigs/recipe.hpp, and what vary() changes: sensors that are better, thin objects,
// scans that break off, dropped frames), reconstructed as the command does, judged by the truth.
// Usage: expected_error MESHES [FIRST_SEED] [COUNT] [MOST_FRAMES]
//        expected_error --table MOST_FRAMES [METRES]
// The second prints a table of the errors alone: objects, noise and numbers of frames, with the
// poses known, METRES (0.9) from the sensor.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <turnscan/core/random.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/seen_by.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>

#include "bench/random_rigs/frames.hpp"
#include "bench/random_rigs/recipe.hpp"

namespace {

using namespace turnscan;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// True over stated error of each vertex, of the measured ones.
std::vector<double> ratios(const ObjectResult& object, const TriangleMesh& truth,
                           const Pose& T_truth_mesh) {
  const auto measured = measured_vertices(object);
  const MeshDistance distance(truth);
  std::vector<double> out;
  const std::size_t stride = std::max<std::size_t>(1, measured.size() / 5000);
  for (std::size_t v = 0; v < measured.size(); v += stride) {
    if (!measured[v]) continue;
    const auto hit = distance.closest(T_truth_mesh * object.mesh.vertices[v].cast<double>());
    out.push_back(hit.distance / double(object.quality[v].expected_error_m));
  }
  return out;
}

/// A recipe, and what recipes leave out.
struct Scan {
  rigs::Recipe recipe;
  double dropped = 0.0;  ///< share of the frames
};

/// From 0 on, evenly below 1; another for each question.
double dice_of(int seed, std::uint64_t question) {
  return double(hash_key(question, std::uint64_t(seed)) >> 11) * 0x1.0p-53;
}

Scan vary(int seed, const std::string& meshes, int most_frames) {
  Scan out{rigs::make_recipe(std::uint64_t(seed), meshes, most_frames), 0.0};
  SceneDescription& scene = out.recipe.scene;
  const auto dice = [&](std::uint64_t question) { return dice_of(seed, question); };
  if (scene.measure.noise == "physics") {
    if (dice(1) < 0.33) scene.measure.noise = "model";
  } else {
    scene.measure.noise = fmt::format("gaussian:{:.2f}mm", 0.3 * std::pow(5.0, dice(2)));
  }
  if (dice(3) < 0.12) {
    constexpr std::array thin{"builtin:scorpion", "builtin:plate", "builtin:skull"};
    scene.object = thin[std::size_t(dice(4) * 3.0)];
  }
  if (dice(5) < 0.25) {
    const double share = 0.25 + 0.5 * dice(6);
    scene.motion.turns *= share / std::abs(scene.motion.turns);
    out.recipe.text += fmt::format(", broken off after {:.2f} turns", share);
  }
  if (dice(7) < 0.15) {
    out.dropped = 0.05 + 0.45 * dice(8);
    out.recipe.text += fmt::format(", {:.0f} % dropped", 100.0 * out.dropped);
  }
  out.recipe.text += fmt::format(" [{} {}]", scene.object.substr(scene.object.rfind('/') + 1),
                                 scene.measure.noise);
  return out;
}

/// In two gaps, and here and there.
void drop_frames(int seed, double share, std::vector<FrameInfo>& infos) {
  const double n = double(infos.size()), gap = 0.25 * share * n;
  const double first = dice_of(seed, 9) * n, second = dice_of(seed, 10) * n;
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const auto in_gap = [&](double begin) {
      const double away = double(i) - begin;
      return away >= 0.0 && away < gap;
    };
    if (in_gap(first) || in_gap(second) || dice_of(seed, 100 + i) < 0.5 * share)
      infos[i].status = FrameStatus::kDropped;
  }
}

/// Of the processor, on all cores.
double seconds(std::clock_t from, std::clock_t to) { return double(to - from) / CLOCKS_PER_SEC; }

/// T_truth_mesh: none, and as the first and the middle frame have it.
std::vector<Pose> starts(const FrameSequence& frames, const CalibrationChoice& choice,
                         const FrameSequence& at_true_poses) {
  std::vector<Pose> out{Pose::Identity()};
  const auto calibrated = with_choice(frames, choice);
  if (!calibrated) return out;
  const auto made = frame_poses((*calibrated)->header(), (*calibrated)->frames(), std::nullopt);
  if (!made) return out;
  for (const std::size_t i : {std::size_t(0), made->T_table_sensor.size() / 2})
    out.push_back(*at_true_poses.frames()[i].T_table_sensor * made->T_table_sensor[i].inverse());
  return out;
}

struct Tally {
  std::map<std::string, int> of;  ///< "true stated"
  int agreed = 0, judged = 0, bad_called_green = 0;
  std::vector<double> p68, p95;
};

void judge(int seed, const Scan& scan, Tally& tally) {
  const auto simulation = prepare_simulation(scan.recipe.scene, {});
  if (!simulation) return fmt::print("     not simulated: {}\n", simulation.error().text());
  const std::clock_t begin = std::clock();
  auto frames = rigs::rendered(simulation->scan);
  drop_frames(seed, scan.dropped, frames.infos);
  const std::clock_t simulated = std::clock();
  const auto run = run_reconstruction(frames, ReconstructRequest(), {});
  if (!run) return fmt::print("     refused: {}\n", run.error().text());
  const std::clock_t reconstructed = std::clock();
  const ObjectResult& object = run->reconstruction.objects.front();
  EvaluateOptions options;
  options.icp.max_iterations = 500;  // half a flat letter slides along its faces slowly
  options.samples = 40000;           // shares to within 0.3 %
  const VirtualScan& pass = simulation->scan.pass(0);
  const TriangleMesh& truth = pass.objects().front();
  const SequenceView posed = rigs::at_true_poses(frames, pass);
  // The alignment may stop in a wrong place: the best of several starts counts. The mesh is made
  // where its calibration is, which without a platter is anywhere; its first and middle frames tell
  // where that lies.
  const RunContext context;
  const SeenTest seen = seen_by(pass.scene(), posed, context);
  std::optional<Evaluation> result;
  for (const Pose& start : starts(frames, run->choice, posed)) {
    const TriangleMesh mesh = transformed(object.mesh, start);
    options.align = Align::kIcp;
    auto one = evaluate(mesh, truth, options, seen, {});
    options.align = Align::kNone;  // what is too far off to be aligned is judged as it lies
    if (!one) one = evaluate(mesh, truth, options, seen, {});
    if (!one) return fmt::print("     not judged: {}\n", one.error().text());
    one->T_reference_mesh = one->T_reference_mesh * start;
    if (!result || one->scores.at(1).f > result->scores.at(1).f) result = std::move(*one);
  }
  double base_m2 = 0.0;
  for (std::size_t t = 0; t < object.evidence.size(); ++t)
    if (object.evidence[t] == Evidence::kBase) base_m2 += triangle_area(object.mesh, t);
  const double f = result->scores.at(1).f;
  const double invented = std::max(0.0, result->invented_area_m2 - base_m2) / result->mesh_area_m2;
  const std::string truly = f >= 0.97 && invented < 0.10   ? "green"
                            : f < 0.85 || invented >= 0.25 ? "red"
                                                           : "amber";
  const std::string stated(object.verdict->colour());
  const auto r = ratios(object, truth, result->T_reference_mesh);
  ++tally.judged;
  tally.agreed += truly == stated ? 1 : 0;
  tally.bad_called_green += truly == "red" && stated == "green" ? 1 : 0;
  ++tally.of[truly + " called " + stated];
  tally.p68.push_back(quantile(r, 0.68));
  tally.p95.push_back(quantile(r, 0.95));
  fmt::print(
      "     {} (F {:.3f}, invented {:.0f} %), called {}; error over stated, 68 % {:.2f}, 95 % "
      "{:.2f}\n",
      truly, f, 100.0 * invented, stated, tally.p68.back(), tally.p95.back());
  fmt::print("     processor: {:.1f} s simulated, {:.1f} s reconstructed, {:.1f} s judged\n",
             seconds(begin, simulated), seconds(simulated, reconstructed),
             seconds(reconstructed, std::clock()));
  for (const VerdictSentence& s : object.verdict->sentences)
    if (s.topic == "agreement" || s.topic == "error") fmt::print("     {}\n", s.text);
  if (truly == stated) return;
  for (const VerdictSentence& s : object.verdict->sentences)
    fmt::print("       {:12} {:5} {}\n", s.topic, name_of(s.level), s.text);
}

/// A line of the table: one whole turn, of which the recording knows all.
void print_row(const char* object, const char* noise, int frames, double distance_m) {
  SceneDescription scene;
  scene.object = object;
  scene.object_placement.height_m = 0.18;
  scene.placement.distance_m = distance_m;
  scene.motion.frames = frames;
  scene.motion.turns = 1.0;
  scene.measure.noise = noise;
  scene.measure.mixed_pixels = std::string_view(noise).starts_with("gaussian") ? 0.5 : 0.0;
  const auto simulation = prepare_simulation(scene, {});
  if (!simulation) return fmt::print("{}: {}\n", object, simulation.error().text());
  ReconstructRequest request;
  request.calibration = "recorded";
  const auto run = run_reconstruction(rigs::rendered(simulation->scan), request, {});
  if (!run) return fmt::print("{}: {}\n", object, run.error().text());
  const ObjectResult& made = run->reconstruction.objects.front();
  const auto r = ratios(made, simulation->scan.pass(0).objects().front(), Pose::Identity());
  std::vector<double> expected_mm;
  for (const VertexQuality& q : made.quality) expected_mm.push_back(1e3 * q.expected_error_m);
  fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", object, noise, frames,
             quantile(expected_mm, 0.5), quantile(r, 0.68), quantile(r, 0.95));
  std::fflush(stdout);
}

void print_table(int most_frames, double distance_m) {
  fmt::print("| object | noise | frames | expected, median, mm | 68 % | 95 % |\n");
  for (const int frames : {36, 120, 400, 920}) {
    if (frames > most_frames) break;
    for (const char* object : {"builtin:letter-a", "builtin:scorpion", "builtin:doll"})
      for (const char* noise : {"gaussian:0.4mm", "gaussian:1.5mm", "model", "physics"})
        print_row(object, noise, frames, distance_m);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if ((argc == 3 || argc == 4) && std::string_view(argv[1]) == "--table") {
    print_table(std::stoi(argv[2]), argc == 4 ? std::stod(argv[3]) : 0.9);
    return 0;
  }
  if (argc < 2 || argc > 5) {
    fmt::print(stderr,
               "usage: expected_error MESHES [FIRST_SEED] [COUNT] [MOST_FRAMES]\n"
               "       expected_error --table MOST_FRAMES [METRES]\n");
    return 2;
  }
  const auto number = [&](int k, int fallback) { return argc > k ? std::stoi(argv[k]) : fallback; };
  const int first = number(2, 1), count = number(3, 200);
  Tally tally;
  for (int seed = first; seed < first + count; ++seed) {
    const Scan scan = vary(seed, argv[1], number(4, 920));
    fmt::print("{:4} {}\n", seed, scan.recipe.text);
    judge(seed, scan, tally);
    std::fflush(stdout);
  }
  fmt::print("verdicts: {} of {} agree, bad ones called green: {}\n", tally.agreed, tally.judged,
             tally.bad_called_green);
  for (const auto& [name, times] : tally.of) fmt::print("  {}: {}\n", name, times);
  fmt::print(
      "error over stated, median of the scans: 68 % {:.2f}, 95 % {:.2f}; 68 % within 0.7 to 1.4 "
      "in {} of {}\n",
      quantile(tally.p68, 0.5), quantile(tally.p95, 0.5),
      std::count_if(tally.p68.begin(), tally.p68.end(),
                    [](double p) { return p > 0.7 && p < 1.4; }),
      tally.judged);
}
