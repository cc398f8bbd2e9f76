#include <turnscan/workflow/input.hpp>

#include <turnscan/io/file/existence.hpp>
#include <turnscan/recording/plausibility/plausibility.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/device_notes.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordingFile = "recording.json";

/// The lines after the first, which states the origin of the data.
std::vector<std::string> assumptions_of(const std::string& source) {
  std::vector<std::string> lines;
  for (std::size_t end = source.find('\n'); end != std::string::npos;) {
    const std::size_t begin = end + 1;
    end = source.find('\n', begin);
    lines.push_back(source.substr(begin, end - begin));
  }
  return lines;
}

/// Size of a file, or of the regular files in a folder and below.
std::uint64_t bytes_of(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    const std::uintmax_t size = fs::file_size(path, error);
    return error ? 0 : size;
  }
  std::uint64_t sum = 0;
  fs::recursive_directory_iterator it(path, fs::directory_options::skip_permission_denied, error);
  for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    std::error_code gone;
    if (!it->is_regular_file(gone)) continue;
    const std::uintmax_t size = it->file_size(gone);
    if (!gone) sum += size;
  }
  return sum;
}

/// Whether an option that settles a finding was given.
bool states(const ImportOptions& options, std::string_view name) {
  return (name == "depth-unit" && options.depth_unit_m) ||
         (name == "point-unit" && options.point_unit != LengthUnit::kAuto) ||
         (name == "intrinsics" && !options.intrinsics.empty()) ||
         (name == "sensor-position" &&
          !(options.sensor_position.empty() && options.sensor_direction.empty()));
}

}  // namespace

Result<> check_assumptions(const FrameSequence& imported, const ImportOptions& options,
                           const RunContext& context) {
  TURNSCAN_ASSIGN(const auto findings, find_implausible(imported, context));
  for (const PlausibilityFinding& finding : findings)
    if (finding.level == Plausibility::kImplausible && !finding.option.empty() &&
        !states(options, finding.option))
      return fail(ErrorCode::kMissingData, "{}", finding.text);
  return {};
}

Result<Input> open_input(const fs::path& path, const ImportOptions& options,
                         const RunContext& context) {
  TURNSCAN_TRY(file::check_exists(path, "file or folder"));
  const bool named = path.filename() == kRecordingFile;
  TURNSCAN_ASSIGN(const bool recording_there, file::is_there(path / kRecordingFile));
  Input out;
  if (!named && !recording_there) {
    TURNSCAN_ASSIGN(out.frames, open_foreign(path, options, context));
    TURNSCAN_TRY(check_assumptions(*out.frames, options, context));
    out.imported = true;
    out.notes = assumptions_of(out.frames->header().source);
    out.bytes = bytes_of(path);
    return out;
  }
  const fs::path folder = !named ? path : path.has_parent_path() ? path.parent_path() : ".";
  TURNSCAN_ASSIGN(Recording recording, Recording::open(folder, context));
  out.notes = recording.notes();
  out.frames = std::make_unique<Recording>(std::move(recording));
  return out;
}

Result<ImportOptions> parse_import_options(const std::vector<std::string>& texts) {
  ImportOptions options;
  const OptionTable table = describe(options);
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const OptionField* field = table.find(name);
    const bool lone_flag = equals == std::string::npos && field != nullptr && field->is_flag;
    if (equals == std::string::npos && !lone_flag)
      return fail(ErrorCode::kInvalidOption,
                  "--import {}: write NAME=VALUE, an option of turnscan import without its dashes, "
                  "e.g. --import depth-unit=1mm",
                  text);
    if (auto set = table.set(name, lone_flag ? "true" : text.substr(equals + 1)); !set)
      return fail(ErrorCode::kInvalidOption, "--import: {}", set.error().message);
  }
  TURNSCAN_TRY(options.check());
  return options;
}

Result<Input> open_input_asking(const fs::path& path, const ImportOptions& options,
                                const RunContext& context) {
  auto input = open_input(path, options, context);
  if (input) return input;
  Error error = input.error();
  const bool asks = error.message.find("--") != std::string::npos;
  if (error.code == ErrorCode::kMissingData || (asks && error.code != ErrorCode::kUnsupported))
    error.message +=
        " (options of turnscan import are given here as --import NAME=VALUE, e.g. --import "
        "depth-unit=1mm)";
  return tl::unexpected<Error>(std::move(error));
}

Result<Input> open_input_asking(const fs::path& path,
                                const std::vector<std::string>& import_options,
                                const RunContext& context) {
  TURNSCAN_ASSIGN(const ImportOptions options, parse_import_options(import_options));
  TURNSCAN_ASSIGN(Input input, open_input_asking(path, options, context));
  if (!input.imported && !import_options.empty())
    return fail(ErrorCode::kInvalidOption, "--import: {} is a recording already; leave it out",
                path.string());
  return input;
}

Result<Input> keep_input(const fs::path& path, const Input& input, const fs::path& folder,
                         const RunContext& context) {
  if (!input.imported)
    return fail_at(path.string(), ErrorCode::kInvalidOption,
                   "this is a recording already; leave --keep-recording out");
  TURNSCAN_TRY(write_recording(folder, *input.frames, context));
  return open_input(folder, {}, context);
}

Result<SequenceSummary> summarize(const Input& input, const RunContext& context) {
  TURNSCAN_ASSIGN(SequenceSummary summary, summarize(*input.frames, context));
  TURNSCAN_ASSIGN(const auto filled, filled_depth_notes(*input.frames, context));
  summary.notes.insert(summary.notes.end(), filled.begin(), filled.end());
  if (input.imported)
    summary.bytes = input.bytes;  // the summary already contains the assumptions
  else
    summary.notes.insert(summary.notes.end(), input.notes.begin(), input.notes.end());
  return summary;
}

}  // namespace turnscan
