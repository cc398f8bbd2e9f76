#pragma once
// How the coordinates of a file lie to those in memory, where +Y is up.

#include <string>
#include <string_view>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::file {

struct FileFrame {
  bool z_up = false;
  double base = 0.0;  ///< the height that is z = 0 in a file with z up; in the points' unit
};

/// From memory to the file, and back: points, whose base is shifted, and directions.
void to_file(const FileFrame& frame, std::vector<Vec3f>& points, std::vector<Vec3f>& normals);
void from_file(const FileFrame& frame, std::vector<Vec3f>& points, std::vector<Vec3f>& normals);

/// What a file says about its frame, so that it is read back where it was; empty with y up.
/// units_per_metre: of the file, where the frame's unit is the metre.
std::string mark_of(const FileFrame& frame, double units_per_metre = 1.0);
/// In the file's unit; y up where the text is no such mark.
FileFrame frame_of_mark(std::string_view mark);

}  // namespace turnscan::file
