#pragma once
// Estimates the true rotation of the object in each view's colour image: colour and depth streams
// are not captured at the same instant, and the delay between them drifts.

#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

/// Radians per view about the axis of the table (ColorView::T_object_table), relative to the
/// frame's angle; their mean is 0, since a common rotation belongs to the camera's pose. Aligns the
/// patterns of surface that two views show, up to three texels apart. Views that share no pattern
/// with others stay at 0. The result does not depend on the number of threads. Fails with
/// kCancelled.
Result<std::vector<double>> solve_turns(const TexelBlocks& blocks, const ChosenViews& chosen,
                                        const TexelSamples& samples,
                                        const std::vector<ColorView>& views,
                                        const RunContext& context);

/// Difference between the patterns of the same surface points, levels squared, where views show a
/// pattern; the smaller, the better the views match.
double pattern_misfit(const TexelBlocks& blocks, const ChosenViews& chosen,
                      const TexelSamples& samples);

/// Displacement of a mesh's images by the rotations in pixels: root mean square over its surface
/// and the views.
double turned_px(const std::vector<double>& turns, const std::vector<ColorView>& views,
                 const TriangleMesh& mesh);

}  // namespace turnscan::texture
