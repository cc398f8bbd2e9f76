#pragma once

#include <turnscan/simulator/scene_file.hpp>

namespace turnscan::testing {

/// A cylinder before one depth camera without noise.
inline SceneDescription cylinder_scene(int frames) {
  SceneDescription scene;
  scene.object = "builtin:cylinder";
  scene.motion.frames = frames;
  scene.measure.noise = "none";
  return scene;
}

}  // namespace turnscan::testing
