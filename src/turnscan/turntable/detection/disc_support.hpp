#pragma once
// Agreement of an image with a disc.

#include <turnscan/turntable/detection/rim_fit.hpp>

namespace turnscan::detection {

/// Agreement of the image with a disc. All members are shares, 0 to 1.
struct DiscSupport {
  double rim_share = 0.0;  ///< points of the rim where the plane is inside and not outside
  double agreement = 0.0;  ///< of the points where the image is conclusive, those that agree
  double filled = 0.0;     ///< of the disc where the image is conclusive, the part in the plane
  double seen = 0.0;       ///< part of the disc where the image is conclusive
};
DiscSupport support_of(const PlaneView& view, const RimCircle& circle);

}  // namespace turnscan::detection
