#pragma once
// Camera files as OpenCV's FileStorage and ROS write them: the few fields of YAML that they use.

#include <string_view>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::text {

/// The numbers between the brackets after "data:" of the matrix `name`, or of a list `name: [...]`.
/// Fails with kFormat when there is no such matrix, or it has not `least` to `most` numbers.
Result<std::vector<double>> opencv_matrix(std::string_view text, std::string_view name,
                                          std::size_t least, std::size_t most);

/// Whether a line begins with "name:".
bool opencv_has(std::string_view text, std::string_view name);

/// The number of the line "name: 640". Fails with kFormat where there is none.
Result<double> opencv_number(std::string_view text, std::string_view name);

}  // namespace turnscan::text
