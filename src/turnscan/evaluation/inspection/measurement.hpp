#pragma once
// Measurements that are kept: made from a few places that a person clicked, and written as a table.

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

/// As in the table: "distance".
std::string_view name_of(MeasurementKind kind);
/// How many places it takes: 1 to 3. The corner of an angle is the second.
std::size_t places_of(MeasurementKind kind);

struct Measurement {
  MeasurementKind kind = MeasurementKind::kDistance;
  std::string of;             ///< the model's name
  std::vector<Vec3d> places;  ///< metres, as clicked; of a thickness also where the wall ends
  /// Deviation, distance, diameter, flatness or thickness in metres; an angle in radians.
  double value = 0.0;
  Circle circle;   ///< of kCircle
  PlaneFit plane;  ///< of kPlane
};

/// What a measurement is made on.
struct MeasuredSurface {
  const TriangleMesh* mesh = nullptr;  ///< or nullptr: of a cloud
  std::span<const Vec3f> points;       ///< the mesh's vertices, or the cloud
  double patch_m = 0.005;              ///< a plane is fitted to the surface within this distance
};

/// Of every kind but kDeviation, whose value is SignedDistance::at() (std::invalid_argument, as for
/// another number of places than places_of()). A plane is fitted to the vertices that hang together
/// with the place within patch_m of it, of a cloud to all points there; where there are fewer than
/// 3, to the triangle. Fails with kTooFewPoints when the places or points do not determine it, with
/// kUnsupported for the thickness of a cloud.
Result<Measurement> measure(MeasurementKind kind, const std::vector<Vec3d>& places,
                            const MeasuredSurface& surface);

/// "12.345 mm", "90.00°"; of a circle and a plane with the rest of what is known.
std::string measurement_text(const Measurement& measurement);

/// A line a measurement: number,kind,model,value,unit,rms_mm,x_mm,y_mm,z_mm,nx,ny,nz,places_mm. The
/// place is the centre of a circle or plane, else the first that was clicked; the normal is empty
/// where there is none; places_mm lists all, "x y z; x y z".
std::string measurements_csv(std::span<const Measurement> measurements);

}  // namespace turnscan
