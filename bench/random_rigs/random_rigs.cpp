// Calibration against the truth of random simulated benches (recipe.hpp): what is good, what is
// refused, what is silently wrong, and whether the stated deviations hold.
// Usage: random_rigs MESHES [FIRST_SEED] [COUNT] [MOST_FRAMES] [--mesh]
//   --mesh: also reconstruct, and compare with the same frames at their true poses

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "bench/random_rigs/frames.hpp"
#include "bench/random_rigs/recipe.hpp"

namespace {

using namespace turnscan;

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Errors of a calibration, and over their stated deviations (NaN: not stated).
struct Errors {
  double axis_deg = 0.0, line_mm = 0.0, height_mm = 0.0, angles_deg = 0.0, speed_percent = 0.0;
  double line_range_mm = 0.0;  ///< the part of line_mm along the line of sight, positive: farther
  double axis = 0.0, line = 0.0, height = 0.0, angles = 0.0, speed = 0.0;
};

/// Of the angles with a stated deviation. A turn that they share turns the finished object, and
/// changes nothing else.
void judge_angles(const Calibration& found, const VirtualScan& truth, Errors& out) {
  std::vector<double> errors, sigmas;
  double shared = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < found.angles_rad.size(); ++i) {
    const double sigma = found.angle_sigma_rad[i];
    if (!(sigma > 0.0)) continue;  // the first angle is what the others are counted from
    errors.push_back(found.angles_rad[i] - truth.angle_rad(i));
    sigmas.push_back(sigma);
    shared += errors.back() / (sigma * sigma), weights += 1.0 / (sigma * sigma);
  }
  double squares = 0.0, ratios = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double error = errors[i] - shared / weights;
    squares += error * error, ratios += std::pow(error / sigmas[i], 2);
  }
  out.angles_deg = std::sqrt(squares / double(errors.size())) * kDegreesPerRadian;
  out.angles = std::sqrt(ratios / double(errors.size()));
}

/// Of the motor: a slip or a halt takes few frames.
double usual_speed(const VirtualScan& truth) {
  std::vector<double> speeds;
  for (std::size_t i = 1; i < truth.frames().size(); ++i)
    speeds.push_back((truth.angle_rad(i) - truth.angle_rad(i - 1)) /
                     (truth.frames()[i].time_s - truth.frames()[i - 1].time_s));
  return median(speeds);
}

Errors judge(const Calibration& found, const VirtualScan& truth) {
  const TurntableInfo& table = truth.turntable();
  const Vec3d a = table.axis.normalized(), b = found.table.axis.normalized();
  const Vec3d middle = table.center_m + 0.08 * a;  // where the object is
  const Vec3d at = found.table.center_m + b * (a.dot(middle - found.table.center_m) / a.dot(b));
  Errors out;
  out.axis_deg = std::atan2(a.cross(b).norm(), a.dot(b)) * kDegreesPerRadian;
  out.line_mm = (at - middle).norm() * 1e3;
  out.line_range_mm = (at - middle).dot(middle.normalized()) * 1e3;
  out.height_mm = a.dot(found.table.center_m - table.center_m) * 1e3;
  out.axis = out.axis_deg / (found.axis_sigma_rad * kDegreesPerRadian);
  out.line = out.line_mm / (found.center_sigma_m * 1e3);
  out.height = std::abs(out.height_mm) / (found.height_sigma_m * 1e3);
  if (!found.angles_rad.empty()) judge_angles(found, truth, out);
  const double speed = usual_speed(truth);
  out.speed = std::nan("");
  if (found.table.speed_rad_s) {
    const double off = *found.table.speed_rad_s - speed;
    out.speed_percent = 100.0 * off / speed;
    out.speed = std::abs(off) / found.speed_sigma_rad_s;
  }
  return out;
}

/// F at 1 mm over the whole surface.
std::optional<double> f_of(const FrameSequence& frames, const TriangleMesh& object) {
  const auto run = reconstruct(frames, ReconstructOptions{}, {}, {});
  if (!run || run->objects.empty()) return std::nullopt;
  EvaluateOptions options;
  options.align = Align::kIcp;
  const auto result = evaluate(run->objects.front().mesh, object, options, {}, {});
  return result ? std::optional(result->scores.at(1).f) : std::nullopt;
}

struct Tally {
  int good = 0, poor = 0, wrong = 0, refused = 0;
  std::array<double, 5> squares{};
  std::array<int, 5> counts{};
  double processor_s = 0.0, longest_s = 0.0;

  void add(const Errors& e) {
    const std::array ratios{e.axis, e.line, e.height, e.angles, e.speed};
    for (std::size_t k = 0; k < ratios.size(); ++k)
      if (std::isfinite(ratios[k])) squares[k] += ratios[k] * ratios[k], ++counts[k];
  }
};

class Bench {
 public:
  Bench(std::string meshes, int most_frames, bool mesh)
      : meshes_(std::move(meshes)), most_frames_(most_frames), mesh_(mesh) {}

