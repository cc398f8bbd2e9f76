#pragma once
// Presents a cloud as a recording, so that the stages of the pipeline accept it.

#include <memory>
#include <turnscan/core/frame.hpp>

namespace turnscan::studio {

/// Frames of points in the table's frame. With viewpoints (of cloud.frame) these are the cloud's
/// frames; without, points with similar normals form a frame seen from that direction; without
/// normals, points on the same side of the cloud's centre do. Must not be filtered per frame.
std::unique_ptr<FrameSequence> sequence_of(const PointCloud& cloud,
                                           const std::vector<Viewpoint>& viewpoints);

}  // namespace turnscan::studio
