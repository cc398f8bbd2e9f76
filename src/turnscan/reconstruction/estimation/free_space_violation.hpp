#pragma once
// Detects views that see through surface that others measured.

#include <span>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// Distance behind the measured surface at which views observe free space, on all of it but the
/// worst 2 %; at most 6 pixels, and 0 where the views agree. A sensor that matches patterns gives
/// surfaces at grazing incidence the depth of what is beside them, so that its outlines are several
/// pixels inside the object. Thin parts are not contested: what is seen past them is behind points
/// that no view sees past. Points that more views see past than measured do not turn with the
/// table, and are ignored. points: measured, table frame; noise_m: of a depth value; spacing_m: of
/// pixels on the surface. Views of depth images. 0 if fewer than 100 points were measured by five
/// views. The result does not depend on the number of threads.
double free_space_violation(std::span<const views::DepthView> views, std::span<const Vec3f> points,
                            double noise_m, double spacing_m);

}  // namespace turnscan::estimation