  void run(std::uint64_t seed) {
    const rigs::Recipe recipe = rigs::make_recipe(seed, meshes_, most_frames_);
    fmt::print("{:4} {}\n", seed, recipe.text);
    const auto simulation = prepare_simulation(recipe.scene, {});
    if (!simulation) {
      fmt::print("     cannot be simulated: {}\n", simulation.error().text());
      return;
    }
    const VirtualScan& truth = simulation->scan.pass(0);
    const auto frames = rigs::rendered(simulation->scan);  // so that only calibration is timed
    const double before = processor_seconds();
    const auto choice = choose_calibration(frames, {}, {});
    const double spent = processor_seconds() - before;
    tally_.processor_s += spent;
    tally_.longest_s = std::max(tally_.longest_s, spent);
    report(recipe, truth, frames, choice, simulation->placed, spent);
    std::fflush(stdout);
  }

  void summary() const {
    fmt::print("good {}, inaccurate and said so {}, WRONG {}, refused {}\n", tally_.good,
               tally_.poor, tally_.wrong, tally_.refused);
    constexpr std::array names{"axis", "line", "height", "angles", "speed"};
    for (std::size_t k = 0; k < names.size(); ++k)
      fmt::print("{}: errors over stated deviations, rms {:.2f} of {}\n", names[k],
                 std::sqrt(tally_.squares[k] / tally_.counts[k]), tally_.counts[k]);
    fmt::print("processor: {:.1f} s, longest {:.1f} s\n", tally_.processor_s, tally_.longest_s);
  }

 private:
  void report(const rigs::Recipe& recipe, const VirtualScan& truth, const FrameSequence& frames,
              const Result<CalibrationChoice>& choice, const std::vector<PlacedObject>& placed,
              double spent) {
    if (!choice) {
      ++tally_.refused;
      fmt::print("     REFUSED ({:.1f} s): {}\n", spent, choice.error().text());
      return;
    }
    if (!choice->note.empty()) fmt::print("     note: {}\n", choice->note);
    if (!choice->calibration) {
      ++tally_.wrong;
      fmt::print("     WRONG: the recording's calibration was kept ({:.1f} s)\n", spent);
      return;
    }
    const Calibration& found = *choice->calibration;
    const Errors e = judge(found, truth);
    tally_.add(e);
    print(e, found, spent);
    const bool physics = recipe.scene.measure.noise == "physics";
    const bool good = e.axis_deg < (physics ? 0.10 : 0.05) && e.line_mm < (physics ? 0.25 : 0.2);
    const bool honest = e.axis < 3.5 && e.line < 3.5;
    (good ? tally_.good : honest ? tally_.poor : tally_.wrong) += 1;
    if (!good) fmt::print("     {}\n", honest ? "inaccurate" : "WRONG");
    if (mesh_) compare_meshes(truth, frames, *choice, placed);
  }

  static void print(const Errors& e, const Calibration& found, double spent) {
    fmt::print(
        "     axis {:.3f} deg ({:.1f} s) line {:.3f} mm ({:.1f} s; {:+.3f} in range) height "
        "{:+.2f} "
        "mm ({:.1f} s) "
        "angles {:.3f} deg ({:.1f} s) speed {:+.3f} % ({:.1f} s); {:.1f} s of processor{}\n",
        e.axis_deg, e.axis, e.line_mm, e.line, e.line_range_mm, e.height_mm, e.height, e.angles_deg,
        e.angles, e.speed_percent, e.speed, spent,
        found.undetermined.empty()
            ? ""
            : fmt::format("; undetermined: {}", fmt::join(found.undetermined, ", ")));
  }

  void compare_meshes(const VirtualScan& truth, const FrameSequence& frames,
                      const CalibrationChoice& choice, const std::vector<PlacedObject>& placed) {
    const SequenceView true_poses = rigs::at_true_poses(frames, truth);
    const auto chosen = with_choice(frames, choice);
    if (!chosen || placed.empty()) return;
    const auto best = f_of(true_poses, placed.front().mesh);
    const auto ours = f_of(**chosen, placed.front().mesh);
    fmt::print("     F at 1 mm: {:.3f}, with true poses {:.3f}\n", ours.value_or(0.0),
               best.value_or(0.0));
  }

  std::string meshes_;
  int most_frames_;
  bool mesh_;
  Tally tally_;
};

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool mesh = std::erase(arguments, "--mesh") > 0;
  if (arguments.empty() || arguments.size() > 4) {
    fmt::print(stderr, "usage: random_rigs MESHES [FIRST_SEED] [COUNT] [MOST_FRAMES] [--mesh]\n");
    return 2;
  }
  const auto number = [&](std::size_t k, int fallback) {
    return arguments.size() > k ? std::stoi(arguments[k]) : fallback;
  };
  Bench bench(arguments[0], number(3, 920), mesh);
  const int first = number(1, 1), count = number(2, 100);
  for (int seed = first; seed < first + count; ++seed) bench.run(std::uint64_t(seed));
  bench.summary();
}
