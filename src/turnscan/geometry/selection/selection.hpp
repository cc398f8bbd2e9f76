#pragma once
// Selected parts of a mesh or cloud, and operations on selections.

#include <cstdint>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// One flag per triangle of a mesh, or per point of a cloud: non-zero if it is selected.
using Selection = std::vector<std::uint8_t>;

enum class SelectHow { kReplace, kAdd, kSubtract };

/// Changes `selection` by what was picked. An empty selection is treated as one of the size of
/// `picked` with nothing selected; throws std::invalid_argument for other sizes that differ.
void change_selection(Selection& selection, const Selection& picked, SelectHow how);
Selection inverted(const Selection& selection);
std::size_t count_selected(const Selection& selection);

/// Adds all triangles that share a vertex with a selected one. `selection` has one flag per
/// triangle, also below (else std::invalid_argument).
Selection grown(const TriangleMesh& mesh, const Selection& selection);
/// Removes the selected triangles that share a vertex with an unselected one.
Selection shrunk(const TriangleMesh& mesh, const Selection& selection);
/// All triangles of the pieces (which share no vertex) that contain a selected triangle.
Selection connected(const TriangleMesh& mesh, const Selection& selection);

/// Pieces of a mesh or cloud that are small compared to its largest one, such as remains of a cut
/// or stray measurements.
struct SmallPieces {
  Selection parts;
  std::size_t pieces = 0;
};
/// Pieces whose area is below `share` (0 to 1) of the largest piece's.
SmallPieces small_pieces(const TriangleMesh& mesh, double share);

/// The same for points, which are neighbours within reach_m of each other. Points that are not
/// finite have no neighbours.
Selection grown(std::span<const Vec3f> points, const Selection& selection, double reach_m);
Selection shrunk(std::span<const Vec3f> points, const Selection& selection, double reach_m);
Selection connected(std::span<const Vec3f> points, const Selection& selection, double reach_m);

/// Pieces with fewer points than `share` of those of the largest piece.
SmallPieces small_pieces(std::span<const Vec3f> points, double share, double reach_m);

/// Twice the median distance of points to their nearest neighbours, for up to 2000 of them: a
/// suitable reach for the functions above. Metres; 0 for fewer than 2 points.
double usual_reach(std::span<const Vec3f> points);

}  // namespace turnscan
