// The input is intrinsic.json, then a zero byte and config.json, beside two depth images.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_open3d) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out =
      (std::filesystem::create_directory(folder / "depth"), folder.put_depth("depth/00000.png"),
       folder.put_depth("depth/00002.png"), true);
  (void)laid_out;
  const auto [intrinsic, config] = fuzz::split(fuzz::text_of(data, size));
  folder.put("intrinsic.json", intrinsic);
  folder.put("config.json", config.empty() ? "{}" : config);
  fuzz::check_import(folder.path(), {});
  return 0;
}
