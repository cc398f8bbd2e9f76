#pragma once
// What is to be known before a recording: where the platter is, and whether something stands on it.

#include <functional>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/turntable/detection/average.hpp>

namespace turnscan {

/// The mean of the next `frames` frames of a sensor, which are taken from the source: for
/// detect_platter() and check_rig(). Fails as FrameSource::next() and average_frames() do, and with
/// kMissingData when the source ends.
Result<AveragedScan> mean_of_next(FrameSource& source, std::uint32_t sensor, int frames,
                                  const RunContext& context);

/// Takes frames until something stands on the platter in five of them one after the other: returns
/// more than 10 mm above it, more than 40 mm within its rim, in at least 100 pixels. told: called
/// once when it has to wait. header: with the turntable and its radius. most_s: of the sensor's
/// time, that it waits; nullopt: as long as it takes.
/// Fails as FrameSource::next() does, and with kMissingData when the source ends and when nothing
/// stands there in time.
Result<> wait_for_object(FrameSource& source, const SequenceHeader& header,
                         std::optional<double> most_s, const std::function<void()>& told,
                         const RunContext& context);

}  // namespace turnscan
