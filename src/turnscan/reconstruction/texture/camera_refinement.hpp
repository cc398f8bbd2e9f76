#pragma once
// Where a colour camera really is beside its depth camera, by the outlines of the mesh in its
// images, and by what the images show of the same places.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>

namespace turnscan::texture {

struct RefinedCamera {
  Pose T_color_sensor = Pose::Identity();
  double misplaced_px = 0.0;  ///< rms over the surface, between where it was and is
  double deviation_px = 0.0;  ///< standard deviation of that, errors of the shape included
  bool refined = false;       ///< false: the images do not show it better; left as it was
};

/// The outline of the mesh is looked for in the images along its normals (Harris and Stennett 1990,
/// "RAPID"), then colours of the same places are brought to agree in all views (as Zhou and Koltun
/// 2014, "Color map optimization", but with one pose for all and the mean eliminated). A
/// direction in which the camera would move by less than twice the deviation of the evidence stays
/// as it was. views: of one sensor, some 20 of them are read. Fails as image_of(), with kCancelled.
/// The same for any number of threads.
Result<RefinedCamera> refine_camera(const FrameSequence& sequence, const TriangleMesh& mesh,
                                    const std::vector<ColorView>& views, const Pose& T_color_sensor,
                                    const RunContext& context);

}  // namespace turnscan::texture
