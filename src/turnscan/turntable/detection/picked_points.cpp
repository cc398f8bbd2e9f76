#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/detection/picked_points.hpp>

namespace turnscan {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kMaxPoints = 300;  // 4.5 million triples
constexpr double kOnALine = 1e-6;        // twice the area over the longest side squared

Result<> check_points(std::span<const Vec3d> points) {
  if (points.size() < 3)
    return fail(ErrorCode::kTooFewPoints,
                "picked points: {} are given; pick 3 or more on the platter's rim", points.size());
  if (points.size() > kMaxPoints)
    return fail(ErrorCode::kInvalidOption, "picked points: {} are given; give at most {}",
                points.size(), kMaxPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      return fail(ErrorCode::kInvalidOption, "picked points: point {} is not finite", i + 1);
    for (std::size_t k = 0; k < i; ++k) {
      if ((points[i] - points[k]).norm() <= 1e-9)
        return fail(ErrorCode::kInvalidOption,
                    "picked points: points {} and {} are the same; pick different ones", k + 1,
                    i + 1);
    }
  }
  return {};
}

struct Circumcircle {
  Vec3d center, area_normal;  ///< normal of the triangle times its area
  double radius, area;
};

std::optional<Circumcircle> circumcircle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d u = b - a, v = c - a, n = u.cross(v);
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (c - b).squaredNorm()});
  if (!(n.norm() > kOnALine * longest)) return std::nullopt;
  const Vec3d to_center =
      (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
  return Circumcircle{a + to_center, 0.5 * n, to_center.norm(), 0.5 * n.norm()};
}

/// Two unit vectors that form a right-handed frame with n.
std::pair<Vec3d, Vec3d> across(const Vec3d& n) {
  int least = 0;
  n.cwiseAbs().minCoeff(&least);
  const Vec3d u = n.cross(Vec3d::Unit(least)).normalized();
  return {u, n.cross(u)};
}

/// Normal equations of the rim distances (in the plane, and from it) at a circle. Unknowns: two
/// tilts of the axis, the centre along (u, v, axis), the radius.
struct CircleSystem {
  Matrix6 normal = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  double squares = 0.0;
};

CircleSystem linearise(std::span<const Vec3d> points, const Circle& circle) {
  const auto [u, v] = across(circle.axis);
  CircleSystem out;
  for (const Vec3d& point : points) {
    const Vec3d d = point - circle.center;
    const double x = d.dot(u), y = d.dot(v), h = d.dot(circle.axis), rho = std::hypot(x, y);
    if (!(rho > 0.0)) continue;
    Vector6 in, off;
    // An axis tilted by (s, t) becomes axis + s u + t v.
    in << -h * x / rho, -h * y / rho, -x / rho, -y / rho, 0.0, -1.0;
    off << x, y, 0.0, 0.0, -1.0, 0.0;
    const double in_error = rho - circle.radius_m;
    out.normal += in * in.transpose() + off * off.transpose();
    out.right -= in * in_error + off * h;
    out.squares += in_error * in_error + h * h;
  }
  return out;
}

Circle moved(const Circle& circle, const Vector6& step) {
  const auto [u, v] = across(circle.axis);
  Circle out;
  out.center = circle.center + step[2] * u + step[3] * v + step[4] * circle.axis;
  out.axis = (circle.axis + step[0] * u + step[1] * v).normalized();
  out.radius_m = circle.radius_m + step[5];
  return out;
}

Circle least_squares_circle(std::span<const Vec3d> points, Circle circle) {
  CircleSystem system = linearise(points, circle);
  double damping = 1e-3;
  for (int i = 0; i < 200 && damping < 1e12; ++i) {
    Matrix6 damped = system.normal;
    damped.diagonal() += damping * system.normal.diagonal();
    const Vector6 step = estimation::solve_ldlt(damped, system.right);
    const Circle next = moved(circle, step);
    CircleSystem after = linearise(points, next);
    if (!(after.squares <= system.squares)) {
      damping *= 10.0;
      continue;
    }
    circle = next;
    system = std::move(after);
    damping = std::max(damping * 0.1, 1e-12);
    if (step.norm() < 1e-13) break;
  }
  return circle;
}

}  // namespace

