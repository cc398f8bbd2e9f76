#include <Eigen/Cholesky>
#include <algorithm>
#include <atomic>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/sparse/supernodes.hpp>

namespace turnscan::sparse {
namespace {

using Dense = Eigen::MatrixXd;
using Block = Eigen::Ref<Dense, 0, Eigen::OuterStride<>>;

/// Subtrees with less than this share of all work are eliminated beside each other, each on one
/// core; the supernodes above them one after another, each on all.
constexpr double kSubtreeShare = 1.0 / 16.0;
constexpr Eigen::Index kBlock = 128;

class Factorization {
 public:
  Factorization(const Symbolic& symbolic, const RunContext& context)
      : symbolic_(symbolic),
        context_(context),
        panels_(symbolic.supernodes.size()),
        updates_(symbolic.supernodes.size()) {}

  Result<> factorize() {
    const std::vector<int> roots = subtree_roots();
    parallel_for(roots.size(), 1, [&](std::size_t k) { eliminate_subtree(roots[k]); });
    for (std::size_t s = 0; s < panels_.size(); ++s)
      if (panels_[s].size() == 0) eliminate(int(s));
    TURNSCAN_TRY(context_.check());
    if (indefinite_)
      return fail(ErrorCode::kLibrary, "sparse system: not positive definite; check the mesh");
    return {};
  }

  /// x: in the order of the factor.
  void solve(Columns3& x) const {
    for (std::size_t s = 0; s < panels_.size(); ++s) {
      const Supernode& node = symbolic_.supernodes[s];
      auto own = x.middleRows(node.first, node.width);
      panels_[s].topRows(node.width).triangularView<Eigen::Lower>().solveInPlace(own);
      const Columns3 below = panels_[s].bottomRows(node.rows.size()) * own;
      for (std::size_t i = 0; i < node.rows.size(); ++i)
        x.row(node.rows[i]) -= below.row(Eigen::Index(i));
    }
    for (std::size_t s = panels_.size(); s-- > 0;) {
      const Supernode& node = symbolic_.supernodes[s];
      Columns3 below(node.rows.size(), 3);
      for (std::size_t i = 0; i < node.rows.size(); ++i)
        below.row(Eigen::Index(i)) = x.row(node.rows[i]);
      auto own = x.middleRows(node.first, node.width);
      own -= panels_[s].bottomRows(node.rows.size()).transpose() * below;
      panels_[s].topRows(node.width).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
    }
  }

 private:
  std::vector<int> subtree_roots() const {
    const auto& nodes = symbolic_.supernodes;
    std::vector<double> work(nodes.size(), 0.0);
    for (std::size_t s = 0; s < nodes.size(); ++s) {
      work[s] += nodes[s].work();
      if (nodes[s].parent >= 0) work[std::size_t(nodes[s].parent)] += work[s];
    }
    double all = 0.0;
    for (const Supernode& node : nodes) all += node.work();
    std::vector<int> out;
    for (std::size_t s = 0; s < nodes.size(); ++s) {
      const bool small = work[s] <= kSubtreeShare * all;
      const int parent = nodes[s].parent;
      if (small && (parent < 0 || work[std::size_t(parent)] > kSubtreeShare * all))
        out.push_back(int(s));
    }
    return out;
  }

  /// A subtree is consecutive, and ends with its root.
  void eliminate_subtree(int root) {
    int first = root;
    while (!symbolic_.supernodes[std::size_t(first)].children.empty())
      first = symbolic_.supernodes[std::size_t(first)].children.front();
    for (int s = first; s <= root; ++s) eliminate(s);
  }

