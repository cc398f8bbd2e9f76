#pragma once
// Pixels without a return whose surroundings returned something.

#include <turnscan/core/image.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>
#include <vector>

namespace turnscan::views {

/// Marks with 1 each pixel of a view that had no return although its surroundings did: there are
/// returns on either side in its row and in its column. Excludes rims, two pixels wide, where mixed
/// pixels give no return. An empty image if there is no such pixel, or if less than four fifths of
/// the outermost pixels had a return: if the background returns nothing, either, the object's
/// silhouette is not known. Always empty for parallel views, which are resampled from points.
Image<std::uint8_t> enclosed_no_return(const DepthView& view);

/// Number of pixels without a return between foreground and background, along rows: one for each
/// depth step of 50 mm or more, in the order of the pixels. Mixed pixels make rims of one or two;
/// shadows of the emitter and matching windows make much wider ones.
std::vector<int> rim_widths(const DepthView& view);

}  // namespace turnscan::views
