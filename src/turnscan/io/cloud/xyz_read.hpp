#pragma once
// Reader for clouds as text: a point a line (.xyz, .asc, .txt, .pts).

#include <filesystem>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>

namespace turnscan::xyz {

/// Whether a file of this name is read as text.
bool is_xyz_name(const std::filesystem::path& path);

/// Lines of numbers between spaces, tabulators, commas or semicolons (then with decimal points or
/// commas): x y z, and others, of which red, green and blue are taken where they stand last behind
/// x y z (and an intensity) and are whole numbers up to 255. A first line that names the columns or
/// counts the points is passed over, and so are comments (# and //). The result still contains
/// points that are not finite. Fails with kFormat, naming the line.
Result<CloudFile> parse_xyz(std::string_view bytes);

}  // namespace turnscan::xyz
