#pragma once
// Plane sections of a mesh: contours, their area, and drawings of them.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/mesh/clip.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Points in metres. A closed contour does not repeat its first point.
struct Contour {
  std::vector<Vec3d> points;
  bool closed = false;
};

struct Section {
  Vec3d normal = Vec3d::UnitY();  ///< of the plane, unit length
  double offset_m = 0.0;          ///< the plane is normal . p = offset_m
  /// Viewed against the normal, the interior of the mesh is on the left: outlines are
  /// counter-clockwise, holes clockwise.
  std::vector<Contour> contours;
  double area_m2 = 0.0;   ///< enclosed by the closed contours, without their holes
  double length_m = 0.0;  ///< of all contours
  std::size_t open = 0;   ///< number of contours that end at a hole of the mesh
};

/// Every contour of a closed, consistently oriented mesh is closed; contours that shrink to a point
/// or a line are omitted. Triangles are connected where they share vertices. Fails with kFormat as
/// validate_mesh(), with kInvalidOption if the normal is not of unit length.
Result<Section> cross_section(const TriangleMesh& mesh, const HalfSpace& plane);

/// Triangles over the area that the closed contours enclose, facing against the normal: they close
/// the part of the mesh with normal . p >= offset_m. If nothing is enclosed: an empty mesh. Fails
/// with kLibrary if contours touch or cross each other.
Result<TriangleMesh> section_cap(const Section& section);

/// Right and up axes of the drawings: right-handed with the normal; up is +y as far as the plane
/// allows, else -z.
std::pair<Vec3d, Vec3d> drawing_axes(const Vec3d& normal);

/// A drawing in millimetres, one unit per millimetre, as DXF (release 12: POLYLINE entities, which
/// every program reads) or SVG (true to scale; the enclosed area is filled). The origin of the DXF
/// is the point of the plane nearest to the origin of the model. Fail with kTooFewPoints if there
/// is no contour.
Result<std::string> section_dxf(const Section& section);
Result<std::string> section_svg(const Section& section);

}  // namespace turnscan
