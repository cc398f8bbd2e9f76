#pragma once
// Surface that nothing measured, as a thin plate that continues what is around it.

#include <functional>
#include <optional>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh_refinement {

struct PlateClosing {
  /// Whether surface may be invented at a place: no view has looked there. Called from many
  /// threads.
  std::function<bool(const Vec3f&)> unseen;
  /// Whether surface there stands on a platter: it stays, and no other goes there.
  std::function<bool(const Vec3f&)> stands = [](const Vec3f&) { return false; };
  /// Of a platter at y = 0: where nothing was measured below this height the object may rest on it.
  std::optional<double> rests_below_m = std::nullopt;
  double cell_m = 0.001;  ///< the voxel size; unseen() is as coarse
};

/// Moves vertices with less than a fiftieth of the typical support, and small weak groups of others
/// in their midst in proportion to their support, to where they continue the rest
/// tangentially with least bending (relax()), but not farther than where no view looked: what
/// would pass on stays at the border, and the others are solved again. What would pass
/// through other surface (winding_faults()) does not move, and what is around it less far; where
/// that does not help, all that hangs together with it moves half as far, or not. An object that
/// would tip over as it touches the platter touches it in one or more places more. Fails with
/// kCancelled, and as relax() does.
Result<> close_as_plate(TriangleMesh& mesh, const std::vector<float>& support,
                        const PlateClosing& closing, const RunContext& context);

}  // namespace turnscan::mesh_refinement
