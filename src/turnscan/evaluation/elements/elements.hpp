#pragma once
// Fits elements to a mesh and relates them, as coordinate metrology does: spheres, cylinders,
// cones, planes, circles and lines with form, deviation from the nominal and uncertainty;
// intersections, distances and angles; coordinates in a datum frame by 3-2-1.
// docs/reference/evaluation.md has the definitions.

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/evaluation/elements/shape.hpp>
#include <vector>

namespace turnscan {

/// An element to be fitted, or the intersection of two that come before it in the list.
struct ElementRequest {
  std::string name;
  elements::Shape nominal;  ///< in the mesh's frame; of an intersection not used
  /// Taken are points within this distance of the shape. Metres.
  double within_m = 0.0;
  /// Taken are points between these corners.
  Vec3d low_m = Vec3d::Constant(-std::numeric_limits<double>::infinity());
  Vec3d high_m = Vec3d::Constant(std::numeric_limits<double>::infinity());
  std::optional<std::array<std::size_t, 2>> of;  ///< intersection of these
};

struct RelationRequest {
  std::string name;
  bool angle = false;  ///< else the distance
  std::array<std::size_t, 2> of{};
};

/// Elements of the datum frame: z = 0 is the plane, with z along its normal; x is along the line
/// (or the trace of a plane), where y = 0; at the point (or where x meets a plane) x = 0.
struct DatumRequest {
  std::size_t plane = 0, line = 0, point = 0;
};

struct ElementPlan {
  std::vector<ElementRequest> elements;
  std::vector<RelationRequest> relations;
  std::optional<DatumRequest> datum;
};

/// A value in SI units. sigma: its standard deviation, nullopt: not known.
struct ElementFigure {
  std::string name;  ///< "x", "diameter", ...
  Quantity quantity = Quantity::kLength;
  double value = 0.0;
  std::optional<double> sigma;
  double nominal = 0.0;

  double deviation() const { return value - nominal; }
};

struct MeasuredElement {
  std::string name;
  elements::Kind kind = elements::Kind::kPlane;
  std::size_t points = 0;              ///< 0 for an intersection
  double form_m = 0.0, rms_m = 0.0;    ///< range and rms of the points' distances from it
  std::vector<ElementFigure> figures;  ///< in the datum frame, if there is one
};

struct MeasuredRelation {
  std::array<std::string, 2> of;
  ElementFigure figure;  ///< its name is the relation's
  bool angle = false;
};

struct ElementReport {
  std::vector<MeasuredElement> elements;
  std::vector<MeasuredRelation> relations;
  std::optional<Pose> T_datum_mesh;
};

/// Fits all elements of the plan, whose indices must be valid, to a mesh. Takes the points near the
/// nominal shape whose normals agree with it to 45 deg, fits, and repeats this with the fitted
/// shape until the points stay the same: vertices, for a circle or line the crossings of the mesh's
/// edges with the nominal's plane. Begins the phase "elements". Fails with kFormat as
/// validate_mesh(), with kTooFewPoints if the points do not determine an element, with
/// kInvalidOption if elements are parallel that should cross, or have no direction to measure; the
/// message names the element. kCancelled.
Result<ElementReport> measure_elements(const TriangleMesh& mesh, const ElementPlan& plan,
                                       const RunContext& context);

}  // namespace turnscan
