// Search among points without a grid. Part of outliers_kernel.inl, behind outliers_search.inl.

/// Added to the distances of one candidate: infinite in the lane of the candidate itself.
struct NotItself {
  float plus[2 * kMaxLanes] = {};
  constexpr NotItself() { plus[kMaxLanes] = __builtin_inff(); }
  TURNSCAN_INLINE F lane(int i) const { return load(plus + kMaxLanes - i); }
};
constexpr NotItself kNotItself;

/// Some points of a leaf side by side look for their neighbours. A bound is computed with the
/// operations of the distance, each of which is monotone with its rounding: no slack is needed.
template <int kFixed>
struct LeafSearch {
  const Tree& tree;
  F x, y, z;
  Nearest<kFixed> nearest;
  float low[3], high[3];  ///< box of the points
  float worst;            ///< largest k-th squared distance of theirs
  int count;              ///< points; further lanes find nothing

  TURNSCAN_INLINE LeafSearch(const Tree& t, std::size_t first, int n, int k)
      : tree(t),
        x(load(t.x + first)),
        y(load(t.y + first)),
        z(load(t.z + first)),
        nearest(k),
        worst(__builtin_inff()),
        count(n) {
    const float* const axes[3] = {t.x + first, t.y + first, t.z + first};
    for (int a = 0; a < 3; ++a) {
      low[a] = high[a] = axes[a][0];
      for (int i = 1; i < n; ++i) {
        low[a] = axes[a][i] < low[a] ? axes[a][i] : low[a];
        high[a] = axes[a][i] > high[a] ? axes[a][i] : high[a];
      }
    }
    if (n == kLanes) return;
    float limit[kLanes] = {};
    for (int i = 0; i < n; ++i) limit[i] = __builtin_inff();
    for (int i = 0; i < nearest.k(); ++i) nearest.best[i] = load(limit);
  }

  TURNSCAN_INLINE F squared_distance_to(std::size_t i) const {
    const F dx = x - all(tree.x[i]), dy = y - all(tree.y[i]);
    const F dz = z - all(tree.z[i]);
    return dx * dx + dy * dy + dz * dz;  // the order of flann::L2_Simple
  }
  TURNSCAN_INLINE void update_worst() {
    float values[kLanes];
    store(values, nearest.worst());
    worst = values[0];
    for (int i = 1; i < count; ++i) worst = values[i] > worst ? values[i] : worst;
  }
  /// The leaf that the points are of, from position `lane` in it.
  TURNSCAN_INLINE void visit_own(std::size_t leaf, int lane) {
    for (int i = 0; i < kLeaf; ++i) {
      F d = squared_distance_to(leaf * kLeaf + std::size_t(i));
      if (i >= lane && i < lane + kLanes) d = d + kNotItself.lane(i - lane);
      if (less(d, nearest.worst())) nearest.insert(d);
    }
    update_worst();
  }
  TURNSCAN_INLINE F gap(F before, F behind) const {
    return larger(larger(before, behind), all(0.0f));
  }
  void visit_leaf(std::size_t leaf) {
    const Boxes& b = tree.level[0];
    const F gx = gap(all(b.low[0][leaf]) - x, x - all(b.high[0][leaf]));
    const F gy = gap(all(b.low[1][leaf]) - y, y - all(b.high[1][leaf]));
    const F gz = gap(all(b.low[2][leaf]) - z, z - all(b.high[2][leaf]));
    if (!less(gx * gx + gy * gy + gz * gz, nearest.worst())) return;
    for (std::size_t i = leaf * kLeaf; i < (leaf + 1) * kLeaf; ++i) {
      const F d = squared_distance_to(i);
      if (less(d, nearest.worst())) nearest.insert(d);
    }
    update_worst();
  }
  TURNSCAN_INLINE F gap_of_boxes(const Boxes& b, int axis, std::size_t first) const {
    return gap(load(b.low[axis] + first) - all(high[axis]),
               all(low[axis]) - load(b.high[axis] + first));
  }
  /// Which of the boxes from `first` on may hold a nearer point.
  TURNSCAN_INLINE unsigned near_boxes(int level, std::size_t first) const {
    unsigned near = 0;
    for (int i = 0; i < kLeaf; i += kLanes) {
      const std::size_t at = first + std::size_t(i);
      const F gx = gap_of_boxes(tree.level[level], 0, at);
      const F gy = gap_of_boxes(tree.level[level], 1, at);
      const F gz = gap_of_boxes(tree.level[level], 2, at);
      near |= less(gx * gx + gy * gy + gz * gz, all(worst)) << i;
    }
    return near;
  }
  /// Boxes [first, first + kLeaf) of a level except `own`, nearest in the tree first.
  void visit_boxes(int level, std::size_t first, std::size_t own) {
    const unsigned near = near_boxes(level, first);
    for (std::size_t step = own == kNone ? 0 : 1; step < kLeaf; ++step) {
      const std::size_t child = own == kNone ? step : (own % kLeaf) ^ step;
      if (!(near >> child & 1u)) continue;
      if (level == 0)
        visit_leaf(first + child);
      else
        visit_boxes(level - 1, (first + child) * kLeaf, kNone);
    }
  }
  static constexpr std::size_t kNone = ~std::size_t{0};
};

template <int kFixed>
TURNSCAN_INLINE void search_leaf_k(const Tree& tree, std::size_t leaf, int k, float* mean) {
  for (int lane = 0; lane < kLeaf; lane += kLanes) {
    const std::size_t first = leaf * kLeaf + std::size_t(lane);
    if (first >= tree.points) return;
    const std::size_t left = tree.points - first;
    const int n = left < std::size_t(kLanes) ? int(left) : kLanes;
    LeafSearch<kFixed> search(tree, first, n, k);
    search.visit_own(leaf, lane);
    std::size_t own = leaf;
    for (int level = 0; level < tree.levels; ++level, own /= kLeaf)
      search.visit_boxes(level, own / kLeaf * kLeaf, own);
    store_mean(search.nearest.best, k, mean + lane);
  }
}

/// The default k keeps its list in registers.
void search_leaf(const Tree& tree, std::size_t leaf, int k, float* mean) {
  if (k == 10)
    search_leaf_k<10>(tree, leaf, k, mean);
  else
    search_leaf_k<0>(tree, leaf, k, mean);
}
