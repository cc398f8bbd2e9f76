#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>

namespace turnscan::estimation {
namespace {

template <class Matrix>
Matrix filled(Matrix out, std::uint64_t seed) {
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out.data()[i] = typename Matrix::Scalar(standard_normal(hash_key(seed, std::uint64_t(i))));
  return out;
}

template <class Matrix>
Matrix positive_definite(Matrix size, std::uint64_t seed) {
  const Matrix a = filled(size, seed);
  return a * a.transpose();
}

TEST(LinearSolvers, LdltSolvesAsEigenDoesToTheLastBit) {
  const auto a3 = positive_definite(Eigen::Matrix3d(), 1);
  const auto b3 = filled(Eigen::Vector3d(), 2);
  EXPECT_EQ(solve_ldlt(a3, b3), Eigen::Vector3d(a3.ldlt().solve(b3)));
  const auto a6 = positive_definite(Matrix6d(), 3);
  const auto b6 = filled(Vector6d(), 4);
  EXPECT_EQ(solve_ldlt(a6, b6), Vector6d(a6.ldlt().solve(b6)));
  const auto a30 = positive_definite(Eigen::MatrixXd(30, 30), 5);
  const auto b30 = filled(Eigen::VectorXd(30), 6);
  EXPECT_EQ(solve_ldlt(a30, b30), Eigen::VectorXd(a30.ldlt().solve(b30)));
}

TEST(LinearSolvers, LdltReadsTheLowerHalfOnly) {
  const auto a = positive_definite(Matrix6d(), 7);
  const auto b = filled(Vector6d(), 8);
  Matrix6d lower = a;
  lower.triangularView<Eigen::StrictlyUpper>().setConstant(1e9);
  EXPECT_EQ(solve_ldlt(lower, b), solve_ldlt(a, b));
  EXPECT_EQ(symmetric_eigen(lower).values, symmetric_eigen(a).values);
}

TEST(LinearSolvers, WhatAMatrixLeavesOpenIsZeroInItsLdltSolution) {
  Eigen::Matrix3d a = Eigen::Vector3d(2.0, 0.0, 5.0).asDiagonal();
  EXPECT_EQ(solve_ldlt(a, Eigen::Vector3d(4.0, 0.0, 10.0)), Eigen::Vector3d(2.0, 0.0, 2.0));
}

TEST(LinearSolvers, LuSolvesMatricesThatAreNotSymmetric) {
  const auto a = filled(Matrix6d(), 9);
  const auto b = filled(Matrix6d(), 10);
  EXPECT_LT((a * solve_lu(a, b) - b).norm(), 1e-10);
  EXPECT_LT((a * inverse_lu(a) - Matrix6d::Identity()).norm(), 1e-10);
}

TEST(LinearSolvers, LeastNormLeavesOutWhatASingularMatrixDoesNotShow) {
  Matrix6d a = Matrix6d::Identity();
  a(4, 4) = 0.0;
  Vector6d b = Vector6d::Constant(2.0);
  b[4] = 0.0;
  EXPECT_LT((solve_least_norm(a, b) - b).norm(), 1e-14);
}

TEST(LinearSolvers, EigenvectorsDiagonaliseAndValuesIncrease) {
  const auto a = positive_definite(Matrix6d(), 11);
  const SymmetricEigen<6> eigen = symmetric_eigen(a);
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - a).norm(),
            1e-10);
  for (int k = 1; k < 6; ++k) EXPECT_LE(eigen.values[k - 1], eigen.values[k]);
  const auto a3 = positive_definite(Eigen::Matrix3d(), 12);
  EXPECT_EQ(symmetric_eigenvalues(a3), symmetric_eigen(a3).values);
}

TEST(LinearSolvers, TheCholeskyRootTurnsACovarianceIntoTheIdentity) {
  const auto a = positive_definite(Matrix6d(), 13);
  const Matrix6d l = cholesky_root(a);
  EXPECT_LT((l * l.transpose() - a).norm(), 1e-12);
  EXPECT_EQ(l(0, 5), 0.0);
  const auto b = filled(Vector6d(), 14);
  EXPECT_LT((l * solve_lower(l, b) - b).norm(), 1e-10);
  EXPECT_LT((l.transpose() * solve_lower_transposed(l, b) - b).norm(), 1e-10);
  const Matrix6d precision = inverse_lu(a);
  EXPECT_LT((congruent_eigen(l, precision).values - Vector6d::Ones()).norm(), 1e-8);
}

TEST(LinearSolvers, DenseLdltInvertsAndSaysTheDeterminant) {
  const auto a = positive_definite(Eigen::MatrixXd(20, 20), 15);
  const DenseLdlt factors(a);
  ASSERT_TRUE(factors.succeeded());
  EXPECT_LT((a * factors.inverse() - Eigen::MatrixXd::Identity(20, 20)).norm(), 1e-7);
  EXPECT_NEAR(factors.diagonal().array().log().sum(), std::log(a.determinant()), 1e-8);
  const auto b = filled(Eigen::VectorXd(20), 16);
  EXPECT_EQ(factors.solve(b), solve_ldlt(a, b));
}

}  // namespace
}  // namespace turnscan::estimation
