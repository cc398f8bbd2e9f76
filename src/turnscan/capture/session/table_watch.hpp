#pragma once
// Checks before a recording: where the platter is, and whether an object is on it.

#include <functional>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/turntable/detection/average.hpp>

namespace turnscan {

/// The mean of the next `frames` frames of a sensor, which are consumed from the source, for
/// detect_platter() and check_rig(). Fails as FrameSource::next() and average_frames() do, and with
/// kMissingData if the source ends.
Result<AveragedScan> mean_of_next(FrameSource& source, std::uint32_t sensor, int frames,
                                  const RunContext& context);

/// Consumes frames until an object is on the platter in five consecutive ones: returns more than 10
/// mm above it, more than 40 mm inside its rim, in at least 100 pixels. told: called once if it has
/// to wait. header: with the turntable and its radius. most_s: maximum wait in sensor time;
/// nullopt: unlimited.
/// Fails as FrameSource::next() does, and with kMissingData if the source ends or no object appears
/// in time.
Result<> wait_for_object(FrameSource& source, const SequenceHeader& header,
                         std::optional<double> most_s, const std::function<void()>& told,
                         const RunContext& context);

}  // namespace turnscan
