#pragma once
// A surface that spans one boundary loop: the steps of fill_holes().

#include <cstdint>
#include <functional>
#include <turnscan/core/pose.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <vector>

namespace turnscan::mesh {

/// Whether an edge between two vertices of the loop (by index in it) is already part of the mesh.
using EdgeTaken = std::function<bool(std::uint32_t, std::uint32_t)>;

struct HolePatch {
  std::uint32_t loop_size = 0;      ///< points [0, loop_size) are the loop, in order
  std::vector<Vec3d> points;        ///< metres; those beyond the loop are new
  std::vector<Triangle> triangles;  ///< oriented along the loop's edges
  std::vector<Triangle> parents;    ///< per new point, three earlier points that surround it
};

/// Triangulates a loop of at least three points, without new points if possible; else as a fan
/// around their mean. No edge inside the patch is one that is taken.
HolePatch triangulate_loop(std::vector<Vec3d> loop, const EdgeTaken& taken);

/// Inserts points until triangles are about as large as scale (desired edge length, one per loop
/// point, metres) requests, and flips edges towards Delaunay. At most some 300,000 triangles:
/// scales that would need more are enlarged.
void refine_patch(HolePatch& patch, std::vector<double> scale, const EdgeTaken& taken);

}  // namespace turnscan::mesh
