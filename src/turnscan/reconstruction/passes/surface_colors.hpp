#pragma once
// The colour of a pass's surface, independent of its illumination; it determines the pose of
// objects whose shape does not.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::passes {

/// One colour per point of the surface, as in PassSurface::colors: NaN if no view shows it. views:
/// of the same pass, with colours; others are skipped. The lamp stands still while the object
/// turns, so that each point is seen with its normal in several directions: variation with that
/// direction, as spherical harmonics up to the second degree, is shading rather than colour and is
/// removed. Shading that depends only on the angle between the normal and the table's axis does not
/// vary and remains; see ShadingFit. Each point takes the median of its observations, which
/// suppresses highlights. Empty if hardly any point is seen. Fails with kCancelled.
Result<std::vector<Vec3f>> surface_colors(const PassSurface& surface,
                                          std::span<const views::DepthView> views,
                                          const RunContext& context);

}  // namespace turnscan::passes
