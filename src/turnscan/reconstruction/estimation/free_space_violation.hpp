#pragma once
// Whether some views see past what others measured.

#include <span>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// How far behind the measured surface views claim free space, on all of it but the worst 2 %; at
/// most 6 pixels, and 0 where the views agree. A sensor that matches patterns gives surfaces at a
/// grazing angle the depth of what lies beside them, so that its outlines lie several pixels within
/// the object. Thin parts are not contested: what is seen past
/// them lies behind places that no view sees past. What more views see past than measured it does
/// not turn with the table, and does not count. points: measured, table frame; noise_m: of a
/// depth; spacing_m: of pixels on the surface. Views of depth images. 0 where fewer than 100 places
/// were measured by five views. The same for any number of threads.
double free_space_violation(std::span<const views::DepthView> views, std::span<const Vec3f> points,
                            double noise_m, double spacing_m);

}  // namespace turnscan::estimation
