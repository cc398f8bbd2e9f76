#pragma once
// The triangles of a scene in groups of 16 neighbours, as plain arrays. Also included by sources
// that are compiled for other instruction sets: no inline functions here.

#include <cstdint>

namespace turnscan::sampling {

inline constexpr int kLanes = 16;

/// The triangles of an object.
struct ObjectView {
  const float* vertices = nullptr;  ///< x y z each
  const std::uint32_t* indices = nullptr;
  std::uint32_t vertex_count = 0, triangle_count = 0;
};

/// Object and index of the triangle in a slot of a scene's clusters.
struct TriangleName {
  std::uint32_t object = 0, triangle = 0;
};

inline constexpr int kLevels = 3;

/// Bounding boxes of neighbouring elements: for each kLanes of them centre x y z and half size x y
/// z.
struct GroupBoxes {
  const float* bounds = nullptr;
  int count = 0;
};

/// All triangles of a scene in groups of kLanes neighbours; slot s is lane s % kLanes of group s /
/// kLanes. The last triangle is repeated as padding.
struct Clusters {
  const float* corners = nullptr;       ///< per group ax, ay, az, bx, ... cz: kLanes each
  const TriangleName* names = nullptr;  ///< per slot
  GroupBoxes levels[kLevels];           ///< of groups, of kLanes groups, of kLanes of these
};

}  // namespace turnscan::sampling
