#pragma once
// Draws surface samples with normals from a depth image or a point cloud.

#include <turnscan/turntable/motion_input/depth_preprocessing.hpp>

namespace turnscan::motion {

/// About `wanted` samples of a smoothed depth image, spread over its foreground; pixels without a
/// reliable normal, or at grazing incidence, are omitted. Some of the points visited are appended
/// to cloud. Needs data.camera and data.noise_m.
void sample_depth(const MotionData& data, const RayTable& rays, const DepthForeground& depth,
                  std::uint64_t seed, std::size_t wanted, MotionFrame& frame,
                  std::vector<Vec3f>& cloud);

/// The same for points with a tree, with normals by principal components of 20 neighbours. The
/// points visited are appended to cloud.
void sample_points(const FrameSurface& surface, const Viewpoint& viewpoint, std::uint64_t seed,
                   std::size_t wanted, MotionFrame& frame, std::vector<Vec3f>& cloud);

}  // namespace turnscan::motion
