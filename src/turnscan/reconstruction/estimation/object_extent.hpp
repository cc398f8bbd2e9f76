#pragma once
// Extent of an object that is wider than its platter.

#include <optional>
#include <turnscan/turntable/crop/crop.hpp>
#include <vector>

namespace turnscan::estimation {

/// Distance from the axis up to which the object extends beyond the cylinder, from the points of
/// whole frames in the table frame: the extent of the cells of points that are connected
/// (26-neighbourhood) with those inside. Ignores cells with less than a fifth of the usual number
/// of points (pixels mixed with the background), and points less than a cell above the margin (what
/// surrounds the platter). A rotating object has a gap to static surroundings, else they would
/// collide. Searches up to three times the radius; nullopt if nothing extends beyond it.
std::optional<double> reach_beyond(const std::vector<Vec3f>& p_table, const Cylinder& cylinder,
                                   double cell_m);

}  // namespace turnscan::estimation
