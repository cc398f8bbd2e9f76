#pragma once
// Exact traversal of the cells of one voxel by a line.

#include <cmath>
#include <limits>
#include <turnscan/core/pose.hpp>

namespace turnscan::voxels {

/// Visits, in order, each cell of the grid [0, s)^3 (unit cells) that the line through p with
/// direction d crosses (Amanatides and Woo 1987): the whole chord, or only the part from p along
/// +d. p is in the grid; coordinates that rounding has put outside by less than a cell are clamped.
/// With d = 0 only the cell of p is visited. visit(x, y, z).
template <class Visit>
void walk_sub_voxels(Vec3d p, const Vec3d& d, int s, bool whole_chord, const Visit& visit) {
  p = p.cwiseMax(0.0).cwiseMin(std::nextafter(double(s), 0.0));
  // The chord enters the grid where it crosses the last of the three slabs backwards.
  double t_enter = 0.0;
  if (whole_chord) {
    t_enter = -std::numeric_limits<double>::infinity();
    for (int a = 0; a < 3; ++a) {
      if (d[a] > 0.0) t_enter = std::max(t_enter, -p[a] / d[a]);
      if (d[a] < 0.0) t_enter = std::max(t_enter, (s - p[a]) / d[a]);
    }
    if (!std::isfinite(t_enter)) t_enter = 0.0;
  }
  Eigen::Vector3i cell, step;
  Vec3d t_next, t_step;
  for (int a = 0; a < 3; ++a) {
    const double x = p[a] + t_enter * d[a];
    cell[a] = std::min(s - 1, std::max(0, static_cast<int>(std::floor(x))));
    // On its entry face a descending line belongs to the cell below the face.
    step[a] = d[a] > 0.0 ? 1 : d[a] < 0.0 ? -1 : 0;
    if (d[a] < 0.0 && x == cell[a] && cell[a] > 0 && whole_chord) --cell[a];
    t_step[a] = step[a] == 0 ? std::numeric_limits<double>::infinity() : 1.0 / std::abs(d[a]);
    t_next[a] = step[a] == 0 ? std::numeric_limits<double>::infinity()
                             : (cell[a] + (step[a] > 0 ? 1 : 0) - p[a]) / d[a];
  }
  while (true) {
    visit(cell.x(), cell.y(), cell.z());
    int axis = 0;
    const double t = t_next.minCoeff(&axis);
    if (!std::isfinite(t)) return;
    cell[axis] += step[axis];
    t_next[axis] += t_step[axis];
    if (cell[axis] < 0 || cell[axis] >= s) return;
  }
}

}  // namespace turnscan::voxels
