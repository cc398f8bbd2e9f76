// The input is camera-intrinsics.txt, a zero byte, and the pose of the only frame.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_frame_pose) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (folder.put_depth("frame-000001.depth.png"), true);
  (void)laid_out;
  const auto [camera, pose] = fuzz::split(fuzz::text_of(data, size));
  folder.put("camera-intrinsics.txt", camera);
  folder.put("frame-000001.pose.txt", pose);
  ImportOptions options;
  options.format = ImportFormat::kFramePose;
  options.depth_unit_m = 1e-3;
  fuzz::check_import(folder.path(), options);
  return 0;
}
