#pragma once
// The phases that runs come to. What a recording turns out to need (another calibration, a second
// look) may add some, and leave some out.

#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/scan/scan.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

namespace turnscan {

/// Where the platter is found.
PhasePlan platter_phases();
/// Where axis, speed and angles are found from the object's motion.
PhasePlan motion_phases();

/// Of reconstruct() with so many frames.
PhasePlan surface_phases(const ReconstructOptions& options, std::size_t frames);

/// Of run_reconstruction() and what is written of it.
PhasePlan reconstruct_phases(const std::vector<NamedSequence>& recordings,
                             const ReconstructRequest& request);

/// Of simulate().
PhasePlan simulate_phases(const SimulateRequest& request);

/// Of run_scan(), up to and with its first pass where nobody knows how many there will be.
PhasePlan scan_phases(const ScanRequest& request);

/// Of evaluate(); seen_phases() come behind them where completeness is judged over what was seen.
PhasePlan evaluate_phases(const EvaluateOptions& options);
PhasePlan seen_phases();

/// Of a reconstruction's page.
PhasePlan page_phases();

}  // namespace turnscan
