#pragma once
// Judges each object of a reconstruction, without a reference.

#include <turnscan/reconstruction/result.hpp>
#include <turnscan/recording/plausibility/plausibility.hpp>
#include <turnscan/workflow/calibration/calibration_age.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/next_pass/next_pass.hpp>
#include <turnscan/workflow/verdict/seen_surface.hpp>
#include <turnscan/workflow/verdict/turn_seen.hpp>

namespace turnscan {

/// Information on a scan besides its meshes.
struct ScanKnowledge {
  std::optional<TurnSeen> turn;               ///< of the pass that covers most
  const CalibrationChoice* choice = nullptr;  ///< must outlive the judging; of the first recording
  bool table_recorded = false;  ///< the recording already had a calibration; see choice
  std::vector<PlausibilityFinding> findings;          ///< of all recordings
  workflow::ScanDates dates;                          ///< of the first recording
  std::optional<RigCheck> platter;                    ///< see platter_against_calibration()
  std::vector<std::vector<FrameResidual>> residuals;  ///< per object; see frame_residuals()
  std::vector<SeenVertices> seen;                     ///< per object; see seen_vertices()
  std::optional<NextPassAdvice> next_pass;            ///< for the first object
};

/// Adds to residuals and seen the results for an object made from these frames. Fails as
/// frame_residuals() and seen_vertices().
Result<> compare_object(const ObjectResult& object, const std::vector<MeshFrames>& frames,
                        double noise_m, const RunContext& context, ScanKnowledge& known);

/// Gives every object its verdict, and adds the calibration's contribution to its expected errors.
///
/// green: the share of the visible surface that is expected within 1 mm of the truth is 0.96 or
/// more, and at most 0.10 of the surface was visible in hardly any frame (apart from the base on
/// the platter). red: less than 0.84, or more than 0.25; or the mesh is not closed although an open
/// one was not requested; or a disturbance of the recording was not corrected, or it holds what
/// cannot be. amber: else. Objects without expected errors (point-based methods) are amber at best.
/// docs/reference/report.md lists the sentences and how they were validated.
void judge_objects(Reconstruction& reconstruction, const ScanKnowledge& known);

}  // namespace turnscan
