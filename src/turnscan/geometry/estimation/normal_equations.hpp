#pragma once
// Weighted linear least squares of a few unknowns, summed residual by residual in a fixed order.

#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::estimation {

/// The normal equations: normal * x = right, where normal is the sum of weight * row * row^T and
/// right the sum of weight * residual * row.
template <int N>
struct NormalEquations {
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  Matrix normal = Matrix::Zero();
  Vector right = Vector::Zero();

  /// Adds an observation. `residual` is measured minus predicted; `row` holds the derivatives of
  /// the prediction.
  void add(const Vector& row, double residual, double weight) {
    normal.noalias() += weight * row * row.transpose();
    right.noalias() += weight * residual * row;
  }
  void add(const NormalEquations& other) {
    normal += other.normal;
    right += other.right;
  }
  /// Solves by LDL^T.
  Vector solve() const { return solve_ldlt(normal, right); }
};

/// The unknowns in directions that the residuals determine, with the others fixed at 0.
struct FirmSolution {
  Vector6d values = Vector6d::Zero();
  int held_directions = 0;
};

/// Fixes the eigenvectors of the normal matrix whose eigenvalues are at most this share of the
/// largest one.
FirmSolution solve_firm(const NormalEquations<6>& equations, double held_share);

/// Covariance of an estimate by the sandwich formula (Huber 1967): inverse * scatter * inverse,
/// with the inverse of the normal matrix and the scatter of the residuals' gradients.
Eigen::MatrixXd sandwich_covariance(const Eigen::MatrixXd& inverse, const Eigen::MatrixXd& scatter);

}  // namespace turnscan::estimation
