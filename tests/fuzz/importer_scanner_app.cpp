// The input is the description of the only frame of 3D Scanner App's export.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_scanner_app) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (folder.put_depth("depth_00000.png"), true);
  (void)laid_out;
  folder.put("frame_00000.json", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kScannerApp;
  fuzz::check_import(folder.path(), options);
  return 0;
}
