#pragma once
// Opens recordings of turnscan and data sets of other programs as a sequence of frames.
// recording/recording.hpp writes recordings.

#include <filesystem>
#include <memory>
#include <string>
#include <turnscan/api/options.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

struct OpenedFrames {
  std::unique_ptr<FrameSequence> frames;  ///< images are read from disk when a frame is read
  /// What is missing or out of order in a recording, or what was assumed about a data set of
  /// another program: one sentence each.
  std::vector<std::string> notes;
  bool imported = false;  ///< a data set of another program
  bool complete = true;   ///< false: a recording whose writer was interrupted
};

/// Opens the folder of a recording, its recording.json, or a file or folder of another program
/// (docs/reference/importing.md lists the layouts). The options are those of `turnscan import`, and
/// apply to data of other programs only.
///
/// Fails with kNotFound (nothing has that path), kFormat (damaged), kUnsupported (unknown layout or
/// newer version), kMissingData (an option is needed; the message names it), kInvalidOption (also
/// for options together with a recording) and kIo.
Result<OpenedFrames> open_frames(const std::filesystem::path& path, const Options& options = {});

/// The options of open_frames().
std::vector<OptionDescription> import_options();

}  // namespace turnscan
