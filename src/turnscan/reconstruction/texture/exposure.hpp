#pragma once
// Exposure and white balance of each view.

#include <turnscan/reconstruction/texture/texel_samples.hpp>

namespace turnscan::texture {

/// Mean colour (linear light) of each slot of each block; negative if the view does not show the
/// whole block.
using BlockMeans = std::vector<std::array<Vec3f, kSlots>>;
BlockMeans block_means(const TexelBlocks& blocks, const ChosenViews& chosen,
                       const TexelSamples& samples);

/// Whether a mean is neither too dark nor too bright for its ratio to another one to be meaningful.
bool tells_of_exposure(const Vec3f& mean);

/// Factors of the red, green and blue (linear light) of each view with which views agree where they
/// show the same surface: least squares of logarithms over all pairs of views, with outliers
/// downweighted. The more the pairs contradict each other, the closer gains stay to 1. Views that
/// share no surface with others are unchanged.
std::vector<Vec3f> solve_gains(const ChosenViews& chosen, const BlockMeans& means,
                               std::size_t views);

}  // namespace turnscan::texture