CircleError circle_error(std::span<const Vec3d> points, const Circle& circle) {
  CircleError error;
  for (const Vec3d& p : points) {
    const double e = (p - circle.center).norm() - circle.radius_m;
    error.mean_abs_m += std::abs(e) / double(points.size());
    error.rms_m += e * e / double(points.size());
  }
  error.rms_m = std::sqrt(error.rms_m);
  return error;
}

Result<Circle> circle_from_triples(std::span<const Vec3d> points, const Vec3d& sensor) {
  TURNSCAN_TRY(check_points(points));
  Vec3d centers = Vec3d::Zero(), normals = Vec3d::Zero();
  double radii = 0.0, areas = 0.0, triples = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const auto triangle = circumcircle(points[i], points[j], points[k]);
        if (!triangle) continue;
        // The orientation of a triangle is arbitrary: flip its normal towards the sensor.
        const double side = triangle->area_normal.dot(sensor - points[i]) < 0.0 ? -1.0 : 1.0;
        centers += triangle->center;
        normals += side * triangle->area_normal;
        radii += triangle->area * triangle->radius;
        areas += triangle->area;
        triples += 1.0;
      }
    }
  }
  if (triples == 0.0 || !(normals.norm() > 0.0))
    return fail(ErrorCode::kInvalidOption,
                "picked points: all {} lie on one line, so that no circle goes through them; pick "
                "points all round the rim",
                points.size());
  return Circle{centers / triples, normals.normalized(), radii / areas};
}

Result<PickedCircle> fit_picked_points(std::span<const Vec3d> points, const Vec3d& sensor) {
  PickedCircle out;
  TURNSCAN_ASSIGN(out.triples, circle_from_triples(points, sensor));
  out.triples_error = circle_error(points, out.triples);
  out.circle = least_squares_circle(points, out.triples);
  if (out.circle.axis.dot(sensor - out.circle.center) < 0.0) out.circle.axis *= -1.0;
  out.error = circle_error(points, out.circle);
  const CircleSystem system = linearise(points, out.circle);
  const double surplus = 2.0 * double(points.size()) - 6.0;
  const double variance = surplus > 0.0 ? system.squares / surplus : std::nan("");
  const Matrix6 covariance = variance * estimation::inverse_lu(system.normal);
  out.axis_sigma_rad = std::sqrt(covariance(0, 0) + covariance(1, 1));
  out.center_sigma_m = std::sqrt(covariance(2, 2) + covariance(3, 3));
  out.height_sigma_m = std::sqrt(covariance(4, 4));
  out.radius_sigma_m = std::sqrt(covariance(5, 5));
  return out;
}

Result<Calibration> calibrate_from_points(std::span<const Vec3d> points, const Vec3d& sensor) {
  TURNSCAN_ASSIGN(const PickedCircle fit, fit_picked_points(points, sensor));
  Calibration out;
  out.method = CalibrationMethod::kPicked;
  out.table.axis = fit.circle.axis;
  out.table.center_m = fit.circle.center;
  out.table.radius_m = fit.circle.radius_m;
  out.axis_sigma_rad = fit.axis_sigma_rad;
  out.center_sigma_m = fit.center_sigma_m;
  out.height_sigma_m = fit.height_sigma_m;
  out.radius_sigma_m = fit.radius_sigma_m;
  out.residual_rms_m = fit.error.rms_m;
  out.residual_mean_abs_m = fit.error.mean_abs_m;
  const std::string how = fmt::format("least squares through {} picked points", points.size());
  out.axis_found = out.center_found = out.height_found = out.radius_found = how;
  out.notes.push_back(fmt::format(
      "the circumcircles of all triples alone give a centre {} away and an axis {} away, with a "
      "mean error of {}",
      length_text((fit.triples.center - fit.circle.center).norm()),
      figure_text(
          std::acos(std::min(1.0, fit.triples.axis.dot(fit.circle.axis))) * kDegreesPerRadian, 2,
          "deg"),
      length_text(fit.triples_error.mean_abs_m)));
  return out;
}

}  // namespace turnscan
