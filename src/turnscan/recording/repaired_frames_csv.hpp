#pragma once
// Repairs the text of an unfinished recording's frames.csv.

#include <string>
#include <string_view>
#include <turnscan/recording/frames_csv.hpp>

namespace turnscan::recording_format {

/// The table with the complete lines of the rows, in their order and byte by byte; only the status
/// of a row differs if `row.info.status` is dropped and that of its line is not. rows: parsed from
/// this text, with changed statuses. A table without a status column gets one if necessary. Fails
/// with kLibrary if the new text does not parse to the same rows, and with kCancelled.
Result<std::string> repaired_frames_csv(std::string_view text, const std::vector<FrameRow>& rows,
                                        std::size_t sensor_count,
                                        const RunContext& context = RunContext());

}  // namespace turnscan::recording_format
