#pragma once
// Start time of a recording and age of its calibration.

#include <optional>
#include <string>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::workflow {

/// Formatted as by utc_text(); empty: not known.
struct ScanDates {
  std::string started_at, calibrated_at;
};

/// The dates stored in a recording; empty for other sequences and for invalid dates.
ScanDates dates_of(const FrameSequence& sequence);

/// The same with the calibration of a file, as accepted by with_turntable(); an empty path: the
/// recording's. The date is empty if the file cannot be read.
ScanDates dates_of(const FrameSequence& sequence, const std::string& turntable_file);

/// "The calibration was made 3 months before this recording (2026-08-01)."; says so if a date is
/// not known.
std::string age_text(const ScanDates& dates);

/// Compares the platter with the sequence's turntable: `seen`, if that was found before and stands
/// as calibrated, else the one in up to 12 frames of the recording's first sensor. nullopt if there
/// is nothing to compare: no depth camera, no turntable, the platter is not visible or was cropped
/// away. Fails with kCancelled.
Result<std::optional<RigCheck>> platter_against_calibration(
    const FrameSequence& sequence, const std::optional<DetectedPlatter>& seen,
    const RunContext& context);

}  // namespace turnscan::workflow
