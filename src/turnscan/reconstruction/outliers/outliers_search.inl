// Search among the points of a grid. Part of outliers_kernel.inl, in its anonymous namespace.

/// The k smallest squared distances so far of each lane, ascending.
template <int kFixed>
struct Nearest {
  static constexpr int kCapacity = kFixed > 0 ? kFixed : kMaxK;
  F best[kCapacity];
  int runtime_k;

  TURNSCAN_INLINE explicit Nearest(int k_in) : runtime_k(k_in) {
    for (int i = 0; i < k(); ++i) best[i] = all(__builtin_inff());
  }
  TURNSCAN_INLINE int k() const { return kFixed > 0 ? kFixed : runtime_k; }
  TURNSCAN_INLINE const F& worst() const { return best[k() - 1]; }
  TURNSCAN_INLINE void insert(F d) {
    for (int i = k() - 1; i > 0; --i) best[i] = smaller(best[i], larger(best[i - 1], d));
    best[0] = smaller(best[0], d);
  }
};

/// The points of kLanes cells side by side.
struct Query {
  F x, y, z;
  const Grid* grid;
  std::ptrdiff_t cell;
};

TURNSCAN_INLINE F squared_distance(const Query& q, std::ptrdiff_t i) {
  const F dx = q.x - load(q.grid->x + i);
  const F dy = q.y - load(q.grid->y + i);
  const F dz = q.z - load(q.grid->z + i);
  return dx * dx + dy * dy + dz * dz;  // the order of flann::L2_Simple
}

template <int kFixed>
TURNSCAN_INLINE void visit(const Query& q, std::ptrdiff_t i, Nearest<kFixed>& nearest) {
  const F d = squared_distance(q, i);
  if (less(d, nearest.worst())) nearest.insert(d);
}

template <int kFixed>
TURNSCAN_INLINE void visit_ring(const Query& q, int ring, Nearest<kFixed>& nearest) {
  const std::ptrdiff_t stride = q.grid->stride;
  for (int dy = 1 - ring; dy < ring; ++dy) {
    visit(q, q.cell + dy * stride - ring, nearest);
    visit(q, q.cell + dy * stride + ring, nearest);
  }
  for (int dx = -ring; dx <= ring; ++dx) {
    visit(q, q.cell - ring * stride + dx, nearest);
    visit(q, q.cell + ring * stride + dx, nearest);
  }
}

// --- lower bounds
// ---------------------------------------------------------------------------------

TURNSCAN_INLINE F to_column(const Border& border, std::ptrdiff_t column, int band, F u, F w) {
  column += band * border.band_stride;
  return load(border.a + column) * w + load(border.b + column) * u + load(border.offset + column);
}

TURNSCAN_INLINE F to_row(const Border& border, std::ptrdiff_t row, int band, F v, F w) {
  row += band * border.band_stride;
  return all(border.a[row]) * w + all(border.b[row]) * v + all(border.offset[row]);
}

/// Lower bound of the distance from each lane's point to those outside the window of `ring` cells
/// around it, before rounding. In bands it holds for points at most kBand columns or rows away.
TURNSCAN_INLINE F distance_outside(const Query& q, const Borders& borders, int column, int row,
                                   int ring) {
  const Grid& grid = *q.grid;
  const F u = load(grid.u + q.cell), v = load(grid.v + q.cell);
  const F w = load(grid.w + q.cell);
  const int row_band = row / kBand, column_band = column / kBand;
  const F columns = smaller(to_column(borders.before_column, column - ring - 1, row_band, u, w),
                            to_column(borders.beyond_column, column + ring + 1, row_band, u, w));
  const F rows = smaller(to_row(borders.before_row, row - ring - 1, column_band, v, w),
                         to_row(borders.beyond_row, row + ring + 1, column_band, v, w));
  return smaller(columns, rows);
}

struct Bounds {
  F far;     ///< distance of what the bands do not tell about
  F margin;  ///< rounding

  TURNSCAN_INLINE Bounds(const Query& q, int column, int row)
      : far(all(__builtin_inff())),
        margin(all(q.grid->margin) +
               all(q.grid->margin_relative) * (absolute(q.x) + absolute(q.y) + absolute(q.z))) {
    if (q.grid->bent) far = distance_outside(q, q.grid->whole, column, row, kBand);
  }
  /// Lower bound of the squared distances, as they are rounded.
  TURNSCAN_INLINE F squared(const Query& q, int column, int row, int ring) const {
    const Borders& borders = q.grid->bent ? q.grid->bands : q.grid->whole;
    const F distance = smaller(distance_outside(q, borders, column, row, ring), far) - margin;
    const F bound = larger(distance, all(0.0f));
    return bound * bound * all(kShrink);
  }
};

// --- one point in a window of its own
// -------------------------------------------------------------

/// Rows are looked at from the point's own outwards, each as far as the k-th distance reaches.
struct Window {
  const Grid& grid;
  const Query query;  ///< the same point in all lanes
  int column, row, k, first, last;
  float u, v, w, margin;
  std::uint64_t cells = 0;
  float best[kMaxK + 1];  ///< ascending, the point itself among them

