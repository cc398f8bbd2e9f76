#pragma once
// The colours of what was measured in a pass.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/pass_surface.hpp>
#include <turnscan/workflow/passes/joined_frames.hpp>

namespace turnscan {

/// Gives the surfaces of a pass's objects their colours, from some of its frames, evenly spread.
/// Without colours in the frames they stay as they are. Fails as the sequence's read() and
/// passes::surface_colors().
Result<> color_surfaces(const SequencePass& pass, std::vector<passes::PassSurface>& objects,
                        const RunContext& context);

}  // namespace turnscan
