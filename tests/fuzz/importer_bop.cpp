// The input is scene_camera.json, a zero byte, and scene_gt.json.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_bop) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (std::filesystem::create_directory(folder / "depth"),
                                folder.put_depth("depth/000001.png"), true);
  (void)laid_out;
  const auto [cameras, truth] = fuzz::split(fuzz::text_of(data, size));
  folder.put("scene_camera.json", cameras);
  folder.put("scene_gt.json", truth);
  ImportOptions options;
  options.format = ImportFormat::kBop;
  fuzz::check_import(folder.path(), options);
  return 0;
}
