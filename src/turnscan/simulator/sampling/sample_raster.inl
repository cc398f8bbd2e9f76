// Part of sample_kernel.inl, behind sample_occlusion.inl.
//
// Draws the triangles of a scene into an image of a camera without distortion: of each pixel the
// nearest triangle. A pixel's ray d = (x, y, 1) meets a triangle a, b, c (sensor frame) where it
// lies on the same side of the three planes through the eye and an edge: the sign of
// d * ((q - p) x (q + p)) for each edge from p to q, which is how Embree's robust intersector
// decides (after Pluecker). It needs no division, so that triangles may reach behind the eye, and
// for an edge that two triangles share it is the same number but for the sign: no pixel falls
// between them. With N = (b - a) x (c - a), 1 / depth is N * d / N * a.
//
// Lanes are sixteen triangles for those that cover few pixels, sixteen pixels of a row for the
// others.

/// What has a corner nearer than this may be anywhere in the image.
constexpr float kBeforeEye_m = 1e-3f;
/// Rounding of the projection of a corner, in pixels, and the ends of what becomes an int.
constexpr float kBorder_px = 0.01f;
constexpr float kFarthest_px = 1e6f;
/// Pixels about a triangle up to which it is a lane.
constexpr int kFewPixels = 64;
/// As Embree: an edge within this share of the triangle's size counts as within.
constexpr float kEdge = 0x1p-23f;

struct Corner {
  F x, y, z;
};

/// Coefficients of a value that is linear in the direction.
struct Linear {
  F x, y, z;
  F at(const F& u, const F& v) const { return x * u + (y * v + z); }
};

inline F within(const F& v, float low, float high) {
  return smaller(larger(v, all(low)), all(high));
}
inline I round_down(const F& v) {
  const I cut = whole(v);
  return cut + (real(cut) > v ? all(-1) : I{});
}
inline I round_up(const F& v) {
  const I cut = whole(v);
  return cut - (real(cut) < v ? all(-1) : I{});
}
/// Takes out the lowest bit.
inline int next_bit(unsigned& set) {
  const int bit = __builtin_ctz(set);
  set &= set - 1;
  return bit;
}

inline Corner corner_of(const BodyView& body, const float* from) {
  const float* r = body.rotation;
  const F x = load(from) - body.origin[0], y = load(from + kLanes) - body.origin[1],
          z = load(from + 2 * kLanes) - body.origin[2];
  return {r[0] * x + r[3] * y + r[6] * z, r[1] * x + r[4] * y + r[7] * z,
          r[2] * x + r[5] * y + r[8] * z};
}

/// The plane through the eye and the edge from p to q.
inline Linear edge(const Corner& p, const Corner& q) {
  const F ex = q.x - p.x, ey = q.y - p.y, ez = q.z - p.z;
  const F sx = q.x + p.x, sy = q.y + p.y, sz = q.z + p.z;
  return {ey * sz - ez * sy, ez * sx - ex * sz, ex * sy - ey * sx};
}

inline void turn(Linear& v, const F& by) {
  v.x *= by;
  v.y *= by;
  v.z *= by;
}

/// Sixteen triangles, ready to be drawn.
struct Facets {
  Linear edges[3];  ///< not negative within
  Linear nearness;
};

