// The input is a CSV file of points on the rim, or of pixels of a small averaged scan.

#include <turnscan/workflow/calibration/pick_file.hpp>

#include "tests/fuzz/scratch_folder.hpp"

namespace {

turnscan::AveragedScan small_scan() {
  turnscan::AveragedScan scan;
  scan.intrinsics.width = 4;
  scan.intrinsics.height = 3;
  scan.intrinsics.fx = scan.intrinsics.fy = 5.0;
  scan.depth_m.width = 4;
  scan.depth_m.height = 3;
  scan.depth_m.pixels.assign(12, 1.0f);
  return scan;
}

}  // namespace

TURNSCAN_FUZZ_TARGET(pick_file) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  static const AveragedScan scan = small_scan();
  folder.put("picks.csv", fuzz::text_of(data, size));
  const std::string path = (folder / "picks.csv").string();
  const auto pixels = workflow::picks_pixels(path);
  const auto picks = workflow::read_picks(path, &scan);
  fuzz::require(pixels || !picks, "points only where the columns are known");
  if (picks)
    for (const Vec3d& p : *picks) fuzz::require(p.allFinite(), "finite points");
  return 0;
}
