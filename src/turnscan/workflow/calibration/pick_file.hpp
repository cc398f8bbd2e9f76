#pragma once

#include <string>
#include <turnscan/turntable/detection/average.hpp>
#include <vector>

namespace turnscan::workflow {

/// Reads the points of a CSV file, sensor frame, metres. Its first line names the columns: x_m,
/// y_m, z_m or x_mm, y_mm, z_mm for points, or column, row for pixels of the averaged scan, whose
/// depth is the median of the valid pixels in the 3 x 3 neighbourhood. Fails with kFormat, naming
/// the line, also if a pixel has no depth or scan is nullptr.
Result<std::vector<Vec3d>> read_picks(const std::string& path, const AveragedScan* scan);

/// Whether the file contains pixels, which need the averaged scan.
Result<bool> picks_pixels(const std::string& path);

}  // namespace turnscan::workflow
