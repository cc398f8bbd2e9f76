// Body of the kernels. Included by one source per instruction set, behind its own
// `struct Lanes` in an anonymous namespace; hence no include guard and no includes.

#define TURNSCAN_INLINE inline __attribute__((always_inline))

/// The k smallest squared distances so far of each lane, ascending.
template <int kFixed>
struct Nearest {
  static constexpr int kCapacity = kFixed > 0 ? kFixed : kMaxLaneK;
  Lanes best[kCapacity];
  int runtime_k;

  TURNSCAN_INLINE explicit Nearest(int k_in) : runtime_k(k_in) {
    for (int i = 0; i < k(); ++i) best[i] = Lanes::set(__builtin_inff());
  }
  TURNSCAN_INLINE int k() const { return kFixed > 0 ? kFixed : runtime_k; }
  TURNSCAN_INLINE const Lanes& worst() const { return best[k() - 1]; }
  TURNSCAN_INLINE void insert(Lanes d) {
    for (int i = k() - 1; i > 0; --i) best[i] = min(best[i], max(best[i - 1], d));
    best[0] = min(best[0], d);
  }
};

/// The points of kCount cells side by side.
struct Query {
  Lanes x, y, z;
  const Grid* grid;
  std::ptrdiff_t cell;
};

TURNSCAN_INLINE Lanes squared_distance(const Query& q, std::ptrdiff_t i) {
  const Lanes dx = q.x - Lanes::load(q.grid->x + i);
  const Lanes dy = q.y - Lanes::load(q.grid->y + i);
  const Lanes dz = q.z - Lanes::load(q.grid->z + i);
  return dx * dx + dy * dy + dz * dz;  // the order of flann::L2_Simple
}

template <int kFixed>
TURNSCAN_INLINE void visit(const Query& q, std::ptrdiff_t i, Nearest<kFixed>& nearest) {
  const Lanes d = squared_distance(q, i);
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

TURNSCAN_INLINE Lanes distance_beyond(const Border& border, std::ptrdiff_t column, Lanes u,
                                      Lanes w) {
  return Lanes::load(border.a + column) * w + Lanes::load(border.b + column) * u +
         Lanes::load(border.offset + column);
}

TURNSCAN_INLINE Lanes distance_beyond_row(const Border& border, std::ptrdiff_t row, Lanes v,
                                          Lanes w) {
  return Lanes::set(border.a[row]) * w + Lanes::set(border.b[row]) * v +
         Lanes::set(border.offset[row]);
}

/// Lanes whose `worst` no point outside the window of `ring` cells around them can better.
TURNSCAN_INLINE unsigned settled(const Query& q, int column, int row, int ring, Lanes worst) {
  const Grid& grid = *q.grid;
  const Lanes u = Lanes::load(grid.u + q.cell), v = Lanes::load(grid.v + q.cell);
  const Lanes w = Lanes::load(grid.w + q.cell);
  const Lanes columns = min(distance_beyond(grid.before_column, column - ring - 1, u, w),
                            distance_beyond(grid.beyond_column, column + ring + 1, u, w));
  const Lanes rows = min(distance_beyond_row(grid.before_row, row - ring - 1, v, w),
                         distance_beyond_row(grid.beyond_row, row + ring + 1, v, w));
  const Lanes size = absolute(q.x) + absolute(q.y) + absolute(q.z);
  const Lanes margin = Lanes::set(grid.margin) + Lanes::set(grid.margin_relative) * size;
  const Lanes bound = max(min(columns, rows) - margin, Lanes::set(0.0f));
  return less_equal(worst, bound * bound * Lanes::set(kShrink));
}

/// Rings that hold k points of a plane seen from the front.
TURNSCAN_INLINE int first_rings(int k) {
  int ring = 1;
  while (3 * ring * ring < k) ++ring;
  return ring;
}

/// A wider ring for all lanes costs more than a window of its own for this many.
constexpr int kFewLanes = Lanes::kCount / 4;

template <int kFixed>
TURNSCAN_INLINE std::size_t search_lanes(const Grid& grid, int column, int row, int k, float* mean,
                                         Unsettled* unsettled) {
  const std::ptrdiff_t cell = row * grid.stride + column;
  const Query q{Lanes::load(grid.x + cell), Lanes::load(grid.y + cell), Lanes::load(grid.z + cell),
                &grid, cell};
  const unsigned active = less(q.z, Lanes::set(0.5f * kHole));
  if (active == 0) return 0;
  Nearest<kFixed> nearest(k);
  const int first = first_rings(k);
  unsigned open = active;
  for (int ring = 1; ring <= kPad; ++ring) {
    visit_ring(q, ring, nearest);
    if (ring < first) continue;
    open = active & ~settled(q, column, row, ring, nearest.worst());
    if (__builtin_popcount(open) <= kFewLanes) break;
  }
  Lanes::store_mean(nearest.best, k, mean + column);
  if (open == 0) return 0;
  float worst[Lanes::kCount];
  nearest.worst().store(worst);
  std::size_t count = 0;
  for (; open != 0; open &= open - 1) {
    const int lane = __builtin_ctz(open);
    unsettled[count++] = {column + lane, row, worst[lane]};
  }
  return count;
}

template <int kFixed>
std::size_t search_row_k(const Grid& grid, int row, int k, float* mean, Unsettled* unsettled) {
  std::size_t count = 0;
  for (int column = 0; column < grid.columns; column += Lanes::kCount)
    count += search_lanes<kFixed>(grid, column, row, k, mean, unsettled + count);
  return count;
}

/// The default k keeps its list in registers.
std::size_t search_row(const Grid& grid, int row, int k, float* mean, Unsettled* unsettled) {
  return k == 10 ? search_row_k<10>(grid, row, k, mean, unsettled)
                 : search_row_k<0>(grid, row, k, mean, unsettled);
}

std::size_t collect(const Grid& grid, std::ptrdiff_t i, std::ptrdiff_t first, int n, float limit,
                    float* out) {
  const Query q{Lanes::set(grid.x[i]), Lanes::set(grid.y[i]), Lanes::set(grid.z[i]), &grid, i};
  std::size_t count = 0;
  for (int column = 0; column < n; column += Lanes::kCount) {
    const Lanes d = squared_distance(q, first + column);
    unsigned near = less_equal(d, Lanes::set(limit));
    if (n - column < Lanes::kCount) near &= (1u << (n - column)) - 1u;
    if (near == 0) continue;
    float values[Lanes::kCount];
    d.store(values);
    for (; near != 0; near &= near - 1) out[count++] = values[__builtin_ctz(near)];
  }
  return count;
}

constexpr Kernel kKernel{search_row, collect};
