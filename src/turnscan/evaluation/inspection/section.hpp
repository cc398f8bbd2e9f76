#pragma once
// Where a plane meets a mesh: contours, their area, and drawings of them.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/mesh/clip.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Points in metres. A closed one does not repeat its first point.
struct Contour {
  std::vector<Vec3d> points;
  bool closed = false;
};

struct Section {
  Vec3d normal = Vec3d::UnitY();  ///< of the plane, unit length
  double offset_m = 0.0;          ///< the plane is normal . p = offset_m
  /// Seen against the normal, what the mesh encloses is on the left: outlines turn
  /// counter-clockwise, holes clockwise.
  std::vector<Contour> contours;
  double area_m2 = 0.0;   ///< enclosed by the closed contours, without their holes
  double length_m = 0.0;  ///< of all contours
  std::size_t open = 0;   ///< contours that end at a hole of the mesh
};

/// Every contour of a closed, consistently oriented mesh is closed; a contour that shrinks to a
/// point or a line is left out. Triangles meet where they share vertices. Fails with kFormat as
/// validate_mesh(), kInvalidOption when the normal is not of unit length.
Result<Section> cross_section(const TriangleMesh& mesh, const HalfSpace& plane);

/// Triangles over what the closed contours enclose, facing against the normal: they close the part
/// of the mesh with normal . p >= offset_m. Nothing enclosed: an empty mesh. Fails with kLibrary
/// where contours touch or cross each other.
Result<TriangleMesh> section_cap(const Section& section);

/// Axes right and up of the drawings: with the normal they are right-handed, and up is +y as far as
/// the plane allows, else -z.
std::pair<Vec3d, Vec3d> drawing_axes(const Vec3d& normal);

/// A drawing in millimetres, one unit a millimetre, as DXF (release 12: POLYLINE entities, which
/// every program reads) or SVG (true to size; what is enclosed is filled). The origin of the DXF is
/// the point of the plane nearest to the origin of the model. Fail with kTooFewPoints when there is
/// no contour.
Result<std::string> section_dxf(const Section& section);
Result<std::string> section_svg(const Section& section);

}  // namespace turnscan
