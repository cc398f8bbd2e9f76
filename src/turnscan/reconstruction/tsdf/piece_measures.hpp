#pragma once
// How much of a reconstructed piece was measured.

#include <turnscan/reconstruction/tsdf/volumetric.hpp>

namespace turnscan::tsdf {

/// Sets the confidence from the support.
void measure_confidence(VolumetricPiece& piece);

/// Sets the areas that no frame measured: of the base on the platter, and of what was invented. 1
/// for the triangles of the latter. Needs the confidence.
std::vector<std::uint8_t> measure_invented(VolumetricPiece& piece, const VolumeScale& scale);

/// Points in a box that the input's views measured.
std::size_t count_points(const VolumetricInput& input, const Box& box);

}  // namespace turnscan::tsdf
