// The input is a .conf file beside one scan.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_conf) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const bool laid_out = (folder.put_scan("a.ply"), true);
  (void)laid_out;
  folder.put("a.conf", fuzz::text_of(data, size));
  fuzz::check_import(folder / "a.conf", ImportOptions{});
  return 0;
}
