#pragma once
// A verdict on each object of a reconstruction, without a reference.

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>

namespace turnscan {

/// From which sides the frames look at the table.
struct TurnSeen {
  double share = 0.0;  ///< of a full turn, 0 to 1: headings less than 20 degrees from a frame's
  double turns = 0.0;  ///< by which the table turned in all
};
/// Of the frames that were not dropped; nullopt where nothing says where they were.
std::optional<TurnSeen> turn_seen(const FrameSequence& frames, std::optional<double> speed_rad_s);

/// 1 for each vertex all of whose triangles were measured, as far as the evidence is known.
std::vector<std::uint8_t> measured_vertices(const ObjectResult& object);

/// What is known of a scan besides its meshes.
struct ScanKnowledge {
  std::optional<TurnSeen> turn;  ///< of the pass that shows most
  const CalibrationChoice* choice = nullptr;
};

/// Gives every object its verdict, and its expected errors the part of the calibration.
///
/// green: the share of the measured surface that is expected within 1 mm of the truth is 0.97 or
/// more, and less than a tenth of the surface was invented (the base on the platter apart). red:
/// less than 0.85, or a quarter; or the mesh is not closed without having been asked for; or what
/// disturbed the recording was not corrected. amber: else. Objects without expected errors (methods
/// from points) are amber at best. docs/report.md has the sentences and how they were judged.
void judge_objects(Reconstruction& reconstruction, const ScanKnowledge& known);

}  // namespace turnscan
