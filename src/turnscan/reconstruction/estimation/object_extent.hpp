#pragma once
// An object that is wider than its platter.

#include <optional>
#include <turnscan/turntable/crop/crop.hpp>
#include <vector>

namespace turnscan::estimation {

/// How far from the axis the object reaches beyond the cylinder, of the points of whole frames in
/// the table frame: as far as cells of points hang together with those inside, from one cell to the
/// 26 around it. Cells with less than a fifth of the usual number of points do not count (pixels
/// mixed with the background), nor points less than a cell above the margin (what surrounds the
/// platter). What turns is apart from what stands still, else they would touch. Looks as far as
/// three times the radius; nullopt where nothing reaches beyond it.
std::optional<double> reach_beyond(const std::vector<Vec3f>& p_table, const Cylinder& cylinder,
                                   double cell_m);

}  // namespace turnscan::estimation
