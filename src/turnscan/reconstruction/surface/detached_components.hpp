#pragma once
// Nothing on a platter hangs in the air: components that do are parts of what stands beside them,
// and no frame showed what holds them. The one rule for all methods.

#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::tsdf {

/// Points of a connected component, metres.
struct PlacedComponent {
  std::vector<Vec3f> points;
  bool stands = false;
};

/// For each component the number of the one that it is attached to: its own where it stands. A
/// detached one is attached to the nearest that stands, or to what that holds already: the shortest
/// way from point to point first, so that a chain of components hangs together. Not across more
/// than farthest_of_size times the longest side of its own box: then its own number. Without a
/// component that stands: their own. Ties go to the earlier component.
std::vector<std::size_t> attach_detached(const std::vector<PlacedComponent>& components,
                                         double farthest_of_size);

}  // namespace turnscan::tsdf
