#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>

#include "bench/random_rigs/recipe.hpp"

namespace turnscan::rigs {

namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// As likely to lie between 1 and 2 as between 2 and 4.
  double ratio_between(double low, double high) {
    return low * std::exp(unit() * std::log(high / low));
  }
  bool chance(double share) { return unit() < share; }
  int below(int n) { return std::min(n - 1, int(unit() * n)); }

 private:
  double unit() { return double(hash_key(seed_, ++count_) >> 11) * 0x1.0p-53; }
  std::uint64_t seed_, count_ = 0;
};

std::vector<std::string> objects_in(const std::string& meshes) {
  std::vector<std::string> out{"builtin:letter-a", "builtin:doll"};
  for (const auto& entry : std::filesystem::directory_iterator(meshes))
    if (entry.is_regular_file() && entry.path().extension() != ".md")
      out.push_back(entry.path().string());
  std::sort(out.begin(), out.end());
  return out;
}

void add_trouble(Draw& draw, double seconds, Recipe& recipe) {
  SceneDescription& scene = recipe.scene;
  const double kind = draw.between(0.0, 1.0);
  const double when = seconds * draw.between(0.25, 0.75);
  if (kind < 0.2) {
    recipe.trouble = Trouble::kStaleTable;
    scene.record.calibration = RecordedCalibration::kNominal;
    const double way = draw.between(0.0, kTurn), shift = draw.between(0.003, 0.010);
    scene.table.x_m = shift * std::cos(way);
    scene.table.z_m = shift * std::sin(way);
    scene.table.tilt_rad = draw.between(0.5, 2.0) * kRadiansPerDegree;
    scene.table.tilt_direction_rad = draw.between(0.0, kTurn);
  } else if (kind < 0.25) {
    recipe.trouble = Trouble::kSlip;
    scene.motion.slip_at_s = when;
    scene.motion.slip_rad =
        (draw.chance(0.5) ? 1.0 : -1.0) * draw.between(3.0, 15.0) * kRadiansPerDegree;
  } else if (kind < 0.30) {
    recipe.trouble = Trouble::kHalt;
    scene.motion.halt_at_s = when;
    scene.motion.halt_s = 0.1 * seconds;
  } else if (kind < 0.35) {
    recipe.trouble = Trouble::kWobble;
    scene.motion.wobble_rad = draw.between(0.2, 1.0) * kRadiansPerDegree;
    scene.motion.wobble_cycles = 1 + draw.below(2);
  } else if (kind < 0.40) {
    recipe.trouble = Trouble::kObjectMoved;
    scene.object_move.at_s = when;
    scene.object_move.shift_m = draw.between(0.002, 0.010);
    scene.object_move.direction_rad = draw.between(0.0, kTurn);
    scene.object_move.turn_rad = draw.between(-10.0, 10.0) * kRadiansPerDegree;
  }
}

std::string_view name_of(Trouble trouble) {
  constexpr std::array names{"", ", stale table", ", slip", ", halt", ", wobble", ", object moved"};
  return names[std::size_t(trouble)];
}

}  // namespace

Recipe make_recipe(std::uint64_t seed, const std::string& meshes, int most_frames) {
  Draw draw(hash_key(0x72696773, seed));
  Recipe out;
  SceneDescription& scene = out.scene;
  const auto objects = objects_in(meshes);
  scene.object = objects[std::size_t(draw.below(int(objects.size())))];
  if (!scene.object.starts_with("builtin:")) {
    scene.unit = "mm";
    scene.object_placement.height_m = draw.between(0.12, 0.25);
  }
  scene.object_placement.yaw_rad = draw.between(0.0, kTurn);
  scene.object_placement.x_m = draw.between(-0.02, 0.02);
  scene.object_placement.z_m = draw.between(-0.02, 0.02);
  scene.placement.distance_m = draw.between(0.5, 1.5);
  scene.placement.elevation_rad = draw.between(5.0, 45.0) * kRadiansPerDegree;
  const double speed = draw.ratio_between(3.0, 40.0) * kRadiansPerDegree;
  const double turns = draw.between(0.75, 2.0);
  const int frames = int(draw.ratio_between(36.0, std::max(37.0, double(most_frames))));
  const double seconds = turns * kTurn / speed;
  scene.motion.frames = frames;
  scene.motion.fps = frames / seconds;
  scene.motion.turns = draw.chance(0.5) ? turns : -turns;
  scene.platter.visible = !draw.chance(1.0 / 3.0);
  scene.platter.radius_m = draw.between(0.12, 0.2);
  if (draw.chance(1.0 / 3.0)) scene.room.kind = RoomKind::kClutter;
  const bool physics = draw.chance(0.5);
  scene.measure.noise = physics ? "physics" : "gaussian:1.5mm";
  if (!physics) scene.measure.mixed_pixels = 0.5;
  scene.measure.seed = int(seed);
  scene.record.calibration = RecordedCalibration::kNone;
  scene.record.angles = false;
  add_trouble(draw, seconds, out);
  out.text =
      fmt::format("{} {:.2f} m {:.0f} deg {} frames {:+.2f} turns {:.1f} deg/s{}{} {}{}",
                  std::filesystem::path(scene.object).stem().string(), scene.placement.distance_m,
                  scene.placement.elevation_rad * kDegreesPerRadian, frames, scene.motion.turns,
                  speed * kDegreesPerRadian, scene.platter.visible ? "" : " no platter",
                  scene.room.kind == RoomKind::kNone ? "" : " room",
                  physics ? "physics" : "gaussian", name_of(out.trouble));
  return out;
}

}  // namespace turnscan::rigs
