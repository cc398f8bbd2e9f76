#pragma once
// The convex outline of points in a plane.

#include <turnscan/evaluation/robust_fit.hpp>
#include <utility>
#include <vector>

namespace turnscan::artefact {

/// The points without those nearer than the margin to the outline.
std::vector<Vec3d> within_margin(const std::vector<Vec3d>& points, const Plane& plane,
                                 double margin_m);

/// Length and width, metres, of the smallest rectangle around the outline.
std::pair<double, double> outline_size(const std::vector<Vec3d>& points, const Plane& plane);

}  // namespace turnscan::artefact
