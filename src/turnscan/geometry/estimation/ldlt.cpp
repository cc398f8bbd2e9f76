#include <turnscan/geometry/estimation/linear_solvers.hpp>

#include <Eigen/Cholesky>

namespace turnscan::estimation {

template <class Scalar, int N, int Columns>
Eigen::Matrix<Scalar, N, Columns> solve_ldlt(const Eigen::Matrix<Scalar, N, N>& a,
                                             const Eigen::Matrix<Scalar, N, Columns>& b) {
  return a.ldlt().solve(b);
}

template Eigen::Vector3f solve_ldlt(const Eigen::Matrix3f&, const Eigen::Vector3f&);
template Eigen::Vector3d solve_ldlt(const Eigen::Matrix3d&, const Eigen::Vector3d&);
template Eigen::Vector4d solve_ldlt(const Eigen::Matrix4d&, const Eigen::Vector4d&);
template Eigen::Matrix4d solve_ldlt(const Eigen::Matrix4d&, const Eigen::Matrix4d&);
template Eigen::Matrix<double, 5, 3> solve_ldlt(const Eigen::Matrix<double, 5, 5>&,
                                                const Eigen::Matrix<double, 5, 3>&);
template Vector6d solve_ldlt(const Matrix6d&, const Vector6d&);
template Matrix6d solve_ldlt(const Matrix6d&, const Matrix6d&);
template Eigen::Matrix<double, 7, 1> solve_ldlt(const Eigen::Matrix<double, 7, 7>&,
                                                const Eigen::Matrix<double, 7, 1>&);
template Eigen::Matrix<double, 8, 3> solve_ldlt(const Eigen::Matrix<double, 8, 8>&,
                                                const Eigen::Matrix<double, 8, 3>&);

}  // namespace turnscan::estimation
