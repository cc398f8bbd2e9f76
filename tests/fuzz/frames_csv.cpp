// The input is frames.csv: each row is written and read again as the same, and a repair that marks
// every second frame as dropped changes nothing else.

#include <turnscan/recording/frames_csv.hpp>
#include <turnscan/recording/repaired_frames_csv.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(frames_csv) {
  using namespace turnscan;
  using namespace turnscan::recording_format;
  const std::string_view text = fuzz::text_of(data, size);
  auto table = parse_frames_csv(text, 3);
  if (!table) return 0;
  std::string written = frames_csv_header();
  for (const FrameRow& row : table->rows) written += frames_csv_line(row.info, row.color_file);
  const auto again = parse_frames_csv(written, 3);
  fuzz::require(again && again->rows.size() == table->rows.size(), "written and read again");
  for (std::size_t i = 0; i < table->rows.size(); ++i) {
    fuzz::require(again->rows[i].info.file == table->rows[i].info.file &&
                      again->rows[i].color_file == table->rows[i].color_file,
                  "the names of the files");
    if (i % 2 == 0) table->rows[i].info.status = FrameStatus::kDropped;
  }
  const auto mended =
      repaired_frames_csv(text.substr(0, text.find_last_not_of('\0') + 1), table->rows, 3);
  fuzz::require(bool(mended), "a table that can be mended");
  return 0;
}
