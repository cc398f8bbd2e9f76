#pragma once
// How an image agrees with a disc.

#include <turnscan/turntable/detection/rim_fit.hpp>

namespace turnscan::detection {

/// How the image agrees with a disc.
struct DiscSupport {
  double rim_share = 0.0;  ///< places of the rim where the plane is inside and not outside
  double agreement = 0.0;  ///< of the places where the image decides, those that agree
  double filled = 0.0;     ///< of the disc where the image decides, what is in the plane
  double seen = 0.0;       ///< of the disc, where the image decides
};
DiscSupport support_of(const PlaneView& view, const RimCircle& circle);

}  // namespace turnscan::detection
