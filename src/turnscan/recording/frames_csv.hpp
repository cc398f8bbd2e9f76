#pragma once
// frames.csv as text.

#include <cstdint>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::recording_format {

inline constexpr std::uint64_t kMaxTableBytes = std::uint64_t(256) << 20;

struct FrameRow {
  FrameInfo info;
  std::string color_file;
  std::size_t line = 0;  ///< of frames.csv, from 1
};

struct FrameTable {
  std::vector<FrameRow> rows;  ///< ordered by index
  std::vector<std::string> notes;
};

/// The column names, with the line end.
std::string frames_csv_header();
/// One line, with its end. Names are quoted if necessary; they contain no line ends.
std::string frames_csv_line(const FrameInfo& info, const std::string& color_file);

/// Reads the whole table. A last line without its end that cannot be parsed is skipped with a note;
/// every other wrong line is an error (kFormat) that names it. Fails with kCancelled, too.
Result<FrameTable> parse_frames_csv(std::string_view text, std::size_t sensor_count,
                                    const RunContext& context = RunContext());

}  // namespace turnscan::recording_format
