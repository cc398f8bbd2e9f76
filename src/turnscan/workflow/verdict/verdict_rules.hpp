#pragma once
// A verdict on each object of a reconstruction, without a reference.

#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/calibration/calibration_age.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>
#include <turnscan/workflow/verdict/seen_surface.hpp>
#include <turnscan/workflow/verdict/turn_seen.hpp>

namespace turnscan {

/// What is known of a scan besides its meshes.
struct ScanKnowledge {
  std::optional<TurnSeen> turn;               ///< of the pass that shows most
  const CalibrationChoice* choice = nullptr;  ///< outlives the judging; of the first recording
  bool table_recorded = false;                ///< a calibration was there before; see choice
  workflow::ScanDates dates;                  ///< of the first recording
  std::optional<RigCheck> platter;            ///< see platter_against_calibration()
  std::vector<std::vector<FrameResidual>> residuals;  ///< per object; see frame_residuals()
  std::vector<SeenVertices> seen;                     ///< per object; see seen_vertices()
  std::optional<NextPassAdvice> next_pass;            ///< for the first object
};

/// Adds to residuals and seen what holds for an object that these frames made. Fails as
/// frame_residuals() and seen_vertices().
Result<> compare_object(const ObjectResult& object, const std::vector<MeshFrames>& frames,
                        double noise_m, const RunContext& context, ScanKnowledge& known);

/// Gives every object its verdict, and its expected errors the part of the calibration.
///
/// green: the share of the surface that frames could see which is expected within 1 mm of the truth
/// is 0.96 or more, and hardly a frame could see at most 0.10 of the surface (the base on the
/// platter apart). red: less than 0.84, or more than 0.25; or the mesh is not closed without having
/// been asked for; or what disturbed the recording was not corrected. amber: else. Objects without
/// expected errors (methods from points) are amber at best. docs/report.md has the sentences and
/// how they were judged.
void judge_objects(Reconstruction& reconstruction, const ScanKnowledge& known);

}  // namespace turnscan
