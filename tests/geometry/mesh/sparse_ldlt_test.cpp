#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <turnscan/geometry/mesh/sparse_ldlt.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan::mesh {
namespace {

using Dense = Eigen::MatrixXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr std::size_t kPlenty = std::size_t(1) << 30;

/// Symmetric positive definite with about `extra` random entries a row beside the diagonal.
Dense random_system(int n, int extra, std::uint64_t seed) {
  Dense a = Dense::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    a(i, i) += 0.1;
    for (int e = 0; e < extra; ++e) {
      const int j = int(hash_key(seed, std::uint64_t(i), std::uint64_t(e)) % std::uint64_t(n));
      const double w = 0.5 + 0.5 * std::abs(test::random_value(seed, std::uint64_t(i), 100));
      a(i, i) += w;
      a(j, j) += w;
      a(i, j) -= w;
      a(j, i) -= w;
    }
  }
  return a;
}

Sparse lower_of(const Dense& a) { return Dense(a.triangularView<Eigen::Lower>()).sparseView(); }

Columns3 random_right(int n) {
  Columns3 b(n, 3);
  for (int i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) b(i, c) = test::random_value(5, std::uint64_t(i), std::uint64_t(c));
  }
  return b;
}

TEST(SparseSystem, IsSolvedLikeADenseOne) {
  for (const int n : {1, 2, 3, 10, 50, 300}) {
    for (const int extra : {0, 1, 2, 5}) {
      const Dense a = random_system(n, extra, std::uint64_t(n + extra));
      const Columns3 b = random_right(n);
      const auto x = solve_sparse(lower_of(a), b, kPlenty, RunContext());
      ASSERT_TRUE(x) << x.error().text();
      const Dense expected = a.ldlt().solve(b);
      ASSERT_LT((Dense(*x) - expected).norm(), 1e-9 * (1.0 + expected.norm())) << n << " " << extra;
    }
  }
}

TEST(SparseSystem, FailsByName) {
  Dense a = random_system(40, 3, 1);
  const Columns3 b = random_right(40);
  EXPECT_EQ(solve_sparse(lower_of(a), b, 10, RunContext()).error().code, ErrorCode::kResourceLimit);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(solve_sparse(lower_of(a), b, kPlenty, context).error().code, ErrorCode::kCancelled);
  a(7, 7) = -1.0;
  EXPECT_EQ(solve_sparse(lower_of(a), b, kPlenty, RunContext()).error().code, ErrorCode::kLibrary);
}

}  // namespace
}  // namespace turnscan::mesh
