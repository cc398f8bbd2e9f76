#pragma once

#include <turnscan/core/sequence_views.hpp>
#include <turnscan/workflow/calibration/calibrate_run.hpp>

namespace turnscan::workflow {

/// The sequence, which must outlive the result, with other cameras and depth. Fails as
/// correct_sensors().
Result<SequenceView> corrected_sequence(const FrameSequence& sequence,
                                        const Calibration& correction);

/// Cameras and depth of the sensors as the request has them found; the rest of the calibration says
/// nothing. Fails as run_calibration().
Result<Calibration> sensor_correction(const FrameSequence& sequence,
                                      const CalibrateRequest& request, const RunContext& context);

/// Puts the correction's cameras and depth into a calibration of the corrected sequence. What has
/// no place there, of sensors that it does not know, becomes a note.
void keep_corrections(const Calibration& correction, Calibration& found);

/// The mean of frames of one sensor, spread over the sequence.
Result<AveragedScan> average_sensor(const FrameSequence& sequence, std::uint32_t sensor,
                                    const AverageOptions& options, const RunContext& context);

}  // namespace turnscan::workflow
