#pragma once
// Reads camera files written by OpenCV's FileStorage and ROS: the subset of YAML that they use.

#include <string_view>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::text {

/// The numbers between the brackets after "data:" of the matrix `name`, or of a list `name: [...]`.
/// Fails with kFormat if there is no such matrix, or if it does not have `least` to `most` numbers.
Result<std::vector<double>> opencv_matrix(std::string_view text, std::string_view name,
                                          std::size_t least, std::size_t most);

/// Whether a line begins with "name:".
bool opencv_has(std::string_view text, std::string_view name);

/// The number in the line "name: 640". Fails with kFormat if there is none.
Result<double> opencv_number(std::string_view text, std::string_view name);

}  // namespace turnscan::text
