#include <turnscan/api/named_options.hpp>
#include <turnscan/api/recording.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/input.hpp>

namespace turnscan {

Result<OpenedFrames> open_frames(const std::filesystem::path& path, const Options& options) {
  ImportOptions import;
  TURNSCAN_TRY(api::set_fields(describe(import), options));
  TURNSCAN_TRY(import.check());
  TURNSCAN_ASSIGN(Input input, open_input(path, import));
  if (!input.imported && !options.empty())
    return fail_at(path.string(), ErrorCode::kInvalidOption,
                   "options of an import are for files of other programs, and this is a recording "
                   "already");
  OpenedFrames out;
  const auto* recording = dynamic_cast<const Recording*>(input.frames.get());
  out.complete = recording == nullptr || recording->complete();
  out.imported = input.imported;
  out.notes = std::move(input.notes);
  out.frames = std::move(input.frames);
  return out;
}

std::vector<OptionDescription> import_options() {
  ImportOptions import;
  return api::describe_fields(describe(import));
}

}  // namespace turnscan
