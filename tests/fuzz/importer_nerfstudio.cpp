// The input is transforms.json.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_nerfstudio) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (folder.put_depth("1.png"), true);
  (void)laid_out;
  folder.put("transforms.json", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kNerfstudio;
  fuzz::check_import(folder.path(), options);
  return 0;
}
