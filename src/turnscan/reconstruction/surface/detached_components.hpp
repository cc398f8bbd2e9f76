#pragma once
// Components that float above a platter are parts of the objects beside them whose connection no
// frame showed. The common rule of all methods.

#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::tsdf {

/// Points of a connected component, metres.
struct PlacedComponent {
  std::vector<Vec3f> points;
  bool stands = false;
};

/// For each component the index of the one that it is attached to: its own if it stands. A detached
/// one is attached to the nearest that stands, or that is already attached to one: the shortest
/// distance between points first, so that chains of components are connected. Gaps of more than
/// farthest_of_size times the longest side of its own bounding box are not bridged: then its own
/// index. If no component stands: their own. Ties go to the earlier component.
std::vector<std::size_t> attach_detached(const std::vector<PlacedComponent>& components,
                                         double farthest_of_size);

}  // namespace turnscan::tsdf
