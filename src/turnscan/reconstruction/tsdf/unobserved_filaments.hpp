#pragma once
// Threads and thin sheets of what was only guessed to be inside.

#include <turnscan/reconstruction/tsdf/sample_bits.hpp>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// The unknown samples that are inside but not part of the opening of the inside by an octahedron
/// of that radius in samples, where only what was guessed to be outside erodes: free space that
/// was seen does not, so that a part of which a band was not seen stays whole. guessed: bricks
/// without samples that no view saw.
SampleBits unobserved_filaments(const Volume& volume, const std::vector<std::size_t>& guessed,
                                int radius);

}  // namespace turnscan::tsdf
