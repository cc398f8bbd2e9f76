#pragma once

#include <turnscan/core/sequence_views.hpp>
#include <turnscan/workflow/calibration/calibrate_run.hpp>

namespace turnscan::workflow {

/// The sequence, which must outlive the result, with corrected cameras and depth. Fails as
/// correct_sensors().
Result<SequenceView> corrected_sequence(const FrameSequence& sequence,
                                        const Calibration& correction);

/// Estimates cameras and depth of the sensors as requested; the other fields of the calibration are
/// meaningless. Fails as run_calibration().
Result<Calibration> sensor_correction(const FrameSequence& sequence,
                                      const CalibrateRequest& request, const RunContext& context);

/// Stores the correction's cameras and depth in a calibration of the corrected sequence.
/// Corrections of sensors that it does not contain become a note.
void keep_corrections(const Calibration& correction, Calibration& found);

/// Averages frames of one sensor, spread over the sequence.
Result<AveragedScan> average_sensor(const FrameSequence& sequence, std::uint32_t sensor,
                                    const AverageOptions& options, const RunContext& context);

}  // namespace turnscan::workflow
