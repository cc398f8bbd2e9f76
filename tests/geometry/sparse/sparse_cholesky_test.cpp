#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/sparse/supernodes.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan::sparse {
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
      const auto x = solve(lower_of(a), b, kPlenty, RunContext());
      ASSERT_TRUE(x) << x.error().text();
      const Dense expected = a.ldlt().solve(b);
      ASSERT_LT((Dense(*x) - expected).norm(), 1e-9 * (1.0 + expected.norm())) << n << " " << extra;
    }
  }
}

/// A bent plate of side^2 vertices, held at its border, as relax() solves it.
Sparse plate(int side) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_square = [&](int x, int y) {
    std::vector<std::pair<int, double>> row;
    for (const auto& [dx, dy, weight] :
         {std::tuple(0, 0, 4.0), {1, 0, -1.0}, {-1, 0, -1.0}, {0, 1, -1.0}, {0, -1, -1.0}})
      if (x + dx >= 0 && y + dy >= 0 && x + dx < side && y + dy < side)
        row.emplace_back((y + dy) * side + x + dx, weight);
    for (const auto& [i, a] : row)
      for (const auto& [j, b] : row)
        if (j <= i) entries.emplace_back(i, j, a * b);
  };
  for (int y = -1; y <= side; ++y)
    for (int x = -1; x <= side; ++x) add_square(x, y);
  Sparse out(side * side, side * side);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

TEST(SparseSystem, OfALargePlateIsSolvedToRounding) {
  const Sparse lower = plate(200);
  const Columns3 b = random_right(int(lower.rows()));
  const auto x = solve(lower, b, kPlenty, RunContext());
  ASSERT_TRUE(x) << x.error().text();
  const Columns3 product = lower.selfadjointView<Eigen::Lower>() * *x;
  EXPECT_LT((product - b).norm(), 1e-6 * b.norm());
}

TEST(SparseSystem, HasTheSameBitsForAnyNumberOfThreads) {
  const Sparse lower = plate(90);
  const Columns3 b = random_right(int(lower.rows()));
  std::vector<Columns3> solutions;
  for (const int threads : {1, 2, 5}) {
    set_thread_count(threads);
    solutions.push_back(*solve(lower, b, kPlenty, RunContext()));
  }
  set_thread_count(0);
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
}

/// What elimination fills, one column after another.
std::vector<std::vector<bool>> filled(const Symbolic& symbolic) {
  const auto n = std::size_t(symbolic.lower.rows());
  std::vector<std::vector<bool>> out(n, std::vector<bool>(n, false));
  for (int k = 0; k < int(n); ++k)
    for (Sparse::InnerIterator it(symbolic.lower, k); it; ++it)
      out[std::size_t(k)][std::size_t(it.row())] = true;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = i; out[k][i] && j < n; ++j)
        if (out[k][j]) out[i][j] = true;
  return out;
}

TEST(Supernodes, HoldAllThatEliminationFills) {
  for (const Sparse& lower :
       {plate(9), lower_of(random_system(60, 2, 3)), lower_of(random_system(50, 0, 1))}) {
    const auto symbolic = analyze(lower, RunContext());
    ASSERT_TRUE(symbolic);
    const auto fill = filled(*symbolic);
    std::size_t columns = 0, entries = 0;
    for (std::size_t s = 0; s < symbolic->supernodes.size(); ++s) {
      const Supernode& node = symbolic->supernodes[s];
      EXPECT_EQ(std::size_t(node.first), columns) << "each column is in one of them";
      columns += std::size_t(node.width);
      entries += std::size_t(node.width) * node.height();
      for (const int child : node.children) EXPECT_LT(std::size_t(child), s);
      for (int k = node.first; k < node.first + node.width; ++k)
        for (std::size_t i = std::size_t(node.first + node.width); i < fill.size(); ++i)
          EXPECT_TRUE(!fill[std::size_t(k)][i] ||
                      std::binary_search(node.rows.begin(), node.rows.end(), int(i)));
    }
    EXPECT_EQ(columns, fill.size());
    EXPECT_EQ(entries, symbolic->entries);
  }
}

TEST(SparseSystem, FailsByName) {
  Dense a = random_system(40, 3, 1);
  const Columns3 b = random_right(40);
  EXPECT_EQ(solve(lower_of(a), b, 10, RunContext()).error().code, ErrorCode::kResourceLimit);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(solve(lower_of(a), b, kPlenty, context).error().code, ErrorCode::kCancelled);
  a(7, 7) = -1.0;
  EXPECT_EQ(solve(lower_of(a), b, kPlenty, RunContext()).error().code, ErrorCode::kLibrary);
}

}  // namespace
}  // namespace turnscan::sparse
