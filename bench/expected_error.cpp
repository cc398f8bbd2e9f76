// Whether the stated errors of vertices, and the verdicts, hold: random simulated scans, good and
// bad (random_rigs/recipe.hpp, and of a third of them only a part of a turn), reconstructed as the
// command does, judged by the truth. Usage: expected_error MESHES [FIRST_SEED] [COUNT]
// [MOST_FRAMES]

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <turnscan/core/random.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
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

struct Tally {
  std::map<std::string, int> of;  ///< "true stated"
  int agreed = 0, judged = 0, bad_called_green = 0;
  std::vector<double> p68, p95;
};

void judge(const rigs::Recipe& recipe, Tally& tally) {
  const auto simulation = prepare_simulation(recipe.scene, {});
  if (!simulation) return fmt::print("     cannot be simulated\n");
  const auto frames = rigs::rendered(simulation->scan);
  ReconstructRequest request;
  const auto run = run_reconstruction(frames, request, {});
  if (!run) return fmt::print("     refused: {}\n", run.error().text());
  const ObjectResult& object = run->reconstruction.objects.front();
  EvaluateOptions options;
  options.align = Align::kIcp;
  const VirtualScan& pass = simulation->scan.pass(0);
  const TriangleMesh& truth = pass.objects().front();
  const SequenceView posed = rigs::at_true_poses(frames, pass);
  const auto result = evaluate(object.mesh, truth, options, seen_by(pass.scene(), posed, {}), {});
  if (!result) return fmt::print("     not judged: {}\n", result.error().text());
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
  if (truly == stated) return;
  for (const VerdictSentence& s : object.verdict->sentences)
    fmt::print("       {:12} {:5} {}\n", s.topic, name_of(s.level), s.text);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 5) {
    fmt::print(stderr, "usage: expected_error MESHES [FIRST_SEED] [COUNT] [MOST_FRAMES]\n");
    return 2;
  }
  const auto number = [&](int k, int fallback) { return argc > k ? std::stoi(argv[k]) : fallback; };
  const int first = number(2, 1), count = number(3, 200);
  Tally tally;
  for (int seed = first; seed < first + count; ++seed) {
    rigs::Recipe recipe = rigs::make_recipe(std::uint64_t(seed), argv[1], number(4, 920));
    const std::uint64_t dice = hash_key(0x70617274, std::uint64_t(seed));
    if (dice % 3 == 0) {
      // A scan that broke off.
      const double share = 0.25 + 0.5 * double(dice >> 40) * 0x1.0p-24;
      recipe.scene.motion.turns *= share / std::abs(recipe.scene.motion.turns);
      recipe.text += fmt::format(", broken off after {:.2f} turns", share);
    }
    fmt::print("{:4} {}\n", seed, recipe.text);
    judge(recipe, tally);
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
