#include <turnscan/geometry/estimation/linear_solvers.hpp>

#include <Eigen/Dense>

namespace turnscan::estimation {

template <class Scalar, int N, int Columns>
Eigen::Matrix<Scalar, N, Columns> solve_ldlt(const Eigen::Matrix<Scalar, N, N>& a,
                                             const Eigen::Matrix<Scalar, N, Columns>& b) {
  return a.ldlt().solve(b);
}

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

Matrix6d cholesky_root(const Matrix6d& a) { return a.llt().matrixL(); }

template <int Columns>
Eigen::Matrix<double, 6, Columns> solve_lower(const Matrix6d& l,
                                              const Eigen::Matrix<double, 6, Columns>& b) {
  return l.triangularView<Eigen::Lower>().solve(b);
}

Vector6d solve_lower_transposed(const Matrix6d& l, const Vector6d& b) {
  return l.transpose().triangularView<Eigen::Upper>().solve(b);
}

struct DenseLdlt::Factors : Eigen::LDLT<Eigen::MatrixXd> {};

DenseLdlt::DenseLdlt() : factors_(std::make_unique<Factors>()) {}
DenseLdlt::DenseLdlt(const Eigen::MatrixXd& a) : DenseLdlt() { compute(a); }
DenseLdlt::DenseLdlt(DenseLdlt&&) noexcept = default;
DenseLdlt& DenseLdlt::operator=(DenseLdlt&&) noexcept = default;
DenseLdlt::~DenseLdlt() = default;

void DenseLdlt::compute(const Eigen::MatrixXd& a) { factors_->compute(a); }
bool DenseLdlt::succeeded() const { return factors_->info() == Eigen::Success; }
Eigen::VectorXd DenseLdlt::solve(const Eigen::VectorXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd DenseLdlt::solve(const Eigen::MatrixXd& b) const { return factors_->solve(b); }
Eigen::MatrixXd DenseLdlt::inverse() const {
  return factors_->solve(Eigen::MatrixXd::Identity(factors_->rows(), factors_->rows()));
}
Eigen::VectorXd DenseLdlt::diagonal() const { return factors_->vectorD(); }

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
template Eigen::VectorXd solve_ldlt(const Eigen::MatrixXd&, const Eigen::VectorXd&);

template Vector6d solve_lu(const Matrix6d&, const Vector6d&);
template Matrix6d solve_lu(const Matrix6d&, const Matrix6d&);
template Matrix6d inverse_lu(const Matrix6d&);
template Eigen::Matrix<double, 7, 7> inverse_lu(const Eigen::Matrix<double, 7, 7>&);

template SymmetricEigen<2> symmetric_eigen(const Eigen::Matrix2d&);
template SymmetricEigen<3> symmetric_eigen(const Eigen::Matrix3d&);
template SymmetricEigen<4> symmetric_eigen(const Eigen::Matrix4d&);
template SymmetricEigen<6> symmetric_eigen(const Matrix6d&);

template Vector6d solve_lower(const Matrix6d&, const Vector6d&);
template Matrix6d solve_lower(const Matrix6d&, const Matrix6d&);

}  // namespace turnscan::estimation
