#pragma once
// Random benches: what stands on a turntable, how it turns, how it is seen, and what is wrong.

#include <cstdint>
#include <string>
#include <turnscan/simulator/scene_file.hpp>

namespace turnscan::rigs {

/// What is not as the recording or a good bench has it.
enum class Trouble { kNone, kStaleTable, kSlip, kHalt, kWobble, kObjectMoved };

struct Recipe {
  SceneDescription scene;
  Trouble trouble = Trouble::kNone;
  std::string text;  ///< one line for people
};

/// The rig of a seed: 0.5 to 1.5 m away, 5 to 45 deg above, 3 to 40 deg/s either way, 0.75 to 2
/// turns, 36 to most_frames frames, Gaussian noise of 1.5 mm or the physics of a Kinect v2; a third
/// without a visible platter, a third with a wall, a desk and things on it, a fifth with a stale
/// calibration, a fifth with another trouble. meshes: a folder of objects beside the built-in ones.
Recipe make_recipe(std::uint64_t seed, const std::string& meshes, int most_frames);

}  // namespace turnscan::rigs
