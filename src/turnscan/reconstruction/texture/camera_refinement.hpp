#pragma once
// Refines the pose of a colour camera relative to its depth camera from the outlines of the mesh in
// its images and from the consistency of the images.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>

namespace turnscan::texture {

struct RefinedCamera {
  Pose T_color_sensor = Pose::Identity();
  double misplaced_px = 0.0;  ///< correction of the pose, root mean square over the surface
  double deviation_px = 0.0;  ///< its standard deviation, including errors of the shape
  bool refined = false;       ///< false: the images do not determine a better pose; unchanged
};

/// Searches for the mesh's outline in the images along its normals (Harris and Stennett 1990,
/// "RAPID"), then makes the colours of each point agree in all views (as Zhou and Koltun 2014,
/// "Color map optimization", but with one pose for all and the mean eliminated). Directions in
/// which the camera would move by less than twice the standard deviation of the evidence are
/// unchanged. views: of one sensor; some 20 of them are read. Fails as image_of(), with kCancelled.
/// The result does not depend on the number of threads.
Result<RefinedCamera> refine_camera(const FrameSequence& sequence, const TriangleMesh& mesh,
                                    const std::vector<ColorView>& views, const Pose& T_color_sensor,
                                    const RunContext& context);

}  // namespace turnscan::texture
