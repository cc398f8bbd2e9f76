#pragma once
// The colour of a pass's surface, free of how it was lit: what tells how an object lay whose shape
// does not.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

/// One colour a point of the surface, as PassSurface::colors has them: NaN where no view shows it.
/// views: of the same pass, with colours; others are left out. The lamp stands still while the
/// object turns, so that each point is seen with its normal in several directions: what changes
/// with that direction, as spherical harmonics up to the second degree, is light and not colour
/// and is taken out. What depends only on the angle between normal and axis of the table is not
/// seen to change and stays; see ShadingFit. Of what is left of each point the median counts, so
/// that a highlight does not. Empty when hardly any point is seen. Fails with kCancelled.
Result<std::vector<Vec3f>> surface_colors(const PassSurface& surface,
                                          std::span<const views::DepthView> views,
                                          const RunContext& context);

}  // namespace turnscan::passes
