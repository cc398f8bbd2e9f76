#pragma once
// Labels the pixels near a platter's outline by what they see.

#include <turnscan/turntable/detection/residual_correlation.hpp>
#include <turnscan/turntable/detection/rim_model.hpp>

namespace turnscan::detection {

enum class RimLabel : std::uint8_t {
  kBackground,  ///< something well behind the platter
  kMixed,       ///< it flickers or is between platter and background
  kPlatter,     ///< the platter's surface or wall
  kEmpty        ///< no return: mixed and dropped, not lit, or nothing there
};

struct RimPixel {
  int column = 0, row = 0;
  RimLabel label = RimLabel::kBackground;
  double z_m = 0.0;   ///< 0: no return
  bool bare = false;  ///< more pixels near it are empty than mixed
};

/// Labels the pixels within `reach_px` of the model's outline and of the edge between surface and
/// wall. Omits pixels that something before the platter occludes and those beside them, and empty
/// ones where the platter would be nearer than anything that the sensor measures. slack_m:
/// tolerance of the wall's position. Empty once the context is cancelled.
std::vector<RimPixel> label_rim(const PlaneView& view, const RimView& rays, const RimModel& model,
                                const NoiseCorrelation& noise, double reach_px, double slack_m,
                                const RunContext& context);

}  // namespace turnscan::detection
