// The input is a file of a recording, looked at without decoding it.

#include <turnscan/recording/file_check.hpp>

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(recording_file) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  folder.put("a.ply", fuzz::text_of(data, size));
  // What can be read must not be taken for truncated.
  const bool readable = bool(read_cloud(folder / "a.ply"));
  const std::string defect = turnscan::recording_format::check_file(folder / "a.ply").words;
  fuzz::require(!readable || defect.empty() || !fuzz::text_of(data, size).starts_with("ply"),
                "a readable file is whole");
  return 0;
}
