#pragma once
// Parts of an object that return nothing (black, shiny, transparent): their visual hull.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/tsdf/sample_bits.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::tsdf {

/// The unknown samples that most views looked at in vain, though what lies around them in the image
/// returned something (enclosed_no_return()), and that none saw past; in parts of some size. Where
/// nothing was measured near, free space is known brick by brick only: around the hull it is looked
/// up sample by sample, and entered in the volume. Of many views 128, evenly spread, are asked.
/// Empty where views show no such pixels, and with sensors that have no return beside every rim,
/// as those whose emitter casts wide shadows. Fails with kCancelled.
Result<SampleBits> no_return_hull(Volume& volume, std::span<const views::DepthView> views,
                                  const RunContext& context);

/// Makes samples of a volume inside for good.
void set_inside(Volume& volume, const SampleBits& samples);

}  // namespace turnscan::tsdf
