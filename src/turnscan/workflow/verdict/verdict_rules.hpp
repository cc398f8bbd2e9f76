#pragma once
// A verdict on each object of a reconstruction, without a reference.

#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/verdict/turn_seen.hpp>

namespace turnscan {

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
/// more, and less than 0.14 of the surface was invented (the base on the platter apart). red: less
/// than 0.85, or more than 0.29 invented; or the mesh is not closed without having been asked for;
/// or what disturbed the recording was not corrected. amber: else. Objects without expected errors
/// (methods from points) are amber at best. docs/report.md has the sentences and how they were
/// judged.
void judge_objects(Reconstruction& reconstruction, const ScanKnowledge& known);

}  // namespace turnscan
