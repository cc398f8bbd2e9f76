#pragma once
// Opens the input of a reconstruction.

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
  /// What is missing or inconsistent in a recording, or was assumed for a data set of another
  /// program; one sentence each.
  std::vector<std::string> notes;
  bool imported = false;    ///< from another program
  std::uint64_t bytes = 0;  ///< size of the other program's files
};

/// path: a recording's folder or its recording.json (see Recording::open), or a data set of another
/// program (see open_foreign; the options apply to these only). Fails as Recording::open() if there
/// is a recording, else as open_foreign() and check_assumptions().
Result<Input> open_input(const std::filesystem::path& path,
                         const ImportOptions& options = ImportOptions(),
                         const RunContext& context = RunContext());

/// Fails with kMissingData if what is recorded cannot be (see find_implausible()) for an assumption
/// that an option which was not given would replace; with kCancelled.
Result<> check_assumptions(const FrameSequence& imported, const ImportOptions& options,
                           const RunContext& context = {});

/// Parses import options given as NAME=VALUE, with names and values of `turnscan import`. Fails
/// with kInvalidOption.
Result<ImportOptions> parse_import_options(const std::vector<std::string>& texts);

/// As open_input(). If another program's data set needs an option, the error explains that it is
/// given as `--import NAME=VALUE`.
Result<Input> open_input_asking(const std::filesystem::path& path, const ImportOptions& options,
                                const RunContext& context);

inline constexpr const char* kImportOptionsHelp =
    "Option of turnscan import, without its dashes, for files of another program, e.g. "
    "depth-unit=1mm; may be given for several";

/// As open_input_asking(), with options parsed by parse_import_options(). Fails as these do, and
/// with kInvalidOption if options are given and path is a recording.
Result<Input> open_input_asking(const std::filesystem::path& path,
                                const std::vector<std::string>& import_options,
                                const RunContext& context = RunContext());

/// Writes imported data to a recording's folder, and opens that. Fails with kInvalidOption for a
/// recording, as write_recording() and as open_input().
Result<Input> keep_input(const std::filesystem::path& path, const Input& input,
                         const std::filesystem::path& folder, const RunContext& context);

/// The summary that `turnscan info` shows. Fails only with kCancelled.
Result<SequenceSummary> summarize(const Input& input, const RunContext& context);

}  // namespace turnscan
