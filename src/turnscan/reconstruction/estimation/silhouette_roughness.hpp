#pragma once
// Detects lateral noise of a depth camera, whose pixels measure points beside their own rays.

#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::estimation {

/// Share of the pixels just outside the outlines of a mesh that show its surface nevertheless. This
/// is caused by lateral noise, which makes edges ragged (C. V. Nguyen, S. Izadi and D. Lovell,
/// "Modeling Kinect sensor noise for improved 3D reconstruction and tracking", 2012, section 3);
/// without it the share is small. 0 if there are too few outlines. Views of depth images; mesh:
/// reconstructed from them; noise_m: of a depth value. The result does not depend on the number of
/// threads.
double ragged_share(std::span<const views::DepthView> views, const TriangleMesh& mesh,
                    double noise_m);

}  // namespace turnscan::estimation
