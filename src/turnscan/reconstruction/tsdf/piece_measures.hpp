#pragma once
// How much of a reconstructed piece was measured, and what its user is told of it.

#include <turnscan/reconstruction/tsdf/volumetric.hpp>

namespace turnscan::tsdf {

/// Sets the confidence from the support.
void measure_confidence(VolumetricPiece& piece);

/// Sets the quality from the support and from the input's views. filtered: the sensor averages over
/// neighbouring pixels. Fails with kCancelled.
Result<> measure_quality(VolumetricPiece& piece, const VolumetricInput& input,
                         const VolumetricScale& scale, bool filtered, const RunContext& context);

/// Sets the evidence, and the areas that no frame measured: of the base on the platter, and of what
/// was invented. Needs the confidence.
void measure_evidence(VolumetricPiece& piece, const VolumeScale& scale);

/// Sets the area in which sensors looked in vain. Needs the evidence. Fails with kCancelled.
Result<> measure_no_return(VolumetricPiece& piece, std::span<const views::DepthView> views,
                           const RunContext& context);

/// Points in a box that the input's views measured.
std::size_t count_points(const VolumetricInput& input, const Box& box);

/// The piece as an object, with notes; its name is the caller's. Takes mesh and qualities out of
/// the piece, but not its support. color_wanted: a mesh without colours gets a note.
ObjectResult object_of(VolumetricPiece& piece, bool color_wanted);

}  // namespace turnscan::tsdf
