#include <Eigen/OrderingMethods>
#include <turnscan/geometry/mesh/sparse_ldlt.hpp>
#include <vector>

namespace turnscan::mesh {
namespace {

constexpr int kRowsBetweenChecks = 256;

class Factorization {
 public:
  /// `upper` holds the upper triangle of the permuted matrix, diagonal included.
  Factorization(const SparseMatrix& upper, const RunContext& context)
      : upper_(upper), context_(context), n_(int(upper.rows())) {}

  /// Elimination tree and the length of each column of L; returns the entries of L.
  std::size_t analyze() {
    parent_.assign(std::size_t(n_), -1);
    start_.assign(std::size_t(n_) + 1, 0);
    std::vector<int> mark(std::size_t(n_), -1);
    for (int k = 0; k < n_; ++k) {
      mark[std::size_t(k)] = k;
      for (SparseMatrix::InnerIterator it(upper_, k); it; ++it) {
        for (int i = int(it.row()); i < k && mark[std::size_t(i)] != k; i = parent(i)) {
          if (parent(i) < 0) parent_[std::size_t(i)] = k;
          ++start_[std::size_t(i) + 1];
          mark[std::size_t(i)] = k;
        }
      }
    }
    for (std::size_t k = 0; k < std::size_t(n_); ++k) start_[k + 1] += start_[k];
    return start_.back();
  }

  Result<> factorize() {
    row_.resize(start_.back());
    value_.resize(start_.back());
    diagonal_.resize(std::size_t(n_));
    filled_.assign(start_.begin(), start_.end() - 1);
    std::vector<double> y(std::size_t(n_), 0.0);
    std::vector<int> pattern(std::size_t(n_), 0), mark(std::size_t(n_), -1);
    for (int k = 0; k < n_; ++k) {
      if (k % kRowsBetweenChecks == 0) TURNSCAN_TRY(context_.check());
      const std::size_t top = row_pattern(k, y, pattern, mark);
      if (!eliminate_row(k, top, y, pattern)) {
        return fail(ErrorCode::kLibrary, "sparse system: not positive definite; check the mesh");
      }
    }
    return {};
  }

  void solve(Columns3& x) const {
    for (std::size_t k = 0; k < std::size_t(n_); ++k) {
      const Eigen::RowVector3d xk = x.row(Eigen::Index(k));
      for (std::size_t p = start_[k]; p < start_[k + 1]; ++p) x.row(row_[p]) -= value_[p] * xk;
    }
    for (std::size_t k = std::size_t(n_); k-- > 0;) {
      Eigen::RowVector3d xk = x.row(Eigen::Index(k)) / diagonal_[k];
      for (std::size_t p = start_[k]; p < start_[k + 1]; ++p) xk -= value_[p] * x.row(row_[p]);
      x.row(Eigen::Index(k)) = xk;
    }
  }

 private:
  int parent(int i) const { return parent_[std::size_t(i)]; }

  /// Scatters column k of the matrix into y, and the columns of L that reach row k into
  /// pattern[top..n), in the order of elimination; returns top.
  std::size_t row_pattern(int k, std::vector<double>& y, std::vector<int>& pattern,
                          std::vector<int>& mark) const {
    auto top = std::size_t(n_);
    mark[std::size_t(k)] = k;
    for (SparseMatrix::InnerIterator it(upper_, k); it; ++it) {
      y[std::size_t(it.row())] += it.value();
      std::size_t length = 0;
      for (int i = int(it.row()); mark[std::size_t(i)] != k; i = parent(i)) {
        pattern[length++] = i;
        mark[std::size_t(i)] = k;
      }
      while (length > 0) pattern[--top] = pattern[--length];
    }
    return top;
  }

  bool eliminate_row(int k, std::size_t top, std::vector<double>& y,
                     const std::vector<int>& pattern) {
    double d = y[std::size_t(k)];
    y[std::size_t(k)] = 0.0;
    for (; top < std::size_t(n_); ++top) {
      const auto i = std::size_t(pattern[top]);
      const double yi = y[i];
      y[i] = 0.0;
      const std::size_t end = filled_[i];
      for (std::size_t p = start_[i]; p < end; ++p) y[std::size_t(row_[p])] -= value_[p] * yi;
      const double l = yi / diagonal_[i];
      d -= l * yi;
      row_[end] = k;
      value_[end] = l;
      ++filled_[i];
    }
    diagonal_[std::size_t(k)] = d;
    return d > 0.0;
  }

  const SparseMatrix& upper_;
  const RunContext& context_;
  int n_;
  std::vector<int> parent_, row_;
  std::vector<std::size_t> start_, filled_;  // columns of L: where they start, how far they go
  std::vector<double> value_, diagonal_;
};

}  // namespace

Result<Columns3> solve_sparse(const SparseMatrix& lower, const Columns3& right,
                              std::size_t max_bytes, const RunContext& context) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse_order;
  {
    const SparseMatrix full = lower.selfadjointView<Eigen::Lower>();
    Eigen::AMDOrdering<int>()(full, inverse_order);
  }
  TURNSCAN_TRY(context.check());
  SparseMatrix upper(lower.rows(), lower.cols());
  upper.selfadjointView<Eigen::Upper>() =
      lower.selfadjointView<Eigen::Lower>().twistedBy(inverse_order.inverse());
  Factorization factors(upper, context);
  const std::size_t bytes = factors.analyze() * (sizeof(double) + sizeof(int));
  if (bytes > max_bytes) {
    return fail(ErrorCode::kResourceLimit,
                "sparse system: {} unknowns need {} MB; solve for fewer at a time", lower.rows(),
                bytes >> 20);
  }
  TURNSCAN_TRY(factors.factorize());
  Columns3 x = inverse_order.inverse() * right;
  factors.solve(x);
  return Columns3(inverse_order * x);
}

}  // namespace turnscan::mesh
