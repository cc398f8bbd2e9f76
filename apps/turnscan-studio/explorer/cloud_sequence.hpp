#pragma once
// A cloud seen as a recording, so that the stages of the pipeline take it.

#include <memory>
#include <turnscan/core/frame.hpp>

namespace turnscan::studio {

/// Frames of points in the table's frame. With viewpoints (of cloud.frame) they are those of the
/// cloud; without, points whose normals look the same way are a frame seen from there; without
/// normals, points on the same side of the cloud's middle are. Not to be filtered per frame.
std::unique_ptr<FrameSequence> sequence_of(const PointCloud& cloud,
                                           const std::vector<Viewpoint>& viewpoints);

}  // namespace turnscan::studio
