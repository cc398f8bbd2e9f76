#pragma once

#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::batch {

struct FoundRecording {
  std::string name;  ///< from its path below the folder
  std::string path;
};

/// The folder itself where it is a recording, else those below it, up to four folders deep, in the
/// order of their names; of a batch the recordings among its results, named after their tasks.
/// Recordings of other programs count where they are files (.bag, .mkv, .r3d, .sens), and the file
/// or folder itself where it is one; folders of other programs below it do not. Batches below the
/// folder and what lies in a recording are left out. Fails with kNotFound when there is none, or no
/// such folder, and with kIo.
Result<std::vector<FoundRecording>> find_recordings(const std::string& folder);

}  // namespace turnscan::batch
