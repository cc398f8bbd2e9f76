#pragma once

#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Cuts a closed, 2-manifold, oriented surface along loops of edges no longer than longest_m that
/// pass only through vertices with cuttable[v] != 0 (one entry per vertex), and closes both sides
/// of each cut with a fan: a thin handle is severed, a narrow tunnel gets a wall. Only loops that
/// do not separate the surface are cut, so no piece comes off, and each cut lowers the genus by one
/// (topological noise: Guskov and Wood 2001; loops by a tree and a cotree: Erickson and Whittlesey
/// 2005). Appends vertices: copies of those along the cuts and a centre for each fan, with colours
/// and normals. Returns the number of cuts. Fails with kFormat for other meshes, kCancelled.
Result<std::size_t> cut_handles(TriangleMesh& mesh, std::vector<std::uint8_t> cuttable,
                                double longest_m, const RunContext& context);

}  // namespace turnscan
