#pragma once
// Parts of a mesh or of a cloud that were chosen, and how such a choice is changed.

#include <cstdint>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// One flag a triangle of a mesh, or a point of a cloud: not 0 when it is selected.
using Selection = std::vector<std::uint8_t>;

enum class SelectHow { kReplace, kAdd, kSubtract };

/// Changes `selection` by what was picked. An empty selection counts as one of the size of `picked`
/// with nothing in it; other sizes that differ throw std::invalid_argument.
void change_selection(Selection& selection, const Selection& picked, SelectHow how);
Selection inverted(const Selection& selection);
std::size_t count_selected(const Selection& selection);

/// With all triangles that share a vertex with a selected one. `selection` has one flag a triangle,
/// as below (else std::invalid_argument).
Selection grown(const TriangleMesh& mesh, const Selection& selection);
/// Without the selected triangles that share a vertex with one that is not selected.
Selection shrunk(const TriangleMesh& mesh, const Selection& selection);
/// All triangles of the pieces (which share no vertex) that have a selected triangle.
Selection connected(const TriangleMesh& mesh, const Selection& selection);

/// Pieces of a mesh or cloud that are small beside its largest one: what is left when a part is cut
/// away, or was measured in the air.
struct SmallPieces {
  Selection parts;
  std::size_t pieces = 0;
};
/// Those whose area is below `share` (0 to 1) of the largest piece's.
SmallPieces small_pieces(const TriangleMesh& mesh, double share);

/// The same of points, of which those within reach_m of each other are neighbours. Points that are
/// not finite are neighbours of none.
Selection grown(std::span<const Vec3f> points, const Selection& selection, double reach_m);
Selection shrunk(std::span<const Vec3f> points, const Selection& selection, double reach_m);
Selection connected(std::span<const Vec3f> points, const Selection& selection, double reach_m);

/// Those with fewer points than `share` of those of the largest piece.
SmallPieces small_pieces(std::span<const Vec3f> points, double share, double reach_m);

/// Twice the median distance of points to their nearest neighbours, of up to 2000 of them: a reach
/// for the functions above. Metres; 0 for fewer than 2 points.
double usual_reach(std::span<const Vec3f> points);

}  // namespace turnscan