inline Facets facets_of(const Corner* c) {
  Facets f{{edge(c[0], c[1]), edge(c[1], c[2]), edge(c[2], c[0])}, {}};
  const F ux = c[1].x - c[0].x, uy = c[1].y - c[0].y, uz = c[1].z - c[0].z;
  const F vx = c[2].x - c[0].x, vy = c[2].y - c[0].y, vz = c[2].z - c[0].z;
  f.nearness = {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
  const F to = f.nearness.x * c[0].x + f.nearness.y * c[0].y + f.nearness.z * c[0].z;
  turn(f.nearness, 1.0f / to);
  // A triangle met before the eye is turned so that its edges' numbers are positive within. An edge
  // that two triangles share keeps its number: only the sign changes.
  const F side = to < 0.0f ? all(1.0f) : all(-1.0f);
  for (Linear& e : f.edges) turn(e, side);
  return f;
}

/// Whether the direction is within; nearness tells where.
inline I inside(const Facets& f, const F& x, const F& y) {
  const F a = f.edges[0].at(x, y), b = f.edges[1].at(x, y), c = f.edges[2].at(x, y);
  return smaller(a, smaller(b, c)) >= -kEdge * absolute(a + b + c);
}

/// Pixels about each of sixteen triangles.
struct Rects {
  I left, top, right, bottom;
  I some;  ///< those with any pixel
};

/// What lies between low and high, in pixels.
inline void clip(const F& low, const F& high, int from, int to, I& first, I& end) {
  first = round_up(within(low - kBorder_px, -kFarthest_px, kFarthest_px));
  end = round_down(within(high + kBorder_px, -kFarthest_px, kFarthest_px)) + 1;
  first = first > from ? first : all(from);
  end = end < to ? end : all(to);
}

inline Rects rects_of(const View& view, const Window& frame, const Corner* c) {
  const F near = smaller(c[0].z, smaller(c[1].z, c[2].z)),
          far = larger(c[0].z, larger(c[1].z, c[2].z));
  const F ra = 1.0f / c[0].z, rb = 1.0f / c[1].z, rc = 1.0f / c[2].z;
  Rects r;
  const F ua = c[0].x * ra, ub = c[1].x * rb, uc = c[2].x * rc;
  clip(view.fx * smaller(ua, smaller(ub, uc)) + view.cx,
       view.fx * larger(ua, larger(ub, uc)) + view.cx, frame.left, frame.right, r.left, r.right);
  const F va = c[0].y * ra, vb = c[1].y * rb, vc = c[2].y * rc;
  clip(view.fy * smaller(va, smaller(vb, vc)) + view.cy,
       view.fy * larger(va, larger(vb, vc)) + view.cy, frame.top, frame.bottom, r.top, r.bottom);
  const I cut = near <= kBeforeEye_m;
  r.left = cut ? all(frame.left) : r.left;
  r.right = cut ? all(frame.right) : r.right;
  r.top = cut ? all(frame.top) : r.top;
  r.bottom = cut ? all(frame.bottom) : r.bottom;
  r.some = (r.left < r.right) & (r.top < r.bottom) & (far > 0.0f);
  return r;
}

/// Where two lie equally near the lower slot wins, so that the order does not matter.
inline void put_pixel(const Canvas& canvas, std::size_t at, float nearness, std::uint32_t slot) {
  const float before = canvas.nearness[at];
  if (!(nearness > before) && (nearness != before || slot >= canvas.slot[at])) return;
  canvas.nearness[at] = nearness;
  canvas.slot[at] = slot;
}

/// Those of sixteen triangles that have few pixels about them, one pixel of each at a time.
inline void draw_lanes(const View& view, const Facets& f, const Rects& r, const I& few,
                       std::uint32_t slot, const Canvas& canvas) {
  const int width = canvas.frame.right - canvas.frame.left;
  const float dx = 1.0f / view.fx, dy = 1.0f / view.fy;
  const float x0 = -view.cx * dx, y0 = -view.cy * dy;
  I column = r.left, row = r.top, left = few;
  while (bits(left) != 0) {
    const F x = real(column) * dx + x0, y = real(row) * dy + y0;
    const F nearness = f.nearness.at(x, y);
    const I hit = left & inside(f, x, y) & (nearness > 0.0f) & (nearness < kInfinity);
    if (unsigned set = bits(hit)) {
      alignas(64) float value[kLanes];
      alignas(64) int place[kLanes];
      store(value, nearness);
      store(place, (row - canvas.frame.top) * width + (column - canvas.frame.left));
      while (set != 0) {
        const int i = next_bit(set);
        put_pixel(canvas, std::size_t(place[i]), value[i], slot + unsigned(i));
      }
    }
    column += 1;
    const I next = column >= r.right;
    column = next ? r.left : column;
    row -= next;
    left &= row < r.bottom;
  }
}

/// One triangle, sixteen pixels of a row at a time.
inline void draw_rows(const View& view, const Facets& f, const Rects& r, int lane,
                      std::uint32_t slot, const Canvas& canvas) {
  Facets one;
  for (int k = 0; k < 3; ++k)
    one.edges[k] = {all(f.edges[k].x[lane]), all(f.edges[k].y[lane]), all(f.edges[k].z[lane])};
  one.nearness = {all(f.nearness.x[lane]), all(f.nearness.y[lane]), all(f.nearness.z[lane])};
  const int width = canvas.frame.right - canvas.frame.left;
  const float dx = 1.0f / view.fx, dy = 1.0f / view.fy;
  const float x0 = -view.cx * dx, y0 = -view.cy * dy;
  for (int row = r.top[lane]; row < r.bottom[lane]; ++row) {
    // Where the edges cross the row, and a pixel more.
    const float v = float(row) * dy + y0;
    float low = float(r.left[lane]), high = float(r.right[lane] - 1);
    for (int k = 0; k < 3; ++k) {
      const float a = f.edges[k].x[lane], rest = f.edges[k].y[lane] * v + f.edges[k].z[lane];
      const float cross = (-rest / a) * view.fx + view.cx;
      if (a > 0.0f && cross - 1.0f > low) low = cross - 1.0f;
      if (a < 0.0f && cross + 1.0f < high) high = cross + 1.0f;
    }
    if (!(low <= high)) continue;
    const int end = int(high) + 1 < r.right[lane] ? int(high) + 1 : r.right[lane];
    const std::size_t start =
        std::size_t(row - canvas.frame.top) * std::size_t(width) - std::size_t(canvas.frame.left);
    for (int column = int(low) > r.left[lane] ? int(low) : r.left[lane]; column < end;
         column += kLanes) {
      const I u = counting() + column;
      const F x = real(u) * dx + x0, y = all(v);
      const std::size_t at = start + std::size_t(column);
      const F nearness = one.nearness.at(x, y), before = load(canvas.nearness + at);
      const I had = load<I>(canvas.slot + at);
      // As unsigned numbers.
      const I lower = (had ^ all(int(0x80000000u))) > int(slot ^ 0x80000000u);
      const I hit = inside(one, x, y) & (u < end) & (nearness < kInfinity) & (nearness > 0.0f) &
                    ((nearness > before) | ((nearness == before) & lower));
      if (bits(hit) == 0) continue;
      store(canvas.nearness + at, hit ? nearness : before);
      store(canvas.slot + at, hit ? all(int(slot)) : had);
    }
  }
}

inline void draw_group(const View& view, const BodyView& body, std::uint32_t group,
                       const Canvas& canvas) {
  const float* from = body.clusters.corners + std::size_t(group) * 9 * kLanes;
  const Corner c[3] = {corner_of(body, from), corner_of(body, from + 3 * kLanes),
                       corner_of(body, from + 6 * kLanes)};
  const Rects r = rects_of(view, canvas.frame, c);
  if (bits(r.some) == 0) return;
  const Facets f = facets_of(c);
  const I few = r.some & ((r.right - r.left) * (r.bottom - r.top) <= kFewPixels);
  const std::uint32_t slot = body.first_slot + group * kLanes;
  draw_lanes(view, f, r, few, slot, canvas);
  unsigned many = bits(r.some & ~few);
  while (many != 0) {
    const int lane = next_bit(many);
    draw_rows(view, f, r, lane, slot + unsigned(lane), canvas);
  }
}
