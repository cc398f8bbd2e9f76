#include <Eigen/OrderingMethods>
#include <algorithm>
#include <turnscan/geometry/sparse/supernodes.hpp>

namespace turnscan::sparse {
namespace {

/// Of the entries of a merged supernode, how many may be zeros; by its number of columns.
double allowed_zeros(double width) {
  if (width <= 4.0) return 1.0;
  if (width <= 16.0) return 0.4;
  return width <= 48.0 ? 0.1 : 0.05;
}

double entries_of(double width, double rows) { return width * (0.5 * (width + 1.0) + rows); }

SparseMatrix upper_in_order(const SparseMatrix& lower, const Order& order) {
  SparseMatrix upper(lower.rows(), lower.cols());
  upper.selfadjointView<Eigen::Upper>() =
      lower.selfadjointView<Eigen::Lower>().twistedBy(order.inverse());
  return upper;
}

/// Parent of each column: the first row below its diagonal in the factor (Liu 1990).
std::vector<int> elimination_tree(const SparseMatrix& upper) {
  const auto n = std::size_t(upper.cols());
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int k = 0; k < int(n); ++k) {
    for (SparseMatrix::InnerIterator it(upper, k); it; ++it) {
      for (int i = int(it.row()); i >= 0 && i < k;) {
        const int next = ancestor[std::size_t(i)];
        ancestor[std::size_t(i)] = k;
        if (next < 0) parent[std::size_t(i)] = k;
        i = next;
      }
    }
  }
  return parent;
}

/// Columns in an order in which each subtree is consecutive, and ends with its root.
std::vector<int> postorder(const std::vector<int>& parent) {
  const auto n = parent.size();
  std::vector<int> first_child(n, -1), sibling(n, -1), out, stack;
  for (auto k = int(n); k-- > 0;) {
    const int p = parent[std::size_t(k)];
    if (p < 0) continue;
    sibling[std::size_t(k)] = first_child[std::size_t(p)];
    first_child[std::size_t(p)] = k;
  }
  out.reserve(n);
  for (int root = 0; root < int(n); ++root) {
    if (parent[std::size_t(root)] >= 0) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const auto at = std::size_t(stack.back());
      if (first_child[at] >= 0) {
        stack.push_back(first_child[at]);
        first_child[at] = sibling[std::size_t(first_child[at])];
      } else {
        out.push_back(int(at));
        stack.pop_back();
      }
    }
  }
  return out;
}

/// Rows below the diagonal in each column of the factor.
std::vector<int> column_counts(const SparseMatrix& upper, const std::vector<int>& parent) {
  const auto n = parent.size();
  std::vector<int> count(n, 0), mark(n, -1);
  for (int k = 0; k < int(n); ++k) {
    mark[std::size_t(k)] = k;
    for (SparseMatrix::InnerIterator it(upper, k); it; ++it) {
      for (int i = int(it.row()); mark[std::size_t(i)] != k; i = parent[std::size_t(i)]) {
        ++count[std::size_t(i)];
        mark[std::size_t(i)] = k;
      }
    }
  }
  return count;
}

struct Columns {
  int first = 0, width = 0;
  double rows = 0.0, zeros = 0.0;

  double entries() const { return entries_of(width, rows); }
};

/// The columns of each supernode, in postorder.
std::vector<Columns> merge_columns(const std::vector<int>& parent, const std::vector<int>& count) {
  std::vector<Columns> out;
  for (int k = 0; k < int(parent.size());) {
    Columns now{k, 1, 0.0, 0.0};
    for (;
         parent[std::size_t(k)] == k + 1 && count[std::size_t(k)] == count[std::size_t(k) + 1] + 1;
         ++k)
      ++now.width;
    now.rows = double(count[std::size_t(k)]);
    ++k;
    while (!out.empty()) {
      const Columns& before = out.back();
      const int above = parent[std::size_t(before.first + before.width - 1)];
      if (above < now.first || above >= k) break;
      Columns both{before.first, before.width + now.width, now.rows, 0.0};
      both.zeros = both.entries() - before.entries() - now.entries() + before.zeros + now.zeros;
      if (both.zeros > allowed_zeros(both.width) * both.entries()) break;
      out.pop_back();
      now = both;
    }
    out.push_back(now);
  }
  return out;
}

void find_rows(Symbolic& symbolic, const std::vector<int>& supernode_of) {
  std::vector<int> mark(supernode_of.size(), -1);
  for (int s = 0; s < int(symbolic.supernodes.size()); ++s) {
    Supernode& node = symbolic.supernodes[std::size_t(s)];
    const int end = node.first + node.width;
    const auto add = [&](int row) {
      if (row < end || mark[std::size_t(row)] == s) return;
      mark[std::size_t(row)] = s;
      node.rows.push_back(row);
    };
    for (int k = node.first; k < end; ++k)
      for (SparseMatrix::InnerIterator it(symbolic.lower, k); it; ++it) add(int(it.row()));
    for (const int child : node.children)
      for (const int row : symbolic.supernodes[std::size_t(child)].rows) add(row);
    std::sort(node.rows.begin(), node.rows.end());
    symbolic.entries += node.height() * std::size_t(node.width);
    if (node.rows.empty()) continue;
    node.parent = supernode_of[std::size_t(node.rows.front())];
    symbolic.supernodes[std::size_t(node.parent)].children.push_back(s);
  }
}

}  // namespace

Result<Symbolic> analyze(const SparseMatrix& lower, const RunContext& context) {
  Symbolic out;
  {
    const SparseMatrix full = lower.selfadjointView<Eigen::Lower>();
    Eigen::AMDOrdering<int>()(full, out.order);
  }
  TURNSCAN_TRY(context.check());
  const std::vector<int> tree = elimination_tree(upper_in_order(lower, out.order));
  Order along(lower.rows());
  const std::vector<int> places = postorder(tree);
  std::copy(places.begin(), places.end(), along.indices().data());
  out.order = out.order * along;
  const SparseMatrix upper = upper_in_order(lower, out.order);
  out.lower = upper.transpose();
  const std::vector<int> parent = elimination_tree(upper);
  std::vector<int> supernode_of(parent.size());
  for (const Columns& c : merge_columns(parent, column_counts(upper, parent))) {
    for (int k = c.first; k < c.first + c.width; ++k)
      supernode_of[std::size_t(k)] = int(out.supernodes.size());
    out.supernodes.push_back({c.first, c.width, {}, -1, {}});
  }
  TURNSCAN_TRY(context.check());
  find_rows(out, supernode_of);
  return out;
}

}  // namespace turnscan::sparse
