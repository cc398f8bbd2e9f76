#pragma once
// Nothing on a platter hangs in the air: pieces that do are parts of what stands beside them, and
// no frame showed what holds them. The one rule for all methods.

#include <cstddef>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Points of something, metres.
struct PlacedPiece {
  std::vector<Vec3f> points;
  bool stands = false;
};

/// For each piece the number of the one that it belongs to: its own where it stands. What floats
/// belongs to the nearest that stands, or to what that holds already: the shortest way from point
/// to point first, so that a chain of pieces hangs together. Not across more than farthest_of_size
/// times the longest side of its own box: then its own number. Without a piece that stands: their
/// own. Ties go to the earlier piece.
std::vector<std::size_t> find_holders(const std::vector<PlacedPiece>& pieces,
                                      double farthest_of_size);

}  // namespace turnscan
