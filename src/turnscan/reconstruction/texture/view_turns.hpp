#pragma once
// How far the object had really turned in each view's colour image: streams of colour and depth are
// not taken at the same instant, and the time between them wanders.

#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

/// Radians per view about the axis of the table (ColorView::T_object_table), beside what its frame
/// says; mean 0, for a turn of all of them alike is a matter of the camera's place. Found so that
/// the patterns of places that two views show lie on each other, up to three texels apart. Views
/// that share no pattern with others stay at 0. The same for any number of threads. Fails with
/// kCancelled.
Result<std::vector<double>> solve_turns(const TexelBlocks& blocks, const ChosenViews& chosen,
                                        const TexelSamples& samples,
                                        const std::vector<ColorView>& views,
                                        const RunContext& context);

/// By how much the patterns of the same places differ, levels squared, where views show one; the
/// smaller, the better the views fit.
double pattern_misfit(const TexelBlocks& blocks, const ChosenViews& chosen,
                      const TexelSamples& samples);

/// By how many pixels turns move the images of a mesh: rms over its surface and the views.
double turned_px(const std::vector<double>& turns, const std::vector<ColorView>& views,
                 const TriangleMesh& mesh);

}  // namespace turnscan::texture
