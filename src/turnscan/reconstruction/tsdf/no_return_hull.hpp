#pragma once
// Visual hull of the parts of an object that return nothing (black, shiny, transparent).

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/tsdf/sample_bits.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::tsdf {

/// The unknown samples that most views observed without a return, although their surroundings in
/// the image returned something (enclosed_no_return()), and that none saw past; in parts of some
/// size. Where nothing was measured nearby, free space is known only per brick: around the hull it
/// is determined per sample, and entered in the volume. Of many views 128, evenly spread, are used.
/// Empty if views have no such pixels, and with sensors that have no return beside every rim, such
/// as those whose emitter casts wide shadows. Fails with kCancelled.
Result<SampleBits> no_return_hull(Volume& volume, std::span<const views::DepthView> views,
                                  const RunContext& context);

/// Sets samples of a volume permanently to inside.
void set_inside(Volume& volume, const SampleBits& samples);

}  // namespace turnscan::tsdf
