#pragma once
// Removes surface that is supported only by pixels beside a rim.

#include <span>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// Makes samples unknown that few views measured (weight below a twentieth of the usual weight
/// beside a surface, minus three), all of them with pixels beside a depth step of more than two
/// truncation distances: such pixels may be mixtures of both sides, and with many frames, enough of
/// them put surface into the same part of a hollow. True surface is mostly also seen by pixels
/// farther from the rim. Uses up to 256 of the views, evenly spread. Fails with kCancelled.
Result<> forget_doubtful_surface(Volume& volume, std::span<const views::DepthView> views,
                                 const RunContext& context);

}  // namespace turnscan::tsdf
