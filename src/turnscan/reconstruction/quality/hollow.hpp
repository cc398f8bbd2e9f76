#pragma once
// How much of a mesh lies behind the floor of a hollow that no view reached: a vessel's inside.

#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::quality {

/// The floor of a hollow is unknown where it was not measured, and where no view would see it
/// lower_by_m farther down: it lies as deep as rays over the rim reach. If that is most of the
/// floor, all below it is unknown; where the wall about it is thinner than the opening is wide, so
/// is what lies inside a wall as thick beside that (the belly of a vase). Hollows less deep than
/// lower_by_m are ignored. mesh: closed, +Y up, metres; evidence: per triangle; views in the mesh's
/// frame.
double unknown_volume_m3(const TriangleMesh& mesh, std::span<const Evidence> evidence,
                         std::span<const views::DepthView> views, double lower_by_m);

}  // namespace turnscan::quality
