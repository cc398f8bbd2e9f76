#include <turnscan/geometry/estimation/linear_solvers.hpp>

#include <Eigen/Eigenvalues>

namespace turnscan::estimation {

template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& a) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

SymmetricEigen<6> congruent_eigen(const Matrix6d& root, const Matrix6d& a) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(root.transpose() * a * root);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix2d&);
template SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d&);
template SymmetricEigen<4> symmetric_eigen(const Eigen::Matrix4d&);
template SymmetricEigen<6> symmetric_eigen(const Matrix6d&);

}  // namespace turnscan::estimation
