// The input is a file of a camera's calibration.

#include <turnscan/io/text/camera_file.hpp>

#include "tests/fuzz/checks.hpp"
#include "tests/fuzz/fuzz_target.hpp"

TURNSCAN_FUZZ_TARGET(camera_file) {
  using namespace turnscan;
  const auto camera = text::parse_camera_file(fuzz::text_of(data, size));
  if (!camera) fuzz::require(!camera.error().message.empty(), "a reason");
  return 0;
}
