// What a disturbed recording costs: troubles made in the simulator, the reconstruction without and
// with what turnscan does about them, and what it said. Usage:
// disturbances LIST [CLEAN], LIST: a file with lines "OBJECT FRAMES TURNS DISTANCE NOISE SEED",
// NOISE as of `turnscan simulate`; CLEAN: only undisturbed recordings, without reconstructing them.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace {

using namespace turnscan;

struct Case {
  std::string object;
  int frames = 180;
  double turns = 1.1, distance_m = 0.8;
  std::string noise;
  int seed = 1;
};

struct Trouble {
  std::string name;
  std::function<void(SceneDescription&)> always = [](SceneDescription&) {};  ///< of the whole scan
  std::function<void(SceneDescription&)> later = {};  ///< of the frames from `at` on
  double at = 0.55, until = 1.0;                      ///< shares of the recording
  bool hand = false;                                  ///< between the two
  double speed_factor = 1.0;  ///< of what is stated with --speed; 1: nothing is
};

std::vector<Trouble> troubles() {
  const auto unrecorded = [](auto change) {
    return [change](SceneDescription& s) {
      s.record.angles = false;
      change(s);
    };
  };
  std::vector<Trouble> out{{.name = "none"}};
  out.push_back({.name = "object 6 mm",
                 .later = [](SceneDescription& s) { s.object_placement.x_m += 0.006; }});
  out.push_back({.name = "object turned", .later = [](SceneDescription& s) {
                   s.object_placement.yaw_rad += 5.0 * kRadiansPerDegree;
                   s.object_placement.z_m += 0.003;
                 }});
  out.push_back({.name = "sensor knocked", .later = [](SceneDescription& s) {
                   s.placement.azimuth_rad += 0.5 * kRadiansPerDegree;
                   s.placement.roll_rad += 0.4 * kRadiansPerDegree;
                   s.placement.distance_m += 0.003;
                 }});
  out.push_back({.name = "slip 12 deg", .always = unrecorded([](SceneDescription& s) {
                                          s.motion.slip_rad = 12.0 * kRadiansPerDegree;
                                          s.motion.slip_at_s =
                                              0.55 * *s.motion.frames / s.motion.fps;
                                        })});
  out.push_back({.name = "halt", .always = unrecorded([](SceneDescription& s) {
                                   s.motion.halt_s = 0.03 * *s.motion.frames / s.motion.fps;
                                   s.motion.halt_at_s = 0.4 * *s.motion.frames / s.motion.fps;
                                 })});
  out.push_back({.name = "wobble 0.5", .always = [](SceneDescription& s) {
                   s.motion.wobble_rad = 0.5 * kRadiansPerDegree;
                 }});
  out.push_back({.name = "wobble 2", .always = [](SceneDescription& s) {
                   s.motion.wobble_rad = 2.0 * kRadiansPerDegree;
                 }});
  out.push_back({.name = "speed 4 %", .speed_factor = 1.04});
  out.push_back({.name = "speed 20 %", .speed_factor = 1.2});
  out.push_back({.name = "hand", .at = 0.5, .until = 0.56, .hand = true});
  return out;
}

/// Depth of a hand and an arm, spheres in a row, where they are nearer than what was seen.
void reach_in(Frame& frame, const SensorInfo& sensor, const Vec3d& object, std::size_t position) {
  const CameraIntrinsics& camera = sensor.intrinsics;
  const RayTable rays(camera);
  constexpr double kRadius_m = 0.03;
  for (int k = 0; k <= 60; ++k) {
    const Vec3d c = object + Vec3d(0.01 + 0.006 * k, -0.02 - 0.004 * k, -0.05 - 0.001 * k);
    const Eigen::Vector2d at = camera.project(c);
    const double reach = 1.2 * camera.fx * kRadius_m / c.z();
    for (int y = std::max(0, int(at.y() - reach)); y <= at.y() + reach && y < camera.height; ++y) {
      for (int x = std::max(0, int(at.x() - reach)); x <= at.x() + reach && x < camera.width; ++x) {
        const auto pixel = std::size_t(y) * std::size_t(camera.width) + std::size_t(x);
        const Vec3d ray = Vec3d(rays.x()[pixel], rays.y()[pixel], 1.0).normalized();
        const double along = ray.dot(c), off = c.squaredNorm() - along * along;
        if (off > kRadius_m * kRadius_m) continue;
        const double t = along - std::sqrt(kRadius_m * kRadius_m - off);
        const double z = t * ray.z() + 0.0015 * standard_normal(hash_key(7, position, pixel));
        auto& value = frame.depth.pixels[pixel];
        const auto here = std::uint16_t(z / sensor.depth_unit_m);
        if (value == kNoReturn || value == kOutsideCrop || here < value) value = here;
      }
    }
  }
}

