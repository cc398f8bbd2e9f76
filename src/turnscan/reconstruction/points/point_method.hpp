#pragma once
// The methods from points: each frame's points are summed as they arrive, and only the sums are
// kept; candidate points, normals and the surface follow at the end (thesis 3.4).

#include <turnscan/reconstruction/method.hpp>

namespace turnscan::points {

MethodEntry poisson_method();
MethodEntry concave_hull_method();

}  // namespace turnscan::points
