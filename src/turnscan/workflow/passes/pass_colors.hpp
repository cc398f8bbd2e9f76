#pragma once
// Colours of the surface measured in a pass.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>

namespace turnscan {

/// Colours the surfaces of a pass's objects from an evenly spaced subset of its frames. If the
/// frames have no colours, the surfaces are unchanged. Fails as the sequence's read() and
/// passes::surface_colors().
Result<> color_surfaces(const SequencePass& pass, std::vector<passes::PassSurface>& objects,
                        const RunContext& context);

}  // namespace turnscan
