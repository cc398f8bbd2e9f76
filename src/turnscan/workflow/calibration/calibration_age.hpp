#pragma once
// When a recording began, and how old the calibration is that it was made with.

#include <optional>
#include <string>
#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::workflow {

/// As utc_text(); empty: not known.
struct ScanDates {
  std::string started_at, calibrated_at;
};

/// What a recording says of itself; nothing is known of other sequences, and of dates that are
/// none.
ScanDates dates_of(const FrameSequence& sequence);

/// The same where the calibration is that of a file, as with_turntable() takes it; an empty path:
/// the recording's. What cannot be read has no date.
ScanDates dates_of(const FrameSequence& sequence, const std::string& turntable_file);

/// "made 3 months before this recording (2026-08-01)"; says what is not known.
std::string age_text(const ScanDates& dates);

/// The platter as this very recording shows it, in up to 12 frames of its first sensor, against the
/// sequence's turntable. nullopt where there is nothing to compare: no depth camera, no turntable,
/// the platter is not seen, it was cropped away. Fails with kCancelled.
Result<std::optional<RigCheck>> platter_against_calibration(const FrameSequence& sequence,
                                                            const RunContext& context);

}  // namespace turnscan::workflow
