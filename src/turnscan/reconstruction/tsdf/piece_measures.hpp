#pragma once
// Quality and coverage of a reconstructed piece, and the notes for its user.

#include <turnscan/reconstruction/tsdf/platter_columns.hpp>
#include <turnscan/reconstruction/tsdf/volumetric.hpp>

namespace turnscan::tsdf {

/// Sets the confidence from the support.
void measure_confidence(VolumetricPiece& piece);

/// Sets the quality from the support and from the input's views. filtered: the sensor averages over
/// neighbouring pixels. Fails with kCancelled.
Result<> measure_quality(VolumetricPiece& piece, const VolumetricInput& input,
                         const VolumetricScale& scale, bool filtered, const RunContext& context);

/// Sets the evidence, and the unmeasured areas: of the base on the platter, and of invented
/// surface. Needs the confidence.
void measure_evidence(VolumetricPiece& piece, const VolumeScale& scale,
                      const MeasuredFloors& floors);

/// Sets the area that sensors observed without a return. Needs the evidence. Fails with kCancelled.
Result<> measure_no_return(VolumetricPiece& piece, std::span<const views::DepthView> views,
                           const RunContext& context);

/// Points in a box that the input's views measured.
std::size_t count_points(const VolumetricInput& input, const Box& box);

/// Converts the piece to an object, with notes; the caller sets its name. Moves mesh and qualities
/// out of the piece, but not its support. color_wanted: a mesh without colours gets a note.
ObjectResult object_of(VolumetricPiece& piece, bool color_wanted);

}  // namespace turnscan::tsdf
