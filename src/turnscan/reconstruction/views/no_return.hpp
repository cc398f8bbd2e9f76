#pragma once
// Where a view looked in vain: pixels without a return whose surroundings did return something.

#include <turnscan/core/image.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>
#include <vector>

namespace turnscan::views {

/// Per pixel of a view (1: yes), whether it had no return though the space around it did: in its
/// row and in its column there are returns on either side. Rims, two pixels wide, have none of
/// mixed pixels and are left out. An empty image where there is no such pixel, or where less than
/// four fifths of the outermost pixels had a return: where what lies behind the object returns
/// nothing, either, its silhouette is not known. Of parallel views always empty: they are resampled
/// from points.
Image<std::uint8_t> enclosed_no_return(const DepthView& view);

/// How many pixels without a return lie between what is near and what lies behind it, along rows:
/// one number for each step of 50 mm or more in depth, in the order of the pixels. Mixtures of both
/// sides make rims of one or two; shadows of the emitter and matching windows much wider ones.
std::vector<int> rim_widths(const DepthView& view);

}  // namespace turnscan::views
