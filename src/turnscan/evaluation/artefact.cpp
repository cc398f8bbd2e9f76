#include <turnscan/evaluation/artefact.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <turnscan/core/angles.hpp>
#include <turnscan/evaluation/artefact_search.hpp>
#include <turnscan/evaluation/plane_outline.hpp>
#include <turnscan/evaluation/robust_fit.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/search/sample.hpp>

namespace turnscan {

namespace {

using artefact::Deviations;
using artefact::Plane;
using artefact::Points;
using artefact::Sphere;
template <class Surface>
using Fit = std::function<std::optional<Surface>(const std::vector<Vec3d>&, const Surface&)>;

constexpr double kRejected = 0.003;   // VDI/VDE 2634 part 2
constexpr double kRejected95 = 0.05;  // ISO 10360-13
constexpr std::size_t kSamples = 200000;
constexpr std::size_t kMinPoints = 100;
constexpr double kMinCovered = 0.05;  // of a sphere; one view sees about a third
constexpr double kReach = 0.15;  // relative to a ball's radius: points farther away are not on the
                                 // ball
constexpr double kPlateReach_m = 5e-3;
constexpr double kBandSigmas = 6.0;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The points on a surface, and the number of points near it but beyond the band.
struct Selection {
  std::vector<Vec3d> points;
  std::size_t left_out = 0;
};

/// Whether a point may be used, apart from its distance from the surface.
template <class Surface>
using Usable = std::function<bool(const Vec3d&, const Surface&)>;

/// Points within the band about the surface. Without a given band it is six standard deviations,
/// from the median of the absolute distances of the points within `reach`.
template <class Surface>
Selection select_points(const Points& points, const Surface& surface, double reach,
                        const std::optional<double>& band, const Usable<Surface>& usable) {
  std::vector<Vec3d> near;
  std::vector<double> distances;
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Vec3d& p = points.positions[i];
    const double d = std::abs(surface.distance(p));
    if (d > reach || !points.agrees(i, surface.normal(p)) || !usable(p, surface)) continue;
    near.push_back(p);
    distances.push_back(d);
  }
  Selection selection;
  if (near.empty()) return selection;
  const double limit = band ? *band : kBandSigmas * estimation::kMadToSigma * median_of(distances);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (distances[i] <= limit) selection.points.push_back(near[i]);
  }
  selection.left_out = near.size() - selection.points.size();
  return selection;
}

/// Selects and fits repeatedly until the selection matches the surface that was fitted to it.
template <class Surface>
std::optional<Selection> settle(const Points& points, Surface& surface, double reach,
                                const std::optional<double>& band, const Usable<Surface>& usable,
                                const Fit<Surface>& fit) {
  constexpr int kRounds = 10;
  Selection selection;
  for (int round = 0; round < kRounds; ++round) {
    Selection next = select_points(points, surface, reach, band, usable);
    const bool same = next.points.size() == selection.points.size();
    selection = std::move(next);
    if (selection.points.size() < kMinPoints) return std::nullopt;
    const std::optional<Surface> fitted = fit(selection.points, surface);
    if (!fitted) return std::nullopt;
    surface = *fitted;
    if (same) break;
  }
  return selection;
}

/// The statistics of the fit; `surface` becomes the one after the rejection of VDI/VDE 2634.
template <class Surface>
std::optional<FitFigures> figures_of(const Selection& selection, Surface& surface,
                                     const Fit<Surface>& fit) {
  Surface surface95 = surface;
  const auto all = artefact::fit_rejecting<Surface>(selection.points, kRejected, surface, fit);
  const auto most = artefact::fit_rejecting<Surface>(selection.points, kRejected95, surface95, fit);
  if (!all || !most) return std::nullopt;
  return FitFigures{selection.points.size(), all->rejected, selection.left_out, all->range(),
                    most->range(),           all->sigma()};
}

/// Share of the sphere's surface with points, in 200 parts of equal area.
double covered(const std::vector<Vec3d>& points, const Vec3d& center) {
  constexpr std::size_t kBands = 10, kSectors = 20;
  std::vector<std::uint8_t> has(kBands * kSectors, 0);
  const auto part = [](double share, std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(std::max(0.0, share) * double(n)));
  };
  for (const Vec3d& p : points) {
    const Vec3d d = (p - center).normalized();
    const double around = std::atan2(d.x(), d.z()) / kTurn + 0.5;
    has[part(0.5 * (d.y() + 1.0), kBands) * kSectors + part(around, kSectors)] = 1;
  }
  return double(std::count(has.begin(), has.end(), 1)) / double(has.size());
}

