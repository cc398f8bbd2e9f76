#pragma once
// Input of the sampling kernels for bodies seen from one pose: where each is in the image, and
// where something outside the image may occlude a sample from the other eye.

#include <span>
#include <turnscan/simulator/sampling/sample_kernel.hpp>
#include <turnscan/simulator/sampling/samples.hpp>
#include <vector>

namespace turnscan::sampling {

/// The bodies as seen from one pose. Throws as SampleTracer::trace.
struct PoseViews {
  std::vector<BodyView> bodies;
  View view;  ///< refers to bodies

  PoseViews(std::span<const Body> all, const ScannerModel& model, const Pose& T_world_sensor);
  PoseViews(const PoseViews&) = delete;
  PoseViews& operator=(const PoseViews&) = delete;
};

/// The smallest rect that contains both; an empty one adds nothing.
PixelRect united(const PixelRect& a, const PixelRect& b);

/// Whether the other eye is displaced along the rows or the columns of an image without distortion.
bool baseline_along_image(const ScannerModel& model);

/// Sets the baseline of such a scanner in `view`. The border is that of the image, extended with
/// `beyond` by the image's size on the side of the other eye. Returns the part of it that may see a
/// body; for surface beyond it only the nearest depth is kept (View::border_nearness).
PixelRect set_baseline(std::span<const Body> bodies, const ScannerModel& model,
                       const Pose& T_world_sensor, bool beyond, View& view);

/// The rect, extended on the side of the other eye as far as `wide`.
Window canvas_frame(const PixelRect& rect, const PixelRect& wide, const View& view);

}  // namespace turnscan::sampling
