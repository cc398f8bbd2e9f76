#pragma once
// Small dense solvers, compiled once. Eigen's decompositions are templates that cost seconds of
// compile time in every source that calls them; here they are behind functions, for the sizes in
// use. Another size needs a line at the end of its source.

#include <memory>
#include <turnscan/core/eigen.hpp>

namespace turnscan::estimation {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Solves A x = b by LDL^T with pivoting. A is symmetric, positive or negative semidefinite; only
/// its lower half is read. x is 0 in directions that A leaves undetermined.
template <class Scalar, int N, int Columns>
Eigen::Matrix<Scalar, N, Columns> solve_ldlt(const Eigen::Matrix<Scalar, N, N>& a,
                                             const Eigen::Matrix<Scalar, N, Columns>& b);

/// Solves A x = b for any invertible A, by LU with partial pivoting.
template <int Columns>
Eigen::Matrix<double, 6, Columns> solve_lu(const Matrix6d& a,
                                           const Eigen::Matrix<double, 6, Columns>& b);

/// The inverse of any invertible A, by LU with partial pivoting.
template <int N>
Eigen::Matrix<double, N, N> inverse_lu(const Eigen::Matrix<double, N, N>& a);

/// The x of least norm among the minimisers of |A x - b|, by a complete orthogonal decomposition.
Vector6d solve_least_norm(const Matrix6d& a, const Vector6d& b);

/// Eigenvalues in increasing order, and unit eigenvectors as columns.
template <int N>
struct SymmetricEigen {
  Eigen::Matrix<double, N, 1> values;
  Eigen::Matrix<double, N, N> vectors;
};

/// Eigendecomposition of a symmetric matrix, of which only the lower half is read.
template <int N>
SymmetricEigen<N> symmetric_eigen(const Eigen::Matrix<double, N, N>& a);

/// The eigenvalues alone, increasing.
Eigen::Vector3d symmetric_eigenvalues(const Eigen::Matrix3d& a);

/// Eigendecomposition of root^T A root: a covariance or information A in the coordinates y =
/// root^-1 x.
SymmetricEigen<6> congruent_eigen(const Matrix6d& root, const Matrix6d& a);

/// L of A = L L^T, A positive definite; its upper half is 0.
Matrix6d cholesky_root(const Matrix6d& a);
/// Solves L x = b, L lower triangular.
template <int Columns>
Eigen::Matrix<double, 6, Columns> solve_lower(const Matrix6d& l,
                                              const Eigen::Matrix<double, 6, Columns>& b);
/// Solves L^T x = b, L lower triangular.
Vector6d solve_lower_transposed(const Matrix6d& l, const Vector6d& b);

/// LDL^T of a symmetric matrix of any size, of which only the lower half is read.
class DenseLdlt {
 public:
  DenseLdlt();
  explicit DenseLdlt(const Eigen::MatrixXd& a);
  DenseLdlt(DenseLdlt&&) noexcept;
  DenseLdlt& operator=(DenseLdlt&&) noexcept;
  ~DenseLdlt();

  void compute(const Eigen::MatrixXd& a);
  /// False if the last matrix could not be decomposed.
  bool succeeded() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  Eigen::MatrixXd inverse() const;
  /// The diagonal D, in the order of the pivots.
  Eigen::VectorXd diagonal() const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace turnscan::estimation
