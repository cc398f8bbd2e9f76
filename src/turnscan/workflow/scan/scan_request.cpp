#include <filesystem>
#include <turnscan/recording/unfinished.hpp>

#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/scan/scan.hpp>

namespace turnscan {

OptionTable describe(AheadOptions& options) {
  OptionTable table;
  table.number("ahead", options.share, Quantity::kNone, {0.5, 0.98},
               "If the turntable is not known: share of the recording after which calibration from "
               "motion and reconstruction begin. auto: at its end");
  return table;
}

std::string recording_of(const ScanRequest& request) {
  if (!request.recording.empty()) return request.recording;
  const std::string& mesh = request.mesh;
  const std::string stem = mesh.substr(0, mesh.size() - ending_of(mesh).size());
  std::string name = stem + ".recording";
  std::error_code error;
  for (int i = 2; std::filesystem::exists(name, error); ++i) {
    if (request.overwrite_unfinished && is_unfinished_recording(name)) break;
    name = fmt::format("{}-{}.recording", stem, i);
  }
  return name;
}

}  // namespace turnscan
