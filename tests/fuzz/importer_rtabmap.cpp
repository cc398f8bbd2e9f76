// The input is the only frame's calibration, a zero byte, and the list of poses.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_rtabmap) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (std::filesystem::create_directory(folder / "a_depth"),
                                std::filesystem::create_directory(folder / "a_calib"),
                                folder.put_depth("a_depth/1.png"), true);
  (void)laid_out;
  const auto [camera, poses] = fuzz::split(fuzz::text_of(data, size));
  folder.put("a_calib/1.yaml", camera);
  folder.put("a_camera_poses.txt", poses);
  ImportOptions options;
  options.format = ImportFormat::kRtabmap;
  fuzz::check_import(folder.path(), options);
  return 0;
}
