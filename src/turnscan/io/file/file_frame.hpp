#pragma once
// Transformation between the coordinates of a file and those in memory, where +Y is up.

#include <string>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::file {

struct FileFrame {
  bool z_up = false;
  double base = 0.0;  ///< the height that becomes z = 0 in a file with z up; in the points' unit
};

/// From memory to the file, and back: points, which are also shifted by the base, and directions.
void to_file(const FileFrame& frame, std::vector<Vec3f>& points, std::vector<Vec3f>& normals);
void from_file(const FileFrame& frame, std::vector<Vec3f>& points, std::vector<Vec3f>& normals);

/// Text stored in a file to identify its frame, so that reading restores the original coordinates;
/// empty with y up. units_per_metre: of the file, if the frame's unit is the metre.
std::string mark_of(const FileFrame& frame, double units_per_metre = 1.0);
/// The frame in the file's unit; y up if the text is not such a mark.
FileFrame frame_of_mark(std::string_view mark);

}  // namespace turnscan::file