SceneDescription scene_of(const Case& c) {
  SceneDescription s;
  s.object = c.object;
  s.object_placement.height_m = 0.18;
  s.motion.frames = c.frames;
  s.motion.turns = c.turns;
  s.placement.distance_m = c.distance_m;
  s.placement.elevation_rad = (15.0 + 5.0 * (c.seed % 4)) * kRadiansPerDegree;
  s.measure.noise = c.noise;
  s.measure.seed = c.seed;
  return s;
}

struct Scores {
  double half = 0.0, one = 0.0, seconds = 0.0;
  std::string said;
};

Scores reconstruct_and_judge(const FrameSequence& frames, const TriangleMesh& truth,
                             const std::string& way, std::optional<double> speed) {
  Scores out;
  ReconstructRequest request;
  request.calibration = way;
  request.allow_open = true;
  request.options.merge.speed_rad_s = speed;
  const auto run = run_reconstruction(frames, request, {});
  if (!run) {
    out.said = "FAILED: " + run.error().text();
    return out;
  }
  out.said = run->choice.note;
  EvaluateOptions judge;
  judge.align = Align::kIcp;
  judge.samples = 40000;
  if (run->reconstruction.objects.empty()) return out;
  const auto scores = evaluate(run->reconstruction.objects[0].mesh, truth, judge, {}, {});
  if (!scores) {
    out.said += " NOT JUDGED: " + scores.error().text();
    return out;
  }
  out.half = scores->scores[0].f;
  out.one = scores->scores[1].f;
  return out;
}

/// The frames rendered once: they are read many times.
MemoryFrames rendered(const FrameSequence& frames) {
  std::vector<std::shared_ptr<const Frame>> out(frames.frames().size());
  parallel_for(out.size(), 1, [&](std::size_t i) {
    if (auto frame = frames.read(i)) out[i] = std::make_shared<const Frame>(std::move(*frame));
  });
  return MemoryFrames(frames.header(), std::move(out));
}

void try_trouble(const Case& c, const Trouble& trouble, bool clean) {
  SceneDescription before = scene_of(c), after = before;
  trouble.always(before);
  trouble.always(after);
  if (trouble.later) trouble.later(after);
  const auto first = prepare_simulation(before, {}), second = prepare_simulation(after, {});
  if (!first || !second) {
    fmt::print("{}: {}\n", c.object, (first ? second : first).error().text());
    return;
  }
  const FrameSequence& a = first->scan;
  const auto from = std::size_t(trouble.at * double(a.frames().size())),
             to = std::size_t(trouble.until * double(a.frames().size()));
  SequenceView disturbed(a);
  const SensorInfo sensor = a.header().sensors.front();
  const Vec3d object = a.header().turntable->center_m + 0.09 * a.header().turntable->axis;
  disturbed.set_map([&](Frame frame, std::size_t i) -> Result<Frame> {
    if (i < from || i >= to) return frame;
    if (trouble.hand) reach_in(frame, sensor, object, i);
    if (!trouble.later) return frame;
    TURNSCAN_ASSIGN(Frame other, second->scan.read(i));
    other.info = frame.info;
    return other;
  });
  const MemoryFrames frames = rendered(disturbed);
  std::optional<double> speed;
  if (trouble.speed_factor != 1.0)
    speed = trouble.speed_factor * *a.header().turntable->speed_rad_s;
  const TriangleMesh& truth = first->scan.pass(0).objects().front();
  const auto start = std::chrono::steady_clock::now();
  if (clean) {
    const auto choice = choose_calibration(frames, {"auto", speed, false}, {});
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print("{:62} {:5.2f} s: {}\n",
               fmt::format("{} {} {} {} {} {}", c.object, c.frames, c.turns, c.distance_m, c.noise,
                           c.seed),
               seconds, choice ? choice->note : choice.error().text());
    std::fflush(stdout);
    return;
  }
  const Scores without = reconstruct_and_judge(frames, truth, "recorded", speed);
  const Scores with = reconstruct_and_judge(frames, truth, "auto", speed);
  fmt::print("  {:15} F {:.3f} {:.3f} -> {:.3f} {:.3f}  {}\n", trouble.name, without.half,
             without.one, with.half, with.one, with.said);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::ifstream list(argv[1]);
  const bool clean = argc > 2 && std::string(argv[2]) == "CLEAN";
  const std::string only = argc > 2 && !clean ? argv[2] : "";
  for (std::string line; std::getline(list, line);) {
    Case c;
    std::istringstream words(line);
    if (!(words >> c.object >> c.frames >> c.turns >> c.distance_m >> c.noise >> c.seed)) continue;
    if (!clean) fmt::print("{}\n", line);
    for (const Trouble& trouble : troubles()) {
      if (clean && trouble.name != "none") break;
      if (only.empty() || trouble.name.starts_with(only)) try_trouble(c, trouble, clean);
    }
  }
}
