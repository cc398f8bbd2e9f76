#pragma once
// Opens what a reconstruction reads.

#include <filesystem>
#include <memory>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/import/importers.hpp>
#include <vector>

namespace turnscan {

struct Input {
  std::unique_ptr<FrameSequence> frames;  ///< files are read when frames are read
  std::vector<std::string>
      notes;  ///< what is missing or out of order in a recording, a sentence each
};

/// path: a recording's folder or its recording.json (see Recording::open), or a data set of another
/// program (see open_foreign; options are for these alone). Fails as Recording::open() where there
/// is a recording, else as open_foreign().
Result<Input> open_input(const std::filesystem::path& path,
                         const ImportOptions& options = ImportOptions());

}  // namespace turnscan
