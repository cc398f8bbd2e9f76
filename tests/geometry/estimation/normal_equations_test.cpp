#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/estimation/normal_equations.hpp>

namespace turnscan::estimation {
namespace {

double noise(std::uint64_t i, std::uint64_t k) { return standard_normal(hash_key(5, i, k)); }

/// Rows, measurements and weights of a random system; the columns from `unseen` on are 0.
struct Measured {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(40, 6);
  Eigen::VectorXd values = Eigen::VectorXd(40), weights = Eigen::VectorXd(40);
  explicit Measured(int unseen = 6) {
    for (int i = 0; i < 40; ++i) {
      for (int k = 0; k < unseen; ++k) rows(i, k) = noise(std::uint64_t(i), std::uint64_t(k));
      values[i] = noise(std::uint64_t(i), 100);
      weights[i] = std::abs(noise(std::uint64_t(i), 101));
    }
  }
  NormalEquations<6> equations() const {
    NormalEquations<6> out;
    for (int i = 0; i < 40; ++i) out.add(rows.row(i).transpose(), values[i], weights[i]);
    return out;
  }
  Eigen::VectorXd dense() const {
    const Eigen::VectorXd root = weights.cwiseSqrt();
    return (root.asDiagonal() * rows)
        .completeOrthogonalDecomposition()
        .solve(root.asDiagonal() * values);
  }
};

TEST(NormalEquations, SolveLeastSquaresAsADenseDecompositionDoes) {
  const Measured measured;
  EXPECT_LT((measured.equations().solve() - measured.dense()).norm(), 1e-12);
}

TEST(NormalEquations, OfPartsAddUp) {
  const Measured measured;
  NormalEquations<6> first, second;
  for (int i = 0; i < 40; ++i)
    (i < 13 ? first : second)
        .add(measured.rows.row(i).transpose(), measured.values[i], measured.weights[i]);
  first.add(second);
  EXPECT_LT((first.normal - measured.equations().normal).norm(), 1e-12);
  EXPECT_LT((first.right - measured.equations().right).norm(), 1e-12);
}

TEST(NormalEquations, FirmDirectionsMoveAndTheOthersStay) {
  const Measured measured(4);
  const FirmSolution firm = solve_firm(measured.equations(), 1e-3);
  EXPECT_EQ(firm.held_directions, 2);
  EXPECT_LT((firm.values - measured.dense()).norm(), 1e-12);
  EXPECT_EQ(firm.values[4], 0.0);
  EXPECT_EQ(firm.values[5], 0.0);
}

TEST(NormalEquations, WithAllDirectionsFirmTheSolutionIsTheLeastSquaresOne) {
  const Measured measured;
  const FirmSolution firm = solve_firm(measured.equations(), 1e-6);
  EXPECT_EQ(firm.held_directions, 0);
  EXPECT_LT((firm.values - measured.dense()).norm(), 1e-12);
}

TEST(NormalEquations, TheSandwichOfIndependentErrorsIsTheInverse) {
  const Eigen::MatrixXd normal = Measured().equations().normal;
  const Eigen::MatrixXd inverse = normal.inverse();
  EXPECT_LT((sandwich_covariance(inverse, normal) - inverse).norm(), 1e-12);
}

}  // namespace
}  // namespace turnscan::estimation
