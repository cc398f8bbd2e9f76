// The input is calib_depth.yaml, calib_ir.yaml, calib_color.yaml and calib_pose.yaml, with a zero
// byte between them; the last ones may be missing.

#include <turnscan/io/import/iai_kinect2.hpp>

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(iai_kinect2) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  std::string_view rest = fuzz::text_of(data, size);
  for (const char* name :
       {"calib_depth.yaml", "calib_ir.yaml", "calib_color.yaml", "calib_pose.yaml"}) {
    const auto [file, behind] = fuzz::split(rest);
    if (file.empty())
      std::filesystem::remove(folder / name);
    else
      folder.put(name, file);
    rest = behind;
  }
  const auto read = read_iai_kinect2(folder.path());
  if (!read) return 0;
  fuzz::require(read->depth || read->camera, "a calibration");
  if (read->depth) fuzz::require(std::abs(read->depth->bias_m) <= 1.0, "bias");
  if (!read->camera) return 0;
  fuzz::require(bool(read->camera->intrinsics.check()), "camera");
  if (read->camera->color_intrinsics)
    fuzz::require(bool(read->camera->color_intrinsics->check()), "colour camera");
  fuzz::require(fuzz::finite(read->camera->T_color_sensor), "pose of the colour camera");
  return 0;
}
