#pragma once
// Summary of a recording, as printed by `turnscan info`.

#include <string>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/recording/plausibility/plausibility.hpp>
#include <turnscan/recording/recording.hpp>
#include <vector>

namespace turnscan {

struct ValueSpan {
  double min = 0.0;
  double max = 0.0;
};

struct SensorSummary {
  SensorInfo info;
  std::size_t frames = 0;            ///< number not dropped
  std::size_t sampled = 0;           ///< frames decoded for the values below
  std::size_t colored = 0;           ///< of the sampled frames
  std::optional<ValueSpan> depth_m;  ///< distance along z of the returns in the sampled frames
  double valid_share = 0.0;  ///< returns per pixel or grid cell; 1 for points without a grid
  std::size_t points_per_frame = 0;  ///< mean over the sampled frames
};

struct SequenceSummary {
  std::string software;
  std::string source;  ///< first line of SequenceHeader::source
  std::size_t frames = 0;
  std::size_t dropped = 0;
  std::size_t passes = 0;
  std::size_t with_time = 0;  ///< frames without the dropped ones; also below
  std::size_t with_angle = 0;
  std::size_t with_pose = 0;
  std::optional<ValueSpan> time_s;
  std::optional<ValueSpan> angle_rad;
  std::optional<double> turns;  ///< from the angles, else from speed and times
  std::optional<TurntableInfo> turntable;
  std::optional<std::uint64_t> bytes;  ///< of files of another program that are not imported yet
  std::vector<SensorSummary> sensors;
  std::vector<std::string> notes;  ///< assumptions of the import, defects found on opening
  /// What would determine the poses of frames on the table; reconstruction estimates it from the
  /// object's motion.
  std::vector<std::string> not_known;
  std::vector<std::string> missing;           ///< what is necessary for reconstruction
  std::vector<PlausibilityFinding> findings;  ///< see find_implausible()
};

/// Decodes at most 16 frames of each sensor, evenly spread, and those of find_implausible(). A
/// frame that cannot be read becomes a note. Fails only with kCancelled.
Result<SequenceSummary> summarize(const FrameSequence& sequence, const RunContext& context);
/// As above, with the recording's own notes.
Result<SequenceSummary> summarize(const Recording& recording, const RunContext& context);

/// Several lines for display, values with their units.
std::string summary_text(const SequenceSummary& summary);
/// One JSON object without a line end, SI units in the field names.
std::string summary_json(const SequenceSummary& summary);

}  // namespace turnscan
