#include <turnscan/core/rotation_between.hpp>

#include <Eigen/Householder>
#include <algorithm>
#include <cmath>

namespace turnscan {

namespace {

/// A unit vector perpendicular to two opposite ones: the last column of the Q of their QR
/// decomposition with pivoting, bitwise identical to Eigen::ColPivHouseholderQR.
Vec3d across(const Vec3d& a, const Vec3d& b) {
  Eigen::Matrix<double, 3, 2> both;
  both << a, b;
  both = Eigen::Matrix<double, 3, 2>(both / both.cwiseAbs().maxCoeff());
  const int pivot = both.col(1).norm() > both.col(0).norm() ? 1 : 0;
  Vec3d first = both.col(pivot), second = both.col(1 - pivot);
  Eigen::Vector2d essential0;
  Eigen::Matrix<double, 1, 1> essential1;
  double tau0 = 0.0, tau1 = 0.0, beta = 0.0, workspace = 0.0;
  first.makeHouseholder(essential0, tau0, beta);
  second.applyHouseholderOnTheLeft(essential0, tau0, &workspace);
  second.tail<2>().makeHouseholder(essential1, tau1, beta);
  Vec3d column = Vec3d::UnitZ();
  column.tail<2>().applyHouseholderOnTheLeft(essential1, tau1, &workspace);
  column.applyHouseholderOnTheLeft(essential0, tau0, &workspace);
  return column;
}

}  // namespace

Eigen::Quaterniond rotation_between(const Vec3d& from, const Vec3d& to) {
  const Vec3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond q;
  if (cosine < -1.0 + Eigen::NumTraits<double>::dummy_precision()) {
    const double square = (1.0 + std::max(cosine, -1.0)) * 0.5;
    q.w() = std::sqrt(square);
    q.vec() = across(a, b) * std::sqrt(1.0 - square);
    return q;
  }
  const double s = std::sqrt((1.0 + cosine) * 2.0);
  q.vec() = a.cross(b) * (1.0 / s);
  q.w() = s * 0.5;
  return q;
}

}  // namespace turnscan
