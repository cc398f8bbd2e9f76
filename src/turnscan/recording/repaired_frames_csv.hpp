#pragma once
// frames.csv of an unfinished recording, as text.

#include <string>
#include <string_view>
#include <turnscan/recording/frames_csv.hpp>

namespace turnscan::recording_format {

/// The table with the rows' whole lines, in their order, each byte of a line as it was; only the
/// status of a row differs where `row.info.status` says dropped and its line does not. rows: parsed
/// from this text, their status changed at will. A table without a status column gets one when it
/// is needed. Fails with kLibrary when the new text does not read back as the rows.
Result<std::string> repaired_frames_csv(std::string_view text, const std::vector<FrameRow>& rows,
                                        std::size_t sensor_count);

}  // namespace turnscan::recording_format
