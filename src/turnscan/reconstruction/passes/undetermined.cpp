#include <turnscan/reconstruction/passes/undetermined.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace turnscan::passes {

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

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

std::string direction_text(const Vec6& x, double lever_m) {
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

std::string undetermined_direction(const PreparedPass& pass, const Adjustment& adjustment,
                                   double max_sigma_m) {
  const Matrix6 metric = displacement_metric(pass, adjustment.T_first_pass[1], adjustment.center);
  const Eigen::LLT<Matrix6> root(metric);
  const Matrix6 l = root.matrixL();
  // In coordinates y = L^T x a unit moves the surface by a metre.
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(l.transpose() * adjustment.covariances[1] * l);
  const double sigma = std::sqrt(std::max(0.0, eigen.eigenvalues()[5]));
  if (sigma < max_sigma_m) return {};
  const Vec6 x =
      l.transpose().triangularView<Eigen::Upper>().solve(Vec6(eigen.eigenvectors().col(5)));
  return fmt::format("its shape leaves open how it {}: known to {:.2f} mm only",
                     direction_text(x, 0.3 * pass.extent_m), sigma * 1e3);
}

}  // namespace turnscan::passes
