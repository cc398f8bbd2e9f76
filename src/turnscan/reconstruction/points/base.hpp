#pragma once
// Closes an object's underside flat on the platter (thesis figure 3.11).

#include <turnscan/core/point_cloud.hpp>

namespace turnscan::points {

struct BaseResult {
  PointCloud added;       ///< base at y = 0 with normals down, and walls down to it
  std::size_t walls = 0;  ///< number of added points that continue walls
  double area_m2 = 0.0;   ///< of the closed footprint
};

/// Points that close the footprint of one object on the platter (y = 0 of the table frame). The
/// footprint is the region that the lowest measured walls enclose, as seen from above on cells of
/// cell_m: a region whose walls' normals point into it is a hollow and stays open, and several feet
/// are closed separately. Walls are extended from the lowest measured height, which must be within
/// reach_m of the platter, down to it. Empty if the object does not stand on the platter.
BaseResult close_base(const PointCloud& oriented, double cell_m, double reach_m);

}  // namespace turnscan::points
