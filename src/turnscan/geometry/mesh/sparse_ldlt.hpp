#pragma once
// Direct solution of large symmetric positive definite sparse systems that can be cancelled while
// it factorises, which Eigen's cannot.

#include <Eigen/SparseCore>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::mesh {

using SparseMatrix = Eigen::SparseMatrix<double>;
using Columns3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// x with A x = right, A given by its lower triangle; duplicates summed. The factors are of the
/// form L D L^T after an approximate minimum degree ordering (Eigen's), computed row by row along
/// the elimination tree (Davis 2005, "Algorithm 849: a concise sparse Cholesky factorization").
/// Fails with kLibrary when A is not positive definite to rounding, kResourceLimit when the factors
/// would need over max_bytes, and when cancelled.
Result<Columns3> solve_sparse(const SparseMatrix& lower, const Columns3& right,
                              std::size_t max_bytes, const RunContext& context);

}  // namespace turnscan::mesh
