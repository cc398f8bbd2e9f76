#include <cmath>
#include <turnscan/recording/filled_depth.hpp>
#include <turnscan/recording/temporal_filter.hpp>
#include <turnscan/sensors/scanner_file.hpp>
#include <turnscan/workflow/device_notes.hpp>

namespace turnscan {

namespace {

constexpr double kTold = 0.7;

/// Baseline of the preset of this name; 0 if there is none, or if it does not triangulate. A model
/// name is never treated as a file name.
double baseline_of(const std::string& model) {
  if (model.empty() || model.ends_with(".toml") || model.find('/') != std::string::npos) return 0.0;
  const auto preset = find_scanner(model);
  if (!preset || preset->kind != ScannerKind::kMatrix) return 0.0;
  const bool triangulates =
      preset->sensing == Sensing::kStereo || preset->sensing == Sensing::kStructuredLight;
  return triangulates ? std::abs(preset->emitter_m.x()) : 0.0;  // the cameras are side by side
}

}  // namespace

Result<std::vector<std::string>> filled_depth_notes(const FrameSequence& sequence,
                                                    const RunContext& context) {
  std::vector<std::string> notes;
  for (std::uint32_t i = 0; i < sequence.header().sensors.size(); ++i) {
    const double baseline_m = baseline_of(sequence.header().sensors[i].model);
    if (!(baseline_m > 0.0)) continue;
    TURNSCAN_ASSIGN(const auto share, filled_share(sequence, i, baseline_m, context));
    if (!share || *share < kTold) continue;
    notes.push_back(
        fmt::format("sensor {} fills holes: {:.0f} % of what only one of its two cameras can see "
                    "has a depth; such depth is not measured, and hangs beside the object's edges, "
                    "so switch hole filling off in the program that records",
                    i, 100.0 * *share));
  }
  return notes;
}

Result<std::vector<std::string>> device_notes(const FrameSequence& sequence,
                                              const RunContext& context) {
  TURNSCAN_ASSIGN(std::optional<std::string> smoothed, temporal_filter_note(sequence, context));
  TURNSCAN_ASSIGN(std::vector<std::string> notes, filled_depth_notes(sequence, context));
  if (smoothed) notes.insert(notes.begin(), std::move(*smoothed));
  return notes;
}

}  // namespace turnscan
