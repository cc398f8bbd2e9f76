#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/rotation_between.hpp>
#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion_input/platter_sight.hpp>

namespace turnscan::motion {

namespace {

constexpr double kWithinRim = 0.93;  ///< pixels farther out mix with the background
constexpr double kMaxTilt_rad = 3.0 * kRadiansPerDegree;
constexpr std::size_t kMinPixels = 200;
constexpr double kTukeySigmas = 4.0;
constexpr int kRounds = 8;
/// Minimum spread of the visible platter in each direction (rms), relative to its radius.
constexpr double kMinSpread = 0.15;

/// Minimum rms of tilts for a wobble.
constexpr double kMinWobble_rad = 0.1 * kRadiansPerDegree, kWobbleOverNoise = 2.5;
constexpr double kMinShare = 0.8;  ///< of the frames that must show the platter
/// Maximum rms deviation of the tilts from a circle, relative to its radius.
constexpr double kRoundest = 0.35;

/// The platter's frame: y along its axis.
struct PlatterPlane {
  std::vector<Vec3d> points;
  Vec3d plane = Vec3d::Zero();  ///< y = plane . (x, z, 1)
  estimation::NormalEquations<3> equations;

  void solve(double limit) {
    equations = {};
    for (const Vec3d& p : points) {
      const Vec3d row(p.x(), p.z(), 1.0);
      const double weight = estimation::tukey_weight((p.y() - plane.dot(row)) / limit);
      if (weight > 0.0) equations.add(row, p.y(), weight);
    }
    plane = equations.solve();
  }

  double scatter() const {
    std::vector<double> off;
    off.reserve(points.size());
    for (const Vec3d& p : points)
      off.push_back(std::abs(p.y() - plane.dot(Vec3d(p.x(), p.z(), 1.0))));
    return estimation::mad_sigma(off);
  }
};

/// Centre of the circle through points (Kasa 1976), if they are on one; else their mean, which is
/// the origin.
Eigen::Vector2d middle_of(const std::vector<Eigen::Vector2d>& points) {
  estimation::NormalEquations<3> equations;
  for (const Eigen::Vector2d& p : points)
    equations.add(Vec3d(2.0 * p.x(), 2.0 * p.y(), 1.0), p.squaredNorm(), 1.0);
  const Vec3d found = equations.solve();
  const Eigen::Vector2d middle = found.head<2>();
  const double radius = std::sqrt(std::max(0.0, found.z() + middle.squaredNorm()));
  double squares = 0.0;
  for (const Eigen::Vector2d& p : points) squares += std::pow((p - middle).norm() - radius, 2);
  const bool round = std::sqrt(squares / double(points.size())) < kRoundest * radius;
  return round && middle.norm() < radius ? middle : Eigen::Vector2d::Zero();
}

}  // namespace

std::optional<PlatterObservation> fit_platter(const DepthImage& depth, const SensorInfo& sensor,
                                              const RayTable& rays, const DetectedPlatter& platter,
                                              double noise_m) {
  if (depth.pixels.size() != rays.x().size()) return std::nullopt;
  Eigen::Matrix3d R;  // from the platter's frame to the sensor's
  R.col(1) = platter.axis;
  R.col(0) = platter.axis.unitOrthogonal();
  R.col(2) = R.col(0).cross(R.col(1));
  const double reach = kWithinRim * platter.radius_m;
  const double steep = std::max(0.1, std::abs(platter.axis.dot(platter.center_m.normalized())));
  const double gate = std::tan(kMaxTilt_rad) * reach + kTukeySigmas * noise_m * steep;
  PlatterPlane fit;
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const std::uint16_t value = depth.pixels[i];
    if (value == kNoReturn || value == kOutsideCrop) continue;
    const double z = value * sensor.depth_unit_m + sensor.depth_bias_m;
    const Vec3d p = R.transpose() * (Vec3d(rays.x()[i] * z, rays.y()[i] * z, z) - platter.center_m);
    if (std::abs(p.y()) < gate && p.x() * p.x() + p.z() * p.z() < reach * reach)
      fit.points.push_back(p);
  }
  if (fit.points.size() < kMinPixels) return std::nullopt;
  double limit = gate;
  for (int round = 0; round < kRounds; ++round) {
    fit.solve(limit);
    if (!fit.plane.allFinite()) return std::nullopt;
    limit = std::clamp(kTukeySigmas * fit.scatter(), 0.5 * limit, gate);
  }
  const double count = fit.equations.normal(2, 2);
  const Eigen::Matrix2d spread = fit.equations.normal.topLeftCorner<2, 2>() / count -
                                 fit.equations.normal.topRightCorner<2, 1>() *
                                     fit.equations.normal.bottomLeftCorner<1, 2>() /
                                     (count * count);
  const double least =
      0.5 * (spread.trace() - std::hypot(spread(0, 0) - spread(1, 1), 2.0 * spread(0, 1)));
  if (!(count >= double(kMinPixels)) || !(least > std::pow(kMinSpread * reach, 2)))
    return std::nullopt;
  PlatterObservation out;
  out.axis = R * Vec3d(-fit.plane.x(), 1.0, -fit.plane.y()).normalized();
  out.height_m = fit.plane.z();
  out.slope_sigma = fit.scatter() / std::sqrt(count * least);
  return out;
}

std::optional<Levelling> level(const std::vector<std::optional<PlatterObservation>>& sights,
                               const DetectedPlatter& platter) {
  Eigen::Matrix<double, 3, 2> beside;
  beside.col(0) = platter.axis.unitOrthogonal();
  beside.col(1) = beside.col(0).cross(platter.axis);
  std::vector<Eigen::Vector2d> tilts;
  std::vector<std::size_t> at;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (!sights[i]) continue;
    at.push_back(i);
    tilts.push_back(beside.transpose() * sights[i]->axis);
    mean += tilts.back();
  }
  if (at.empty() || double(at.size()) < kMinShare * double(sights.size())) return std::nullopt;
  mean /= double(at.size());
  double squares = 0.0, steps = 0.0;
  for (std::size_t k = 0; k < tilts.size(); ++k) {
    tilts[k] -= mean;
    squares += tilts[k].squaredNorm();
    if (k > 0) steps += (tilts[k] - tilts[k - 1]).squaredNorm() / 2.0;
  }
  const double scatter = std::sqrt(squares / double(at.size()));
  const double noise = std::sqrt(steps / double(std::max<std::size_t>(1, at.size() - 1)));
  if (scatter < std::max(kMinWobble_rad, kWobbleOverNoise * noise)) return std::nullopt;
  Levelling out;
  out.axis = (platter.axis + beside * middle_of(tilts)).normalized();
  for (std::size_t i = 0, k = 0; i < sights.size(); ++i) {
    while (k + 1 < at.size() && at[k + 1] <= i) ++k;
    const bool next = k + 1 < at.size() && at[k + 1] - i < (at[k] > i ? at[k] - i : i - at[k]);
    const Vec3d axis = (platter.axis + beside * tilts[next ? k + 1 : k]).normalized();
    const Eigen::Matrix3d R = rotation_between(axis, out.axis).toRotationMatrix();
    Pose T = Pose::Identity();
    T.linear() = R;
    T.translation() = platter.center_m - R * platter.center_m;
    out.T_level_sensor.push_back(T);
  }
  return out;
}

}  // namespace turnscan::motion
