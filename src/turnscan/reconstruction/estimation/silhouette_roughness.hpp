#pragma once
// Whether the pixels of a depth camera measure places beside those that they look at.

#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// Share of the pixels next to the outlines of a mesh, outside them, that show its surface
/// nevertheless. Lateral noise does that, which tears edges (C. V. Nguyen, S. Izadi and D. Lovell,
/// "Modeling Kinect sensor noise for improved 3D reconstruction and tracking", 2012, section 3);
/// without it few do. 0 where there are too few outlines. Of depth images; mesh: what they made;
/// noise_m: of a depth. The same for any number of threads.
double ragged_share(std::span<const views::DepthView> views, const TriangleMesh& mesh,
                    double noise_m);

}  // namespace turnscan::estimation
