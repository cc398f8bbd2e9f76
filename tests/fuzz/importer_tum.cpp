// The input is depth.txt (which is rgb.txt too), a zero byte, and groundtruth.txt.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_tum) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (folder.put_depth("d.png"), true);
  (void)laid_out;
  const auto [list, poses] = fuzz::split(fuzz::text_of(data, size));
  folder.put("depth.txt", list);
  folder.put("rgb.txt", list);
  folder.put("groundtruth.txt", poses);
  ImportOptions options;
  options.format = ImportFormat::kTumRgbd;
  options.intrinsics = "525,525,2,1";
  fuzz::check_import(folder.path(), options);
  return 0;
}
