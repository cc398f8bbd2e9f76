// The input is recording.json; what is read can be written and read again.

#include <turnscan/recording/recording_json.hpp>

#include "tests/fuzz/checks.hpp"

TURNSCAN_FUZZ_TARGET(recording_json) {
  using namespace turnscan;
  using namespace turnscan::recording_format;
  const auto read = parse_recording_json(fuzz::text_of(data, size));
  if (!read) return 0;
  fuzz::require(bool(check_header(read->header)), "a header that can be written");
  const auto again = parse_recording_json(recording_json(*read));
  fuzz::require(again && again->header.sensors.size() == read->header.sensors.size(),
                "written and read again");
  return 0;
}
