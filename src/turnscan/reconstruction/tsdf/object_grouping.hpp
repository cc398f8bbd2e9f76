#pragma once
// Classifies a surface's connected components as objects, detached parts of one, or noise.

#include <optional>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::tsdf {

struct GroupingRules {
  double min_share = 0.0;  ///< components with less of the largest one's area are dropped
  std::size_t keep = 0;    ///< maximum number of objects, the largest ones; 0: all
  /// Components entirely above this height (y) are detached: no frame showed their connection.
  /// nullopt: none are.
  std::optional<double> detached_above_m;
  double gap_m = 0.0;  ///< components with vertices no farther apart than this are one object
};

struct ObjectComponents {
  std::vector<TriangleMesh> components;
  std::size_t detached = 0;  ///< number of these that are detached; they are the last ones
};

/// Whether a closed mesh is a meaningful body: neither a hole within another component, which few
/// frames leave and which is invisible, nor a crumb of a voxel or two, which is folded or would
/// fold when fitted.
bool encloses_volume(const TriangleMesh& mesh);

/// Components of each object, largest object first: the one that stands, which may be the largest
/// at any height, those close to it, then the detached ones that are nearest to it.
std::vector<ObjectComponents> group_objects(std::vector<TriangleMesh> components,
                                            const GroupingRules& rules);

}  // namespace turnscan::tsdf
