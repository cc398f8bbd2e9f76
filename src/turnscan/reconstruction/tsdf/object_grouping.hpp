#pragma once
// Which of a surface's connected components are objects, which are detached parts of one, and which
// are nothing.

#include <optional>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::tsdf {

struct GroupingRules {
  double min_share = 0.0;  ///< components with less of the largest one's area are dropped
  std::size_t keep = 0;    ///< most objects that are kept, the largest; 0: all
  /// Components that lie entirely above this height (y) are detached: no frame showed what holds
  /// them. nullopt: none are.
  std::optional<double> detached_above_m;
  double gap_m = 0.0;  ///< components with vertices no farther apart are one object
};

struct ObjectComponents {
  std::vector<TriangleMesh> components;
  std::size_t detached = 0;  ///< of these; they are the last ones
};

/// Whether a closed mesh is more than nothing: not a hole within another component, which few
/// frames leave and nobody sees or prints, nor a crumb of a voxel or two, which is folded already
/// or folds where it is fitted.
bool encloses_volume(const TriangleMesh& mesh);

/// Components of each object, largest object first: the one that stands, which may be the largest
/// wherever it lies, those close to it, then the detached ones that are nearest to it.
std::vector<ObjectComponents> group_objects(std::vector<TriangleMesh> components,
                                            const GroupingRules& rules);

}  // namespace turnscan::tsdf
