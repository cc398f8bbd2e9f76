#pragma once

#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::batch {

struct FoundRecording {
  std::string name;  ///< from its path relative to the folder
  std::string path;
};

/// The folder itself if it is a recording; else the recordings below it, up to four levels deep,
/// sorted by name; for a batch, the recordings among its results, named after their tasks.
/// Recordings of other programs count if they are files (.bag, .mkv, .r3d, .sens, .mcap, ...),
/// folders of rosbag2 or the given path itself; other programs' recording folders below it do not
/// count. Batches below the folder and the contents of a recording are skipped. Fails with
/// kNotFound if there is no recording or no such folder, and with kIo.
Result<std::vector<FoundRecording>> find_recordings(const std::string& folder);

}  // namespace turnscan::batch
