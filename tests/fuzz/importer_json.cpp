// The input is the JSON file beside two depth images.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_json) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out =
      (folder.put_depth("depth_0.png"), folder.put_depth("depth_1.png"), true);
  (void)laid_out;
  folder.put("views.json", fuzz::text_of(data, size));
  ImportOptions options;
  options.depth_unit_m = 1e-3;
  fuzz::check_import(folder / "views.json", options);
  return 0;
}
