#pragma once
// Closes unmeasured surface as a thin plate that continues its surroundings.

#include <functional>
#include <optional>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh_refinement {

struct PlateClosing {
  /// Whether surface may be invented at a point: no view observed it. Called from many threads.
  std::function<bool(const Vec3f&)> unseen;
  /// Whether surface at a point stands on a platter: it is kept, and no other moves there.
  std::function<bool(const Vec3f&)> stands = [](const Vec3f&) { return false; };
  /// For a platter at y = 0: below this height the object may rest on it where nothing was
  /// measured.
  std::optional<double> rests_below_m = std::nullopt;
  double cell_m = 0.001;  ///< the voxel size, which is also the resolution of unseen()
};

/// Moves vertices with less than a fiftieth of the typical support, and small weak groups of others
/// among them in proportion to their support, to where they continue the rest tangentially with
/// least bending (relax()), but not beyond the space that no view observed: vertices that would
/// leave it stay at the border, and the others are solved again. Vertices that would cross other
/// surface (self_intersections()) do not move, and those around them move less; if that does not
/// help, everything connected with them moves half as far, or not at all. An object that would tip
/// over as it touches the platter gets one or more additional contact points. Fails with
/// kCancelled, and as relax() does.
Result<> close_as_plate(TriangleMesh& mesh, const std::vector<float>& support,
                        const PlateClosing& closing, const RunContext& context);

}  // namespace turnscan::mesh_refinement
