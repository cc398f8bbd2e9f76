#pragma once
// Direct solution of large symmetric positive definite sparse systems: on all cores, and it can be
// cancelled while it factorises, which Eigen's cannot.

#include <Eigen/SparseCore>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::sparse {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// x with A x = right, A given by its lower triangle; duplicates summed. Multifrontal Cholesky
/// factorisation (Liu 1992, "The multifrontal method for sparse matrix solution") after an
/// approximate minimum degree ordering (Eigen's); the same bits for any number of threads. Fails
/// with kLibrary when A is not positive definite to rounding, kResourceLimit when the factors would
/// need over max_bytes, and when cancelled.
Result<Columns3> solve(const SparseMatrix& lower, const Columns3& right, std::size_t max_bytes,
                       const RunContext& context);

}  // namespace turnscan::sparse