Result<> no_ball(double diameter_m, std::size_t found, std::size_t wanted) {
  const std::string size = format_quantity(diameter_m, Quantity::kLength);
  if (found > 0)
    return fail(ErrorCode::kMissingData,
                "artefact: {} of {} balls of {} was found; scan both of them, or choose --artefact "
                "ball",
                found, wanted, size);
  return fail(ErrorCode::kMissingData,
              "artefact: no ball of {} was found; check --ball-diameter and the unit of the file",
              size);
}

class BallMeasurement {
 public:
  BallMeasurement(const Points& points, const ArtefactOptions& options)
      : points_(points), band_(options.band_m), diameter_m_(*options.diameter_m) {
    if (options.lowest_rad)
      lowest_ = std::sin(*options.lowest_rad);
    else if (!points.normals.empty())
      lowest_ = -0.5;
  }

  /// nullopt if the surface found is not a ball of this size.
  std::optional<BallFigures> measure(Sphere& sphere) const {
    const auto selection =
        settle<Sphere>(points_, sphere, kReach * sphere.radius, band_, usable(), free_);
    if (!selection) return std::nullopt;
    auto fit = figures_of<Sphere>(*selection, sphere, free_);
    if (!fit) return std::nullopt;
    BallFigures ball;
    ball.fit = *fit;
    ball.center_m = sphere.center;
    ball.diameter_m = 2.0 * sphere.radius;
    ball.size_error_m = ball.diameter_m - diameter_m_;
    ball.covered = covered(selection->points, sphere.center);
    const bool right_size = std::abs(ball.size_error_m) < 0.1 * diameter_m_;
    if (!right_size || ball.covered < kMinCovered) return std::nullopt;
    return ball;
  }

  /// Centre of the sphere with the calibrated diameter.
  std::optional<Vec3d> center_with_fixed_diameter(const BallFigures& ball) const {
    Sphere sphere{ball.center_m, ball.diameter_m / 2};
    const auto selection =
        settle<Sphere>(points_, sphere, kReach * sphere.radius, band_, usable(), free_);
    sphere.radius = diameter_m_ / 2;
    if (!selection ||
        !artefact::fit_rejecting<Sphere>(selection->points, kRejected, sphere, fixed_))
      return std::nullopt;
    return sphere.center;
  }

 private:
  Usable<Sphere> usable() const {
    return
        [lowest = lowest_](const Vec3d& p, const Sphere& s) { return s.normal(p).y() >= lowest; };
  }

  const Points& points_;
  std::optional<double> band_;
  double diameter_m_;
  double lowest_ = -1.0;  // minimum y of the direction from the centre
  Fit<Sphere> free_ = [](const std::vector<Vec3d>& p, const Sphere& s) {
    return artefact::fit_sphere(p, s, false);
  };
  Fit<Sphere> fixed_ = [](const std::vector<Vec3d>& p, const Sphere& s) {
    return artefact::fit_sphere(p, s, true);
  };
};

Result<SpacingFigures> spacing_of(const BallMeasurement& measurement,
                                  const std::vector<BallFigures>& balls,
                                  const std::optional<double>& calibrated_m) {
  SpacingFigures spacing;
  spacing.measured_m = (balls[1].center_m - balls[0].center_m).norm();
  if (!calibrated_m) return spacing;
  spacing.error_m = spacing.measured_m - *calibrated_m;
  if (std::abs(*spacing.error_m) > 0.1 * *calibrated_m)
    return fail(ErrorCode::kMissingData,
                "artefact: the two balls that were found are {:.2f} mm apart, not {}; check "
                "--ball-spacing, and that no other ball is in the scan",
                spacing.measured_m * 1e3, format_quantity(*calibrated_m, Quantity::kLength));
  const auto a = measurement.center_with_fixed_diameter(balls[0]);
  const auto b = measurement.center_with_fixed_diameter(balls[1]);
  if (a && b) spacing.error_fixed_diameter_m = (*b - *a).norm() - *calibrated_m;
  return spacing;
}

Result<> measure_balls(const Points& points, const ArtefactOptions& options,
                       const RunContext& context, ArtefactFigures& out) {
  const std::size_t wanted = options.artefact == Artefact::kBallBar ? 2 : 1;
  const BallMeasurement measurement(points, options);
  std::vector<Sphere> found;
  while (found.size() < wanted) {
    auto sphere = artefact::find_sphere(points, *options.diameter_m / 2, found, context);
    TURNSCAN_TRY(context.check());
    const auto ball = sphere ? measurement.measure(*sphere) : std::nullopt;
    if (!ball) return no_ball(*options.diameter_m, found.size(), wanted);
    found.push_back(*sphere);
    out.balls.push_back(*ball);
  }
  std::stable_sort(out.balls.begin(), out.balls.end(),
                   [](const BallFigures& a, const BallFigures& b) {
                     return a.center_m.norm() < b.center_m.norm();
                   });
  if (wanted < 2) return {};
  TURNSCAN_ASSIGN(out.spacing, spacing_of(measurement, out.balls, options.spacing_m));
  return {};
}

