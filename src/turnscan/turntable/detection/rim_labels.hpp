#pragma once
// What the pixels about a platter's outline see.

#include <turnscan/turntable/detection/residual_correlation.hpp>
#include <turnscan/turntable/detection/rim_model.hpp>

namespace turnscan::detection {

enum class RimLabel : std::uint8_t {
  kBackground,  ///< something well behind the platter
  kMixed,       ///< it flickers or lies between platter and background
  kPlatter,     ///< its surface or its wall
  kEmpty        ///< no return: mixed and dropped, not lit, or nothing is there
};

struct RimPixel {
  int column = 0, row = 0;
  RimLabel label = RimLabel::kBackground;
  double z_m = 0.0;   ///< 0: no return
  bool bare = false;  ///< more pixels near it are empty than mixed
};

/// Of the pixels within `reach_px` of the model's outline, and those within it near the edge
/// between surface and wall. Pixels that something before the platter hides, and those beside
/// them, are left out, and so are empty ones where the platter would be nearer than anything that
/// the sensor measures. slack_m: by how much the wall may lie elsewhere. None once the context is
/// cancelled.
std::vector<RimPixel> label_rim(const PlaneView& view, const RimView& rays, const RimModel& model,
                                const NoiseCorrelation& noise, double reach_px, double slack_m,
                                const RunContext& context);

}  // namespace turnscan::detection
