#include <turnscan/evaluation/inspection/measurement.hpp>

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <turnscan/geometry/mesh/vertex_neighbours.hpp>

namespace turnscan {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

Result<SurfacePoint> surface_at(const MeasuredSurface& surface, const Vec3d& place) {
  if (const auto at = nearest_surface_point(*surface.mesh, place)) return *at;
  return fail(ErrorCode::kTooFewPoints, "measure: the model has no surface there");
}

/// The vertices reachable along edges from a place without leaving the patch.
std::vector<Vec3d> patch_of_mesh(const TriangleMesh& mesh, const SurfacePoint& at, double patch_m) {
  const mesh::VertexNeighbours neighbours(mesh);
  std::vector<std::uint8_t> known(mesh.vertices.size(), 0);
  std::vector<std::uint32_t> open;
  std::vector<Vec3d> out;
  const auto reach = [&](std::uint32_t v) {
    const Vec3d p = mesh.vertices[v].cast<double>();
    if (known[v] != 0 || !((p - at.point).norm() <= patch_m)) return;
    known[v] = 1;
    open.push_back(v);
    out.push_back(p);
  };
  for (const std::uint32_t v : mesh.triangles[at.triangle]) reach(v);
  while (!open.empty()) {
    const std::uint32_t v = open.back();
    open.pop_back();
    for (const std::uint32_t other : neighbours.of(v)) reach(other);
  }
  if (out.size() >= 3) return out;
  out.clear();
  for (const std::uint32_t v : mesh.triangles[at.triangle])
    out.push_back(mesh.vertices[v].cast<double>());
  return out;
}

Result<> measure_plane(const MeasuredSurface& surface, Measurement& out) {
  std::vector<Vec3d> patch;
  if (surface.mesh) {
    TURNSCAN_ASSIGN(const SurfacePoint at, surface_at(surface, out.places[0]));
    patch = patch_of_mesh(*surface.mesh, at, surface.patch_m);
  } else {
    for (const Vec3f& p : surface.points)
      if ((p.cast<double>() - out.places[0]).norm() <= surface.patch_m)
        patch.push_back(p.cast<double>());
  }
  const auto fit = plane_through(patch);
  if (!fit) {
    return fail(ErrorCode::kTooFewPoints,
                "plane: {} points within {:g} mm of the place do not make one; take a larger patch",
                patch.size(), 1e3 * surface.patch_m);
  }
  out.plane = *fit;
  out.value = fit->flatness_m;
  return {};
}

Result<> measure_thickness(const MeasuredSurface& surface, Measurement& out) {
  if (!surface.mesh) {
    return fail(ErrorCode::kUnsupported,
                "thickness: a cloud has no walls; reconstruct it, or choose a mesh");
  }
  TURNSCAN_ASSIGN(const SurfacePoint at, surface_at(surface, out.places[0]));
  const auto thick = wall_thickness(*surface.mesh, at);
  if (!thick) {
    return fail(ErrorCode::kTooFewPoints,
                "thickness: behind this place the mesh is open; click beside it");
  }
  out.value = *thick;
  out.places = {at.point, at.point - *thick * at.normal};
  return {};
}

Result<> take_value(MeasurementKind kind, const MeasuredSurface& surface, Measurement& out) {
  const auto& places = out.places;
  switch (kind) {
    case MeasurementKind::kDistance:
      out.value = (places[1] - places[0]).norm();
      return {};
    case MeasurementKind::kAngle: {
      const auto angle = angle_at(places[1], places[0], places[2]);
      if (!angle) return fail(ErrorCode::kTooFewPoints, "angle: two of the places are the same");
      out.value = *angle;
      return {};
    }
    case MeasurementKind::kCircle: {
      const auto circle = circle_through(places[0], places[1], places[2]);
      if (!circle)
        return fail(ErrorCode::kTooFewPoints,
                    "circle: the three places lie on a line; click again");
      out.circle = *circle;
      out.value = 2.0 * circle->radius_m;
      return {};
    }
    case MeasurementKind::kPlane:
      return measure_plane(surface, out);
    case MeasurementKind::kThickness:
      return measure_thickness(surface, out);
    case MeasurementKind::kDeviation:
      break;
  }
  throw std::invalid_argument("measure: a deviation is measured by SignedDistance");
}

/// Quoted if the table's format requires it.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::string_view name_of(MeasurementKind kind) {
  constexpr std::array<std::string_view, 6> kNames{"deviation", "distance", "angle",
                                                   "circle",    "plane",    "thickness"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::size_t places_of(MeasurementKind kind) {
  if (kind == MeasurementKind::kDistance) return 2;
  return kind == MeasurementKind::kAngle || kind == MeasurementKind::kCircle ? 3 : 1;
}

Result<Measurement> measure(MeasurementKind kind, const std::vector<Vec3d>& places,
                            const MeasuredSurface& surface) {
  if (places.size() != places_of(kind))
    throw std::invalid_argument("measure: another number of places");
  Measurement out;
  out.kind = kind;
  out.places = places;
  TURNSCAN_TRY(take_value(kind, surface, out));
  return out;
}

std::string measurement_text(const Measurement& m) {
  switch (m.kind) {
    case MeasurementKind::kAngle:
      return fmt::format("{:.2f}°", kDegrees * m.value);
    case MeasurementKind::kCircle:
      return fmt::format("Ø {:.3f} mm", 1e3 * m.value);
    case MeasurementKind::kPlane:
      return fmt::format("flat to {:.3f} mm, rms {:.3f} mm, {} points", 1e3 * m.value,
                         1e3 * m.plane.rms_m, m.plane.count);
    case MeasurementKind::kDeviation:
      return fmt::format("{:+.3f} mm", 1e3 * m.value);
    case MeasurementKind::kDistance:
    case MeasurementKind::kThickness:
      break;
  }
  return fmt::format("{:.3f} mm", 1e3 * m.value);
}

std::string measurements_csv(std::span<const Measurement> measurements) {
  std::string text = "number,kind,model,value,unit,rms_mm,x_mm,y_mm,z_mm,nx,ny,nz,places_mm\n";
  const auto out = std::back_inserter(text);
  std::size_t number = 0;
  for (const Measurement& m : measurements) {
    const bool angle = m.kind == MeasurementKind::kAngle;
    const bool circle = m.kind == MeasurementKind::kCircle,
               plane = m.kind == MeasurementKind::kPlane;
    const Vec3d at = 1e3 * (circle ? m.circle.center : plane ? m.plane.point : m.places.front());
    fmt::format_to(out, "{},{},{},{:.5f},{},{},{:.4f},{:.4f},{:.4f}", ++number, name_of(m.kind),
                   cell(m.of), (angle ? kDegrees : 1e3) * m.value, angle ? "deg" : "mm",
                   plane ? fmt::format("{:.5f}", 1e3 * m.plane.rms_m) : "", at.x(), at.y(), at.z());
    const Vec3d n = circle ? m.circle.normal : m.plane.normal;
    text += circle || plane ? fmt::format(",{:.6f},{:.6f},{:.6f},", n.x(), n.y(), n.z()) : ",,,,";
    for (std::size_t i = 0; i < m.places.size(); ++i) {
      const Vec3d p = 1e3 * m.places[i];
      fmt::format_to(out, "{}{:.4f} {:.4f} {:.4f}", i == 0 ? "" : "; ", p.x(), p.y(), p.z());
    }
    text += "\n";
  }
  return text;
}

}  // namespace turnscan