  /// At least k neighbours are within the squared distance `limit`, which may be infinite.
  TURNSCAN_INLINE Window(const Grid& g, int c, int r, int k_in, float limit)
      : grid(g), query(spread(g, r * g.stride + c)), column(c), row(r), k(k_in) {
    const std::ptrdiff_t i = query.cell;
    u = grid.u[i], v = grid.v[i], w = grid.w[i];
    margin = grid.margin +
             grid.margin_relative * (__builtin_fabsf(grid.x[i]) + __builtin_fabsf(grid.y[i]) +
                                     __builtin_fabsf(grid.z[i]));
    // Distances equal to the limit need not be found: they are there already.
    for (int n = 0; n <= k; ++n) best[n] = limit;
    first = last = column;
    while (first > 0 && !clear(grid.whole.before_column, first - 1, u)) --first;
    while (last + 1 < grid.columns && !clear(grid.whole.beyond_column, last + 1, u)) ++last;
  }
  TURNSCAN_INLINE static Query spread(const Grid& g, std::ptrdiff_t i) {
    return {all(g.x[i]), all(g.y[i]), all(g.z[i]), &g, i};
  }
  /// Nothing there is nearer than the k-th distance.
  TURNSCAN_INLINE bool clear(const Border& border, int i, float across) const {
    const float distance = border.a[i] * w + border.b[i] * across + border.offset[i] - margin;
    return distance > 0.0f && distance * distance * kShrink >= best[k];
  }
  TURNSCAN_INLINE void insert(float d) {
    int i = k;
    for (; i > 0 && best[i - 1] > d; --i) best[i] = best[i - 1];
    best[i] = d;
  }
  TURNSCAN_INLINE void visit_row(int r) {
    while (first < column && clear(grid.whole.before_column, first, u)) ++first;
    while (last > column && clear(grid.whole.beyond_column, last, u)) --last;
    cells += std::uint64_t(last - first + 1);
    for (int c = first; c <= last; c += kLanes) {
      const F d = squared_distance(query, r * grid.stride + c);
      unsigned near = less(d, all(best[k]));
      if (last - c < kLanes - 1) near &= (2u << (last - c)) - 1u;
      if (near == 0) continue;
      float values[kLanes];
      store(values, d);
      for (; near != 0; near &= near - 1) {
        const float value = values[__builtin_ctz(near)];
        if (value < best[k]) insert(value);
      }
    }
  }
  TURNSCAN_INLINE void visit_rows() {
    visit_row(row);
    bool up = true, down = true;
    for (int step = 1; up || down; ++step) {
      up = up && row - step >= 0 && !clear(grid.whole.before_row, row - step, v);
      if (up) visit_row(row - step);
      down = down && row + step < grid.rows && !clear(grid.whole.beyond_row, row + step, v);
      if (down) visit_row(row + step);
    }
  }
  /// Sum of the roots in double and ascending, rounded once: as PCL does.
  TURNSCAN_INLINE float mean() const {
    double sum = 0.0;
    for (int i = 1; i <= k; ++i) sum += __builtin_sqrt(double(best[i]));
    return static_cast<float>(sum / k);
  }
};

float search_window(const Grid& grid, int column, int row, int k, float limit,
                    std::uint64_t& cells) {
  Window window(grid, column, row, k, limit);
  window.visit_rows();
  cells += window.cells;
  return window.mean();
}

// --- points side by side
// --------------------------------------------------------------------------

/// Rings that hold k points of a plane seen from the front.
TURNSCAN_INLINE int first_rings(int k) {
  int ring = 1;
  while (3 * ring * ring < k) ++ring;
  return ring;
}

/// For this many lanes a wider ring costs less than a window for each; fewer are worth one while
/// they are likely to be settled by it: while the k-th distance is at most twice the bound.
constexpr int kManyLanes = kLanes / 4;
constexpr float kLikely = 4.0f;

template <int kFixed>
TURNSCAN_INLINE std::uint64_t search_lanes(const Grid& grid, int column, int row, int k,
                                           float* mean) {
  const std::ptrdiff_t cell = row * grid.stride + column;
  const Query q{load(grid.x + cell), load(grid.y + cell), load(grid.z + cell), &grid, cell};
  const unsigned active = less(q.z, all(0.5f * kHole));
  if (active == 0) return 0;
  Nearest<kFixed> nearest(k);
  const Bounds bounds(q, column, row);
  const int first = first_rings(k);
  unsigned open = active;
  for (int ring = 1; ring <= kPad; ++ring) {
    visit_ring(q, ring, nearest);
    if (ring < first) continue;
    const F bound = bounds.squared(q, column, row, ring);
    open = active & ~less_equal(nearest.worst(), bound);
    const unsigned likely = open & less_equal(nearest.worst(), bound * all(kLikely));
    if (likely == 0 && __builtin_popcount(open) < kManyLanes) break;
  }
  store_mean(nearest.best, k, mean + column);
  if (open == 0) return 0;
  float worst[kLanes];
  store(worst, nearest.worst());
  std::uint64_t cells = 0;
  for (; open != 0; open &= open - 1) {
    const int lane = __builtin_ctz(open);
    mean[column + lane] = search_window(grid, column + lane, row, k, worst[lane], cells);
  }
  return cells;
}

template <int kFixed>
std::uint64_t search_row_k(const Grid& grid, int row, int k, float* mean) {
  std::uint64_t cells = 0;
  for (int column = 0; column < grid.columns; column += kLanes)
    cells += search_lanes<kFixed>(grid, column, row, k, mean);
  return cells;
}

/// The default k keeps its list in registers.
std::uint64_t search_row(const Grid& grid, int row, int k, float* mean) {
  return k == 10 ? search_row_k<10>(grid, row, k, mean) : search_row_k<0>(grid, row, k, mean);
}