  void eliminate(int s) {
    if (indefinite_ || context_.cancelled()) return;
    const Supernode& node = symbolic_.supernodes[std::size_t(s)];
    Dense& panel = panels_[std::size_t(s)];
    Dense& update = updates_[std::size_t(s)];
    panel = Dense::Zero(Eigen::Index(node.height()), node.width);
    update = Dense::Zero(Eigen::Index(node.rows.size()), Eigen::Index(node.rows.size()));
    add_matrix(node, panel);
    for (const int child : node.children) {
      add_child(symbolic_.supernodes[std::size_t(child)], updates_[std::size_t(child)], node, panel,
                update);
      updates_[std::size_t(child)] = {};
    }
    Block diagonal = panel.topRows(node.width);
    if (Eigen::LLT<Block>(diagonal).info() != Eigen::Success) {
      indefinite_ = true;
      return;
    }
    const auto rows = Eigen::Index(node.rows.size());
    for_each_block(rows, [&](Eigen::Index begin, Eigen::Index count) {
      auto below = panel.middleRows(node.width + begin, count);
      diagonal.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    });
    const auto below = panel.bottomRows(rows);
    for_each_block(rows, [&](Eigen::Index begin, Eigen::Index count) {
      const auto columns = below.middleRows(begin, count);
      update.block(begin, begin, count, count)
          .selfadjointView<Eigen::Lower>()
          .rankUpdate(columns, -1.0);
      const Eigen::Index rest = rows - begin - count;
      update.block(begin + count, begin, rest, count).noalias() -=
          below.bottomRows(rest) * columns.transpose();
    });
  }

  template <class Body>
  static void for_each_block(Eigen::Index rows, const Body& body) {
    parallel_for(std::size_t((rows + kBlock - 1) / kBlock), 1, [&](std::size_t k) {
      const Eigen::Index begin = Eigen::Index(k) * kBlock;
      body(begin, std::min(kBlock, rows - begin));
    });
  }

  void add_matrix(const Supernode& node, Dense& panel) const {
    for (int k = 0; k < node.width; ++k) {
      std::size_t at = 0;
      for (SparseMatrix::InnerIterator it(symbolic_.lower, node.first + k); it; ++it)
        panel(local_row(node, int(it.row()), at), k) += it.value();
    }
  }

  /// Adds what the elimination of a child leaves in the rows that it shares with its parent.
  static void add_child(const Supernode& child, const Dense& left, const Supernode& node,
                        Dense& panel, Dense& update) {
    std::vector<Eigen::Index> place(child.rows.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = local_row(node, child.rows[i], at);
    for (std::size_t c = 0; c < place.size(); ++c) {
      const bool own = place[c] < node.width;
      for (std::size_t r = c; r < place.size(); ++r) {
        const double value = left(Eigen::Index(r), Eigen::Index(c));
        if (own)
          panel(place[r], place[c]) += value;
        else
          update(place[r] - node.width, place[c] - node.width) += value;
      }
    }
  }

  /// Where a row is in the block of a supernode that has it. at: how far its rows were searched
  /// for the ones before.
  static Eigen::Index local_row(const Supernode& node, int row, std::size_t& at) {
    if (row < node.first + node.width) return row - node.first;
    while (node.rows[at] != row) ++at;
    return Eigen::Index(node.width) + Eigen::Index(at);
  }

  const Symbolic& symbolic_;
  const RunContext& context_;
  std::vector<Dense> panels_;   ///< of the factor: own columns, lower triangle, then the rows below
  std::vector<Dense> updates_;  ///< of each supernode, lower triangle, until its parent has them
  std::atomic<bool> indefinite_{false};
};

}  // namespace

Result<Columns3> solve(const SparseMatrix& lower, const Columns3& right, std::size_t max_bytes,
                       const RunContext& context) {
  TURNSCAN_ASSIGN(const Symbolic symbolic, analyze(lower, context));
  const std::size_t bytes = symbolic.entries * sizeof(double);
  if (bytes > max_bytes) {
    return fail(ErrorCode::kResourceLimit,
                "sparse system: {} unknowns need {} MB; solve for fewer at a time", lower.rows(),
                bytes >> 20);
  }
  Factorization factors(symbolic, context);
  TURNSCAN_TRY(factors.factorize());
  Columns3 x = symbolic.order.inverse() * right;
  factors.solve(x);
  return Columns3(symbolic.order * x);
}

}  // namespace turnscan::sparse
