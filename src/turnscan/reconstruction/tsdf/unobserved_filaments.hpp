#pragma once
// Filaments and thin sheets of samples that are inside without having been observed.

#include <turnscan/reconstruction/tsdf/sample_bits.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// The unknown samples that are inside but not part of the morphological opening of the inside by
/// an octahedron of that radius in samples, where only unobserved outside erodes: observed free
/// space does not, so that a part with an unobserved band stays whole. guessed: bricks without
/// samples that no view observed.
SampleBits unobserved_filaments(const Volume& volume, const std::vector<std::size_t>& guessed,
                                int radius);

}  // namespace turnscan::tsdf
