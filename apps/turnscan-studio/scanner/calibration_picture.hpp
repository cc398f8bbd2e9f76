#pragma once
// Draws an averaged scan and the turntable found in it.

#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/detection/average.hpp>

#include "view/drawable.hpp"
#include "view/scene_view.hpp"

namespace turnscan::studio {

/// The averaged scan; with a table, the platter is coloured by the distance to its plane.
DrawablePtr averaged_picture(const AveragedScan& scan, const TurntableInfo* table);

/// Legend of those colours.
Legend residual_legend();

/// The rim, and the axis from the centre of the platter. Sensor frame.
Segments table_outline(const TurntableInfo& table);

}  // namespace turnscan::studio
