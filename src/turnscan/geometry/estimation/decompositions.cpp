#include <turnscan/geometry/estimation/linear_solvers.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

namespace turnscan::estimation {

template <int Columns>
Eigen::Matrix<double, 6, Columns> solve_lu(const Matrix6d& a,
                                           const Eigen::Matrix<double, 6, Columns>& b) {
  return a.partialPivLu().solve(b);
}

template <int N>
Eigen::Matrix<double, N, N> inverse_lu(const Eigen::Matrix<double, N, N>& a) {
  return a.inverse();
}

Vector6d solve_least_norm(const Matrix6d& a, const Vector6d& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

Matrix6d cholesky_root(const Matrix6d& a) { return a.llt().matrixL(); }

template <int Columns>
Eigen::Matrix<double, 6, Columns> solve_lower(const Matrix6d& l,
                                              const Eigen::Matrix<double, 6, Columns>& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

Vector6d solve_lower_transposed(const Matrix6d& l, const Vector6d& b) {
  return l.transpose().triangularView<Eigen::Upper>().solve(b);
}

template Vector6d solve_lu(const Matrix6d&, const Vector6d&);
template Matrix6d solve_lu(const Matrix6d&, const Matrix6d&);
template Matrix6d inverse_lu(const Matrix6d&);
template Eigen::Matrix<double, 7, 7> inverse_lu(const Eigen::Matrix<double, 7, 7>&);

template Vector6d solve_lower(const Matrix6d&, const Vector6d&);
template Matrix6d solve_lower(const Matrix6d&, const Matrix6d&);

}  // namespace turnscan::estimation
