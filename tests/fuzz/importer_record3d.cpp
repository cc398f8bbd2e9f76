// The input is a recording of Record3D. Every frame is read.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_record3d) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  folder.put("a.r3d", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kRecord3d;
  const auto sequence = open_foreign(folder / "a.r3d", options);
  if (!sequence) return 0;
  fuzz::check(**sequence);
  for (std::size_t i = 0; i < std::min<std::size_t>((*sequence)->frames().size(), 8); ++i)
    (void)(*sequence)->read(i);
  return 0;
}
