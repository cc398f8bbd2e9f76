#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/outliers/outliers_kernel.hpp>
#include <turnscan/reconstruction/outliers/outliers_tree.hpp>
#include <vector>

namespace turnscan::outliers {

namespace {

struct Item {
  std::array<float, 3> p;
  std::uint32_t id;
};

/// Leaves [first, first + count) of the tree.
struct Subtree {
  std::size_t first, count;
};

/// How many of the leaves go to the lower side: a power of two, so that aligned groups of leaves
/// are subtrees.
std::size_t lower_leaves(const Subtree& s) { return std::bit_floor(s.count - 1); }

void split(std::vector<Item>& items, const Subtree& s) {
  const auto begin = items.begin() + std::ptrdiff_t(s.first * kLeaf);
  const auto end =
      items.begin() + std::ptrdiff_t(std::min(items.size(), (s.first + s.count) * kLeaf));
  std::array<float, 3> low = begin->p, high = begin->p;
  for (auto i = begin; i != end; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], i->p[a]);
      high[a] = std::max(high[a], i->p[a]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
  std::nth_element(begin, begin + std::ptrdiff_t(lower_leaves(s) * kLeaf), end,
                   [axis](const Item& a, const Item& b) { return a.p[axis] < b.p[axis]; });
}

void split_all(std::vector<Item>& items, const Subtree& s) {
  if (s.count < 2) return;
  split(items, s);
  const std::size_t lower = lower_leaves(s);
  split_all(items, {s.first, lower});
  split_all(items, {s.first + lower, s.count - lower});
}

/// Orders the points by leaf; leaf i holds items [i * kLeaf, (i + 1) * kLeaf).
void order(std::vector<Item>& items, const RunContext& context) {
  constexpr std::size_t kSerialLeaves = 256;
  std::vector<Subtree> open{{0, (items.size() + kLeaf - 1) / kLeaf}};
  while (open.front().count > kSerialLeaves && !context.cancelled()) {
    parallel_for(open.size(), 1, [&](std::size_t i) {
      if (open[i].count > 1) split(items, open[i]);
    });
    std::vector<Subtree> next;
    for (const Subtree& s : open) {
      const std::size_t lower = s.count > 1 ? lower_leaves(s) : s.count;
      next.push_back({s.first, lower});
      if (s.count > lower) next.push_back({s.first + lower, s.count - lower});
    }
    open.swap(next);
  }
  parallel_for(open.size(), 1, [&](std::size_t i) {
    if (!context.cancelled()) split_all(items, open[i]);
  });
}

/// Owns what a Tree points to.
class TreeStorage {
 public:
  explicit TreeStorage(const std::vector<Item>& items) {
    const std::size_t leaves = (items.size() + kLeaf - 1) / kLeaf;
    for (std::size_t a = 0; a < 3; ++a) {
      axes_[a].assign(leaves * kLeaf, kHole);
      parallel_for(items.size(), 65536, [&](std::size_t i) { axes_[a][i] = items[i].p[a]; });
    }
    boxes_.push_back(empty_boxes(leaves));
    parallel_for(leaves, 1024, [&](std::size_t leaf) { bound_leaf(leaf, items.size()); });
    for (std::size_t count = leaves; count > kLeaf;) {
      const std::size_t groups = (count + kLeaf - 1) / kLeaf;
      AxisBoxes upper = empty_boxes(groups);
      for (std::size_t i = 0; i < count; ++i) join(boxes_.back(), i, upper, i / kLeaf);
      boxes_.push_back(std::move(upper));
      count = groups;
    }
    tree_ = {axes_[0].data(), axes_[1].data(),    axes_[2].data(),
             items.size(),    int(boxes_.size()), {}};
    for (std::size_t l = 0; l < boxes_.size(); ++l)
      for (std::size_t a = 0; a < 3; ++a) {
        tree_.level[l].low[a] = boxes_[l].low[a].data();
        tree_.level[l].high[a] = boxes_[l].high[a].data();
      }
  }
  const Tree& tree() const { return tree_; }

 private:
  struct AxisBoxes {
    std::array<std::vector<float>, 3> low, high;
  };
  /// Boxes that nothing is near to, up to a whole group.
  static AxisBoxes empty_boxes(std::size_t count) {
    const std::size_t padded = (count + kLeaf - 1) / kLeaf * kLeaf;
    AxisBoxes boxes;
    for (std::size_t a = 0; a < 3; ++a) {
      boxes.low[a].assign(padded, kHole);
      boxes.high[a].assign(padded, -kHole);
    }
    return boxes;
  }
  void bound_leaf(std::size_t leaf, std::size_t points) {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto begin = axes_[a].begin() + std::ptrdiff_t(leaf * kLeaf);
      const auto end = axes_[a].begin() + std::ptrdiff_t(std::min(points, (leaf + 1) * kLeaf));
      const auto [low, high] = std::minmax_element(begin, end);
      boxes_[0].low[a][leaf] = *low;
      boxes_[0].high[a][leaf] = *high;
    }
  }
  static void join(const AxisBoxes& from, std::size_t i, AxisBoxes& to, std::size_t j) {
    for (std::size_t a = 0; a < 3; ++a) {
      to.low[a][j] = std::min(to.low[a][j], from.low[a][i]);
      to.high[a][j] = std::max(to.high[a][j], from.high[a][i]);
    }
  }

  std::array<std::vector<float>, 3> axes_;
  std::vector<AxisBoxes> boxes_;
  Tree tree_{};
};

}  // namespace

Result<> tree_mean_distances(std::span<const Vec3f> points, int k, const RunContext& context,
                             std::span<float> mean) {
  std::vector<Item> items(points.size());
  parallel_for(points.size(), 65536, [&](std::size_t i) {
    items[i] = {{points[i].x(), points[i].y(), points[i].z()}, std::uint32_t(i)};
  });
  order(items, context);
  TURNSCAN_TRY(context.check());
  const TreeStorage storage(items);
  const std::size_t leaves = (items.size() + kLeaf - 1) / kLeaf;
  const auto search = OutlierKernels::current().search_leaf;
  parallel_for(leaves, 32, [&](std::size_t leaf) {
    if (context.cancelled()) return;
    float found[kLeaf] = {};
    search(storage.tree(), leaf, k, found);
    const std::size_t end = std::min(items.size(), (leaf + 1) * kLeaf);
    for (std::size_t i = leaf * kLeaf; i < end; ++i) mean[items[i].id] = found[i - leaf * kLeaf];
  });
  return context.check();
}

}  // namespace turnscan::outliers
