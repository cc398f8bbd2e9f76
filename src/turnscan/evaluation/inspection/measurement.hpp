#pragma once
// Stored measurements from a few points picked by the user, and their table.

#include <array>
#include <span>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/evaluation/inspection/shapes.hpp>
#include <vector>

namespace turnscan {

enum class MeasurementKind { kDeviation, kDistance, kAngle, kCircle, kPlane, kThickness };
inline constexpr std::array kMeasurementKinds{
    MeasurementKind::kDeviation, MeasurementKind::kDistance, MeasurementKind::kAngle,
    MeasurementKind::kCircle,    MeasurementKind::kPlane,    MeasurementKind::kThickness};

/// Name in the table, e.g. "distance".
std::string_view name_of(MeasurementKind kind);
/// Number of points that it needs: 1 to 3. The corner of an angle is the second.
std::size_t places_of(MeasurementKind kind);

struct Measurement {
  MeasurementKind kind = MeasurementKind::kDistance;
  std::string of;             ///< the model's name
  std::vector<Vec3d> places;  ///< metres, as picked; for a thickness also the point where the wall
                              ///< ends
  /// Deviation, distance, diameter, flatness or thickness in metres; an angle in radians.
  double value = 0.0;
  Circle circle;   ///< for kCircle
  PlaneFit plane;  ///< for kPlane
};

/// The model that is measured.
struct MeasuredSurface {
  const TriangleMesh* mesh = nullptr;  ///< nullptr for a cloud
  std::span<const Vec3f> points;       ///< the mesh's vertices, or the cloud
  double patch_m = 0.005;              ///< a plane is fitted to the surface within this distance
};

/// Measures any kind but kDeviation, whose value is SignedDistance::at() (std::invalid_argument, as
/// for a number of places other than places_of()). A plane is fitted to the vertices within patch_m
/// of the place that are connected with it, for a cloud to all points there; if there are fewer
/// than 3, to the triangle. Fails with kTooFewPoints if the places or points do not determine it,
/// with kUnsupported for the thickness of a cloud.
Result<Measurement> measure(MeasurementKind kind, const std::vector<Vec3d>& places,
                            const MeasuredSurface& surface);

/// "12.345 mm", "90.00°"; for a circle and a plane with the other known values.
std::string measurement_text(const Measurement& measurement);

/// One line per measurement: number,kind,model,value,unit,rms_mm,x_mm,y_mm,z_mm,nx,ny,nz,places_mm.
/// The position is the centre of a circle or plane, else the first picked point; the normal is
/// empty if there is none; places_mm lists all, "x y z; x y z".
std::string measurements_csv(std::span<const Measurement> measurements);

}  // namespace turnscan
