// The input is a Matroska recording.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_matroska) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  folder.put("take.mkv", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kMatroska;
  fuzz::check_import(folder / "take.mkv", options);
  options.intrinsics = "6,6,2,1";
  fuzz::check_import(folder / "take.mkv", options);
  return 0;
}
