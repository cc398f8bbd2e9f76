#include <turnscan/reconstruction/passes/undetermined.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/geometry/estimation/se3.hpp>

namespace turnscan::passes {

namespace {

/// A direction with less information from the pairs, relative to the best one, is undetermined.
constexpr double kHeld = 0.02;

using estimation::Vector6d;

/// x^T M x is the mean square distance by which a small motion x moves the surface.
Matrix6 displacement_metric(const PreparedPass& pass, const Pose& T_first_pass,
                            const Vec3d& center) {
  Matrix6 sum = Matrix6::Zero();
  for (const Vec3f& point : pass.coarse.samples.points) {
    const Vec3d p = T_first_pass * point.cast<double>() - center;
    Eigen::Matrix<double, 3, 6> j;
    j << 0.0, p.z(), -p.y(), 1.0, 0.0, 0.0,  //
        -p.z(), 0.0, p.x(), 0.0, 1.0, 0.0,   //
        p.y(), -p.x(), 0.0, 0.0, 0.0, 1.0;
    sum += j.transpose() * j;
  }
  return sum / double(std::max<std::size_t>(1, pass.coarse.samples.size()));
}

/// Directions of small motions of the second of two passes, scaled such that a unit moves the
/// surface by a metre, sorted by their accuracy.
struct KnownDirections {
  Matrix6 root;  ///< L; y = L^T x
  estimation::SymmetricEigen<6> eigen;

  KnownDirections(const PreparedPass& pass, const Adjustment& adjustment)
      : root(estimation::cholesky_root(
            displacement_metric(pass, adjustment.T_first_pass[1], adjustment.center))),
        eigen(estimation::congruent_eigen(root, adjustment.covariances[1])) {}
  double sigma(int k) const { return std::sqrt(std::max(0.0, eigen.values[k])); }
  Vector6d motion_of(const Vector6d& y) const {
    return estimation::solve_lower_transposed(root, y);
  }
};

std::string direction_text(const Vector6d& x, double lever_m) {
  const bool turns = x.head<3>().norm() * lever_m > x.tail<3>().norm();
  const Vec3d axis = (turns ? x.head<3>() : x.tail<3>()).normalized();
  return fmt::format("{} ({:.2f}, {:.2f}, {:.2f}) of the first pass's table",
                     turns ? "turns about the axis" : "slides along", axis.x(), axis.y(), axis.z());
}

}  // namespace

double surface_sigma(const PreparedPass& pass, const Pose& T_first_pass, const Vec3d& center,
                     const Matrix6& covariance) {
  return std::sqrt(
      std::max(0.0, (displacement_metric(pass, T_first_pass, center) * covariance).trace()));
}

Pose determined_part(const PreparedPass& pass, const Adjustment& adjustment, const Pose& from,
                     double max_sigma_m) {
  const KnownDirections known(pass, adjustment);
  // Information of the pairs of points about each direction, of which noise contributes a little to
  // any.
  const Matrix6 half = estimation::solve_lower(known.root, adjustment.information[1]);
  const auto said =
      estimation::symmetric_eigen(estimation::solve_lower(known.root, Matrix6(half.transpose())));
  const Matrix6 covariance = known.root.transpose() * adjustment.covariances[1] * known.root;
  const Pose step = adjustment.T_first_pass[1] * from.inverse();
  Vector6d y = known.root.transpose() * estimation::log_about(adjustment.center, step);
  for (int k = 0; k < 6; ++k) {
    const Vector6d direction = said.vectors.col(k);
    const bool held = said.values[k] > kHeld * said.values[5] &&
                      direction.dot(covariance * direction) < max_sigma_m * max_sigma_m;
    if (!held) y -= direction.dot(y) * direction;
  }
  return estimation::orthonormalised(estimation::exp_about(adjustment.center, known.motion_of(y)) *
                                     from);
}

std::string undetermined_direction(const PreparedPass& pass, const Adjustment& adjustment,
                                   double max_sigma_m) {
  const KnownDirections known(pass, adjustment);
  const double sigma = known.sigma(5);
  if (sigma < max_sigma_m) return {};
  const Vector6d x = known.motion_of(known.eigen.vectors.col(5));
  return fmt::format("its shape leaves open how it {}: known to {:.2f} mm only",
                     direction_text(x, 0.3 * pass.extent_m), sigma * 1e3);
}

}  // namespace turnscan::passes
