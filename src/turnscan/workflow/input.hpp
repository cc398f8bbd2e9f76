#pragma once
// Opens what a reconstruction reads.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/import/importers.hpp>
#include <turnscan/recording/summary.hpp>
#include <vector>

namespace turnscan {

struct Input {
  std::unique_ptr<FrameSequence> frames;  ///< files are read when frames are read
  /// What is missing or out of order in a recording, or was assumed of a data set of another
  /// program, a sentence each.
  std::vector<std::string> notes;
  bool imported = false;    ///< of another program
  std::uint64_t bytes = 0;  ///< of the files of another program
};

/// path: a recording's folder or its recording.json (see Recording::open), or a data set of another
/// program (see open_foreign; options are for these alone). Fails as Recording::open() where there
/// is a recording, else as open_foreign().
Result<Input> open_input(const std::filesystem::path& path,
                         const ImportOptions& options = ImportOptions());

/// Options of an import as NAME=VALUE, the names and values of `turnscan import`. Fails with
/// kInvalidOption.
Result<ImportOptions> parse_import_options(const std::vector<std::string>& texts);

/// As open_input(). Where the data set of another program needs an option, the error says that it
/// is given as `--import NAME=VALUE`.
Result<Input> open_input_asking(const std::filesystem::path& path, const ImportOptions& options);

inline constexpr const char* kImportOptionsHelp =
    "Option of turnscan import, without its dashes, for files of another program, e.g. "
    "depth-unit=1mm; may be given for several";

/// As open_input_asking(), with options as parse_import_options() reads them. Fails as these do,
/// and with kInvalidOption where there are options and path is a recording.
Result<Input> open_input_asking(const std::filesystem::path& path,
                                const std::vector<std::string>& import_options);

/// Writes what was imported to a recording's folder, and goes on with that. Fails with
/// kInvalidOption for a recording, as write_recording() and as open_input().
Result<Input> keep_input(const std::filesystem::path& path, const Input& input,
                         const std::filesystem::path& folder, const RunContext& context);

/// What `turnscan info` says about it. Fails only with kCancelled.
Result<SequenceSummary> summarize(const Input& input, const RunContext& context);

}  // namespace turnscan
