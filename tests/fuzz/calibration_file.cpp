// The input is a calibration; what is read can be written and read again, to the same bytes.

#include <turnscan/recording/calibration_file.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(calibration_file) {
  using namespace turnscan;
  const auto read = parse_calibration(fuzz::text_of(data, size));
  if (!read) return 0;
  fuzz::require(read->table.axis.allFinite() && read->table.center_m.allFinite(), "finite axis");
  const std::string text = calibration_json(*read);
  const auto again = parse_calibration(text);
  fuzz::require(again && calibration_json(*again) == text, "written and read again");
  return 0;
}
