// The input is the table of angles of a folder with one scan.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_angles) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (folder.put_scan("a.ply"), true);
  (void)laid_out;
  folder.put("angles.csv", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kCloudFolder;
  options.point_unit = LengthUnit::kMillimetre;
  fuzz::check_import(folder.path(), options);
  return 0;
}
