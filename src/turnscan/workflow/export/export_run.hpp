#pragma once
// Writes a recording's images with the poses of their cameras about the object, for other programs.

#include <filesystem>
#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/export/posed_images.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <vector>

namespace turnscan {

struct ExportOptions {
  std::optional<double> depth_unit_m;  ///< nullopt: the layout's, or else the recording's
  std::optional<double> speed_rad_s;   ///< see MergeOptions
  std::optional<int> pass;             ///< only the frames of this pass
  int every = 1;                       ///< only each n-th of these

  Result<> check() const;
};
OptionTable describe(ExportOptions& options);

struct ExportRequest {
  ExportFormat format = ExportFormat::kColmap;
  ExportOptions options;
  std::string calibration = "auto";  ///< CalibrationRequest::mode
  std::string turntable;             ///< see with_turntable(); empty: the recording's
  std::string mesh;  ///< in the table's frame; for masks and initial points; empty: none
};

struct ExportSummary {
  std::size_t color_images = 0, depth_images = 0, masks = 0;
  std::vector<std::string> notes;
};

/// The layout of this name. Fails with kInvalidOption, naming those that there are.
Result<ExportFormat> export_format(const std::string& name);

/// Writes to a folder that does not exist or is empty; on a failure nothing is left in it. Fails as
/// check_output_folder(), place_recording(), frame_poses(), read_mesh(), write_descriptions() and
/// the frames do; with kMissingData if passes would have to be joined, if there are no frames or
/// the mesh is in none of the images; with kUnsupported for scans of points; with kCancelled.
Result<ExportSummary> export_recording(const FrameSequence& recording, const ExportRequest& request,
                                       const std::filesystem::path& folder,
                                       const RunContext& context);

PhasePlan export_phases(const FrameSequence& recording);

}  // namespace turnscan
