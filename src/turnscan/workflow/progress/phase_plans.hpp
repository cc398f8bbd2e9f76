#pragma once
// Planned phases of runs. A recording may turn out to need additional ones (another calibration, a
// second look) or fewer.

#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/scan.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

/// Detection of the platter.
PhasePlan platter_phases();
/// Estimation of axis, speed and angles from the object's motion.
PhasePlan motion_phases();

/// reconstruct() with this many frames.
PhasePlan surface_phases(const ReconstructOptions& options, std::size_t frames);

/// run_reconstruction() and its outputs.
PhasePlan reconstruct_phases(const std::vector<NamedSequence>& recordings,
                             const ReconstructRequest& request);

/// simulate().
PhasePlan simulate_phases(const SimulateRequest& request);

/// Opening devices, and a recording of them.
PhasePlan capture_phases();

/// run_scan(), up to and including its first pass if the number of passes is not known.
PhasePlan scan_phases(const ScanRequest& request);

/// evaluate(); followed by seen_phases() if completeness is evaluated over the seen surface only.
PhasePlan evaluate_phases(const EvaluateOptions& options);
PhasePlan seen_phases();

/// The page of a reconstruction.
PhasePlan page_phases();

}  // namespace turnscan
