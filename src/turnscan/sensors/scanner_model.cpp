#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/sensors/scanner_model.hpp>

namespace turnscan {

namespace {

template <class... Args>
tl::unexpected<Error> refuse(const std::string& name, fmt::format_string<Args...> format,
                             Args&&... args) {
  return fail(ErrorCode::kInvalidOption, "scanner {}: {}", name,
              fmt::format(format, std::forward<Args>(args)...));
}

std::string millimetres(double metres) { return format_quantity(metres, Quantity::kLength); }

/// Focal length that spreads `samples` over an angle, in samples.
double focal_length(int samples, double tangent_of_half) { return 0.5 * samples / tangent_of_half; }

Result<> check_parameters(const ScannerParameters& p) {
  ScannerParameters copy = p;
  if (auto good = describe(copy).append(describe(copy.noise)).check(); !good)
    return refuse(p.name, "{}", good.error().message);
  if (p.rows < 1 || (p.kind == ScannerKind::kMatrix && p.columns < 1))
    return refuse(p.name, "it has {} x {} samples; give it rows and columns of at least 1",
                  p.columns, p.rows);
  if (p.kind == ScannerKind::kLine && p.columns > 1)
    return refuse(p.name, "a line scanner has its samples in rows; columns = {} is not for it",
                  p.columns);
  const bool focal = p.fx.has_value() || p.fy.has_value();
  if (p.fov_y_rad.has_value() == focal)
    return refuse(p.name, "give it either vertical-fov or the focal length fy, and not both");
  if (focal && p.aspect)
    return refuse(p.name, "aspect goes with vertical-fov; with a focal length write fx and fy");
  return {};
}

void set_focal_lengths(const ScannerParameters& p, CameraIntrinsics& camera) {
  if (!p.fov_y_rad) {
    camera.fy = p.fy.value_or(p.fx.value_or(0.0));
    camera.fx = p.fx.value_or(camera.fy);
    return;
  }
  const double tangent = std::tan(0.5 * *p.fov_y_rad);
  camera.fy = focal_length(camera.height, tangent);
  camera.fx = p.aspect ? focal_length(camera.width, *p.aspect * tangent) : camera.fy;
}

}  // namespace

OptionTable describe(ScannerParameters& p) {
  OptionTable table;
  table.text("name", p.name, "Name of the scanner, for people.")
      .choice("kind", p.kind, {"matrix", "line"},
              "matrix: a depth camera; line: a profile scanner, whose samples run from top to "
              "bottom of its view.")
      .choice("sensing", p.sensing,
              {"ideal", "time-of-flight", "structured-light", "stereo", "laser-line"},
              "How it measures, which decides about its noise.")
      .number("near", p.near_m, Quantity::kLength, {0.0, 1000.0},
              "Nearest distance that it measures, along its viewing axis.")
      .number("far", p.far_m, Quantity::kLength, {0.0, 1000.0}, "Farthest distance.")
      .number("columns", p.columns, {0, 65535},
              "Samples across the view of a matrix scanner, counted at the nearest distance.")
      .number("rows", p.rows, {0, 65535}, "Samples from top to bottom, or along the line.")
      .number("vertical-fov", p.fov_y_rad, Quantity::kAngle,
              {0.01 * kRadiansPerDegree, 179.0 * kRadiansPerDegree},
              "Angle from the top to the bottom of the view; auto: from the focal length.")
      .number("aspect", p.aspect, Quantity::kNone, {1e-3, 1e3},
              "Aspect ratio of the view, width over height; auto: that of square samples.")
      .number("fx", p.fx, Quantity::kNone, {1e-3, 1e6},
              "Focal length in samples, across; auto: as fy.")
      .number("fy", p.fy, Quantity::kNone, {1e-3, 1e6}, "Focal length in samples, downwards.")
      .number("cx", p.cx, Quantity::kNone, {-1e6, 1e6},
              "Column of the lens's centre, the first one being 0; auto: the middle.")
      .number("cy", p.cy, Quantity::kNone, {-1e6, 1e6}, "Row of the lens's centre.")
      .number("k1", p.k1, Quantity::kNone, {-100.0, 100.0}, "Radial distortion of the lens.")
      .number("k2", p.k2, Quantity::kNone, {-100.0, 100.0}, "Radial distortion, fourth power.")
      .number("p1", p.p1, Quantity::kNone, {-100.0, 100.0}, "Tangential distortion.")
      .number("p2", p.p2, Quantity::kNone, {-100.0, 100.0}, "Tangential distortion.")
      .number("k3", p.k3, Quantity::kNone, {-100.0, 100.0}, "Radial distortion, sixth power.")
      .number("k4", p.k4, Quantity::kNone, {-100.0, 100.0},
              "Coefficient of the rational model, which divides by 1 + k4 r^2 + k5 r^4 + k6 r^6.")
      .number("k5", p.k5, Quantity::kNone, {-100.0, 100.0}, "Its coefficient of the fourth power.")
      .number("k6", p.k6, Quantity::kNone, {-100.0, 100.0}, "Its coefficient of the sixth power.")
      .number("baseline", p.baseline_m, Quantity::kLength, {0.0, 10.0},
              "Distance between emitter and receiver.")
      .number("baseline-direction", p.baseline_direction_rad, Quantity::kAngle,
              {-360.0 * kRadiansPerDegree, 360.0 * kRadiansPerDegree},
              "Where the emitter lies as the scanner sees it (of a line scanner: the receiver): "
              "0deg to the right, 90deg above.")
      .number("max-incidence", p.max_incidence_rad, Quantity::kAngle,
              {0.0, 90.0 * kRadiansPerDegree},
              "Surfaces seen under a larger angle from their normal give no sample.")
      .number("depth-unit", p.depth_unit_m, Quantity::kLength, {1e-6, 0.1},
              "Step of the depth images.");
  return table;
}

Result<> ScannerModel::check() const {
  if (!(near_m >= 0.0 && near_m < far_m && std::isfinite(far_m)))
    return refuse(name, "near = {} is not below far = {}", millimetres(near_m), millimetres(far_m));
  if (camera.width < 1 || camera.height < 1)
    return refuse(name, "it has {} x {} samples; give it at least one", camera.width,
                  camera.height);
  if (auto good = camera.check(); !good) return refuse(name, "{}", good.error().message);
  if (kind == ScannerKind::kLine && camera.width != 1)
    return refuse(name, "a line is 1 sample wide, not {}", camera.width);
  if (!emitter_m.allFinite() || !receiver_m.allFinite())
    return refuse(name, "the place of its emitter or receiver is not finite");
  if (!(max_incidence_rad >= 0.0 && max_incidence_rad <= 90.0 * kRadiansPerDegree + 1e-12))
    return refuse(name, "max-incidence = {} is outside 0deg to 90deg",
                  format_quantity(max_incidence_rad, Quantity::kAngle));
  if (!(depth_unit_m > 0.0 && std::isfinite(depth_unit_m)))
    return refuse(name, "depth-unit = {} is not positive", millimetres(depth_unit_m));
  return {};
}

Result<ScannerModel> scanner_model(const ScannerParameters& p) {
  TURNSCAN_TRY(check_parameters(p));
  ScannerModel model;
  model.name = p.name;
  model.kind = p.kind;
  model.sensing = p.sensing;
  model.near_m = p.near_m;
  model.far_m = p.far_m;
  model.max_incidence_rad = p.max_incidence_rad;
  model.depth_unit_m = p.depth_unit_m;
  model.noise = p.noise;
  CameraIntrinsics& camera = model.camera;
  camera.width = p.kind == ScannerKind::kLine ? 1 : p.columns;
  camera.height = p.rows;
  set_focal_lengths(p, camera);
  camera.cx = p.cx.value_or(0.5 * (camera.width - 1));
  camera.cy = p.cy.value_or(0.5 * (camera.height - 1));
  camera.distortion = {p.k1, p.k2, p.p1, p.p2, p.k3, p.k4, p.k5, p.k6};
  // Seen by the scanner y points down, so that 90 deg is -y.
  const Vec3d eye = p.baseline_m * Vec3d(std::cos(p.baseline_direction_rad),
                                         -std::sin(p.baseline_direction_rad), 0.0);
  (p.kind == ScannerKind::kLine ? model.receiver_m : model.emitter_m) = eye;
  TURNSCAN_TRY(model.check());
  return model;
}

}  // namespace turnscan
