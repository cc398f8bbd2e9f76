// The input is a recording of Logger2. Its first frames are read.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_klg) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  folder.put("a.klg", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kKlg;
  options.intrinsics = "528,528,320,240";
  const auto sequence = open_foreign(folder / "a.klg", options);
  if (!sequence) return 0;
  fuzz::check(**sequence);
  for (std::size_t i = 0; i < std::min<std::size_t>((*sequence)->frames().size(), 8); ++i)
    (void)(*sequence)->read(i);
  return 0;
}
