#pragma once
// Where the entries of a sparse Cholesky factor will be, before any of them is computed.

#include <turnscan/geometry/sparse/sparse_cholesky.hpp>
#include <vector>

namespace turnscan::sparse {

using Order = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// Consecutive columns of the factor that have the same rows below them, and are one dense block.
struct Supernode {
  int first = 0, width = 0;   ///< columns
  std::vector<int> rows;      ///< below those columns, increasing
  int parent = -1;            ///< the supernode that holds rows.front(); -1: none
  std::vector<int> children;  ///< increasing

  std::size_t height() const { return std::size_t(width) + rows.size(); }
  /// Multiplications and additions of its own elimination, about.
  double work() const { return double(width) * double(height()) * double(height()); }
};

struct Symbolic {
  Order order;                        ///< takes the place in the factor to that in the matrix
  SparseMatrix lower;                 ///< lower triangle of the matrix in that order
  std::vector<Supernode> supernodes;  ///< children before their parents
  std::size_t entries = 0;            ///< of the factor, zeros that were let in included
};

/// Orders by approximate minimum degree, then along the elimination tree, and merges columns into
/// supernodes, small ones also where that lets zeros in (Ashcraft and Grimes 1989). Fails when
/// cancelled.
Result<Symbolic> analyze(const SparseMatrix& lower, const RunContext& context);

}  // namespace turnscan::sparse
