// The input is a scene in TOML; what is read is written and read again to the same bytes.

#include <turnscan/simulator/scene_file.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(scene_toml) {
  using namespace turnscan;
  SceneDescription scene;
  if (!parse_scene(fuzz::text_of(data, size), "scene.toml", scene)) return 0;
  const std::string text = scene_toml(scene);
  SceneDescription again;
  if (!parse_scene(text, "scene.toml", again)) {
    // A name may hold more than the reader takes on one line.
    fuzz::require(text.size() > 4096, "written and read again");
    return 0;
  }
  SceneDescription third;
  fuzz::require(bool(parse_scene(scene_toml(again), "scene.toml", third)) &&
                    scene_toml(third) == scene_toml(again),
                "the same bytes");
  return 0;
}
