// The input is a .sens recording. Its first frames are read.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_sens) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  folder.put("a.sens", fuzz::text_of(data, size));
  ImportOptions options;
  options.format = ImportFormat::kSens;
  const auto sequence = open_foreign(folder / "a.sens", options);
  if (!sequence) return 0;
  fuzz::check(**sequence);
  for (std::size_t i = 0; i < std::min<std::size_t>((*sequence)->frames().size(), 8); ++i)
    (void)(*sequence)->read(i);
  return 0;
}