Result<> measure_plate(const Points& points, const ArtefactOptions& options,
                       const RunContext& context, ArtefactFigures& out) {
  const Fit<Plane> fit = artefact::fit_plane;
  const Usable<Plane> anywhere = [](const Vec3d&, const Plane&) { return true; };
  auto plane = artefact::find_plane(points, context);
  TURNSCAN_TRY(context.check());
  auto selection = plane
                       ? settle<Plane>(points, *plane, kPlateReach_m, options.band_m, anywhere, fit)
                       : std::nullopt;
  if (!selection)
    return fail(ErrorCode::kMissingData,
                "artefact: no plane was found; check that the plate is in the scan");
  selection->points = artefact::within_margin(selection->points, *plane, options.margin_m);
  if (selection->points.size() < kMinPoints)
    return fail(ErrorCode::kTooFewPoints,
                "artefact: {} points of the plate are left within its margin; choose a smaller "
                "--plate-margin",
                selection->points.size());
  PlateFigures plate;
  const auto figures = figures_of<Plane>(*selection, *plane, fit);
  if (!figures)
    return fail(ErrorCode::kTooFewPoints,
                "artefact: the points of the plate do not make a plane; check the "
                "file");
  plate.fit = *figures;
  plate.normal = plane->unit;
  plate.center_m = plane->point;
  std::tie(plate.length_m, plate.width_m) = artefact::outline_size(selection->points, *plane);
  out.plate = plate;
  return {};
}

Result<> check_options(const ArtefactOptions& options) {
  ArtefactOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  if (options.artefact == Artefact::kNone)
    return fail(ErrorCode::kInvalidOption,
                "artefact: none was chosen; use ball, ball-bar or plate");
  if (options.artefact != Artefact::kPlate && !options.diameter_m)
    return fail(ErrorCode::kInvalidOption,
                "artefact: the diameter of the ball is not given; add --ball-diameter");
  return {};
}

}  // namespace

OptionTable describe(ArtefactOptions& options) {
  OptionTable table;
  table.choice("artefact", options.artefact, {"none", "ball", "ball-bar", "plate"},
               "MESH is the scan of an artefact of known size: give the figures of VDI/VDE 2634 "
               "part 2. Needs no reference.");
  table.number("ball-diameter", options.diameter_m, Quantity::kLength, {0.001, 1.0},
               "Calibrated diameter of the ball, or of both balls of a bar; auto: not given.");
  table.number("ball-spacing", options.spacing_m, Quantity::kLength, {0.001, 10.0},
               "Calibrated distance of the centres of a ball bar; auto: not given.");
  table.number("ball-lowest", options.lowest_rad, Quantity::kAngle, {-kTurn / 4, kTurn / 8},
               "Points of a ball below this elevation, seen from its centre, are not used; auto: "
               "-30deg of a mesh, whose underside no sensor saw, all of a point cloud.");
  table.number("artefact-band", options.band_m, Quantity::kLength, {1e-6, 0.1},
               "How far from the artefact's surface its points may lie; auto: six standard "
               "deviations.");
  table.number("plate-margin", options.margin_m, Quantity::kLength, {0.0, 1.0},
               "Rim of a plate that is not used.");
  return table;
}

Result<ArtefactFigures> measure_artefact(const PointCloud& cloud, const ArtefactOptions& options,
                                         const RunContext& context) {
  TURNSCAN_TRY(check_options(options));
  context.begin_phase("artefact", 0);
  Points points;
  const bool normals = cloud.normals.size() == cloud.points.size();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    points.positions.push_back(cloud.points[i].cast<double>());
    if (normals) points.normals.push_back(cloud.normals[i].cast<double>());
  }
  if (points.positions.size() < kMinPoints)
    return fail(ErrorCode::kTooFewPoints,
                "artefact: the scan has {} points, and {} are needed; check the file",
                points.positions.size(), kMinPoints);
  ArtefactFigures figures;
  figures.artefact = options.artefact;
  TURNSCAN_TRY(options.artefact == Artefact::kPlate
                   ? measure_plate(points, options, context, figures)
                   : measure_balls(points, options, context, figures));
  return figures;
}

Result<PointCloud> artefact_points(const TriangleMesh& mesh, const RunContext& context) {
  TURNSCAN_ASSIGN(SurfaceSamples samples, sample_surface(mesh, kSamples, 1, context));
  PointCloud cloud;
  cloud.points = std::move(samples.points);
  cloud.normals = std::move(samples.normals);
  return cloud;
}

}  // namespace turnscan
