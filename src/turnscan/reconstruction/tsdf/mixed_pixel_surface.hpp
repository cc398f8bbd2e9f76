#pragma once
// Surface of which only pixels beside a rim know.

#include <span>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// Makes samples unknown that few views measured (three less than a twentieth of the usual weight
/// beside a surface), all of them with pixels beside a depth step of more than two truncations:
/// these may be mixtures of both sides, and of many frames enough put surface into the same place
/// of a hollow. Where something is, pixels farther from the rim mostly show it, too. Looks at up to
/// 256 of the views, evenly spread. Fails with kCancelled.
Result<> forget_doubtful_surface(Volume& volume, std::span<const views::DepthView> views,
                                 const RunContext& context);

}  // namespace turnscan::tsdf
