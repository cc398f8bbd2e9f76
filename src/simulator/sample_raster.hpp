// Included by the sources of the kernels, behind sample_occlusion.hpp.
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
// others. Triangles come in groups of sixteen neighbours, near ones first; a group behind what is
// drawn everywhere in its place is left out.

/// What has a corner nearer than this may be anywhere in the image.
constexpr float kBeforeEye_m = 1e-3f;
/// Rounding of the projection of a corner, in pixels, and the ends of what becomes an int.
constexpr float kBorder_px = 0.01f;
constexpr float kFarthest_px = 1e6f;
/// Pixels about a triangle up to which it is a lane.
constexpr int kFewPixels = 64;
/// As Embree: an edge within this share of the triangle's size counts as within.
constexpr float kEdge = 0x1p-23f;
/// How often what is drawn is looked through for tiles without a gap, and how much nearer than a
/// tile's farthest pixel a group must be to be drawn there.
constexpr int kRounds = 12;
constexpr int kLeastRound = 96;
constexpr float kTileMargin = 1.0f + 0x1p-16f;
constexpr int kDepthSteps = 32;

struct Corner {
  F x, y, z;
};

/// Coefficients of a value that is linear in the direction.
struct Linear {
  F x, y, z;
  F at(const F& u, const F& v) const { return x * u + (y * v + z); }
};

inline F least(const F& a, const F& b) { return a < b ? a : b; }
inline F most(const F& a, const F& b) { return a > b ? a : b; }
inline F within(const F& v, float low, float high) { return least(most(v, all(low)), all(high)); }
inline I whole(const F& v) { return __builtin_convertvector(v, I); }
inline F real(const I& v) { return __builtin_convertvector(v, F); }
inline I round_down(const F& v) {
  const I cut = whole(v);
  return cut + (real(cut) > v ? all(-1) : I{});
}
inline I round_up(const F& v) {
  const I cut = whole(v);
  return cut - (real(cut) < v ? all(-1) : I{});
}
inline I counting() {
  I v;
  for (int i = 0; i < kLanes; ++i) v[i] = i;
  return v;
}

/// A bit for each lane of a mask (lanes are 0 or -1).
inline unsigned bits(const I& mask) {
#if defined(__AVX512DQ__)
  using V = int __attribute__((vector_size(64)));
  return unsigned(__builtin_ia32_cvtd2mask512(static_cast<V>(mask)));
#elif defined(__AVX__)
  using V = float __attribute__((vector_size(32)));
  V half[2];
  __builtin_memcpy(half, &mask, sizeof half);
  return unsigned(__builtin_ia32_movmskps256(half[0])) |
         unsigned(__builtin_ia32_movmskps256(half[1])) << 8;
#elif defined(__SSE2__)
  using V = float __attribute__((vector_size(16)));
  V part[4];
  __builtin_memcpy(part, &mask, sizeof part);
  unsigned out = 0;
  for (int k = 0; k < 4; ++k) out |= unsigned(__builtin_ia32_movmskps(part[k])) << 4 * k;
  return out;
#else
  unsigned out = 0;
  for (int i = 0; i < kLanes; ++i) out |= mask[i] != 0 ? 1u << i : 0u;
  return out;
#endif
}

/// Takes out the lowest bit.
inline int next_bit(unsigned& set) {
  const int bit = __builtin_ctz(set);
  set &= set - 1;
  return bit;
}

inline Corner corner_of(const BodyView& body, const float* from) {
  const float* r = body.rotation;
  const F x = get<F>(from) - body.origin[0], y = get<F>(from + kLanes) - body.origin[1],
          z = get<F>(from + 2 * kLanes) - body.origin[2];
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
  return least(a, least(b, c)) >= -kEdge * absolute(a + b + c);
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

inline Rects rects_of(const View& view, const Frame& frame, const Corner* c) {
  const F near = least(c[0].z, least(c[1].z, c[2].z)), far = most(c[0].z, most(c[1].z, c[2].z));
  const F ra = 1.0f / c[0].z, rb = 1.0f / c[1].z, rc = 1.0f / c[2].z;
  Rects r;
  const F ua = c[0].x * ra, ub = c[1].x * rb, uc = c[2].x * rc;
  clip(view.fx * least(ua, least(ub, uc)) + view.cx, view.fx * most(ua, most(ub, uc)) + view.cx,
       frame.left, frame.right, r.left, r.right);
  const F va = c[0].y * ra, vb = c[1].y * rb, vc = c[2].y * rc;
  clip(view.fy * least(va, least(vb, vc)) + view.cy, view.fy * most(va, most(vb, vc)) + view.cy,
       frame.top, frame.bottom, r.top, r.bottom);
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
      put(nearness, value);
      put((row - canvas.frame.top) * width + (column - canvas.frame.left), place);
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
      const F nearness = one.nearness.at(x, y), before = get<F>(canvas.nearness + at);
      const I had = get<I>(canvas.slot + at);
      // As unsigned numbers.
      const I lower = (had ^ all(int(0x80000000u))) > int(slot ^ 0x80000000u);
      const I hit = inside(one, x, y) & (u < end) & (nearness < kInfinity) & (nearness > 0.0f) &
                    ((nearness > before) | ((nearness == before) & lower));
      if (bits(hit) == 0) continue;
      put(hit ? nearness : before, canvas.nearness + at);
      put(hit ? all(int(slot)) : had, canvas.slot + at);
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

/// Sixteen boxes as the sensor sees them.
struct BoxViews {
  unsigned some;  ///< those that may be in the frame
  Rects rects;
  I cut;  ///< these may be anywhere
  F nearness;
};

inline BoxViews view_boxes(const View& view, const BodyView& body, const Frame& frame,
                           const Boxes& boxes, int first) {
  const float* r = body.rotation;
  const float* from = boxes.bounds + std::size_t(first) * 6;
  const Corner c = corner_of(body, from);
  const F hx = get<F>(from + 3 * kLanes), hy = get<F>(from + 4 * kLanes),
          hz = get<F>(from + 5 * kLanes);
  const auto half = [&](int k) {
    const auto size = [](float v) { return v < 0.0f ? -v : v; };
    return size(r[k]) * hx + size(r[3 + k]) * hy + size(r[6 + k]) * hz;
  };
  // Of the centre the rounding is that of the origin and of the corners.
  const F slack = kLift * (absolute(c.x) + absolute(c.y) + absolute(c.z) + view.size);
  const F ex = half(0) + slack, ey = half(1) + slack, ez = half(2) + slack;
  const F near = c.z - ez, far = c.z + ez, rn = 1.0f / near, rf = 1.0f / far;
  const auto low = [&](const F& v) { return v * (v < 0.0f ? rn : rf); };
  const auto high = [&](const F& v) { return v * (v < 0.0f ? rf : rn); };
  BoxViews out;
  clip(view.fx * low(c.x - ex) + view.cx, view.fx * high(c.x + ex) + view.cx, frame.left,
       frame.right, out.rects.left, out.rects.right);
  clip(view.fy * low(c.y - ey) + view.cy, view.fy * high(c.y + ey) + view.cy, frame.top,
       frame.bottom, out.rects.top, out.rects.bottom);
  out.cut = near <= kBeforeEye_m;
  out.nearness = out.cut ? all(kInfinity) : rn;
  out.some =
      bits((far > 0.0f) &
           (out.cut | ((out.rects.left < out.rects.right) & (out.rects.top < out.rects.bottom))) &
           (counting() < boxes.count - first));
  return out;
}

/// The groups that may be in the frame.
inline int find_groups(const View& view, const BodyView& body, const Canvas& canvas) {
  const Boxes* levels = body.clusters.levels;
  int count = 0;
  for (int far = 0; far < levels[2].count; far += kLanes) {
    for (unsigned top = view_boxes(view, body, canvas.frame, levels[2], far).some; top != 0;) {
      const int block = (far + next_bit(top)) * kLanes;
      for (unsigned set = view_boxes(view, body, canvas.frame, levels[1], block).some; set != 0;) {
        const int first = (block + next_bit(set)) * kLanes;
        const BoxViews v = view_boxes(view, body, canvas.frame, levels[0], first);
        for (unsigned groups = v.some; groups != 0;) {
          const int i = next_bit(groups);
          const Rects& s = v.rects;
          canvas.seen[count++] = {
              std::uint32_t(first + i), v.nearness[i],
              v.cut[i] != 0 ? canvas.frame : Frame{s.left[i], s.top[i], s.right[i], s.bottom[i]}};
        }
      }
    }
  }
  return count;
}

/// Their order from near to far, in steps.
inline void sort_groups(const Canvas& canvas, int count) {
  float low = kInfinity, high = 0.0f;
  for (int i = 0; i < count; ++i) {
    const float v = canvas.seen[i].nearness;
    low = v < low ? v : low;
    high = v < kInfinity && v > high ? v : high;
  }
  const float scale = high > low ? float(kDepthSteps - 2) / (high - low) : 0.0f;
  const auto step = [&](int i) {
    const float v = canvas.seen[i].nearness;
    return v < kInfinity ? 1 + int((high - v) * scale) : 0;
  };
  int start[kDepthSteps + 1] = {};
  for (int i = 0; i < count; ++i) ++start[step(i) + 1];
  for (int s = 0; s < kDepthSteps; ++s) start[s + 1] += start[s];
  for (int i = 0; i < count; ++i) canvas.order[start[step(i)]++] = std::uint32_t(i);
}

/// Of each tile the least nearness: 0 where there is a gap. What stands beside it lowers it, too.
inline void find_tiles(const Canvas& canvas) {
  const int width = canvas.frame.right - canvas.frame.left;
  const int height = canvas.frame.bottom - canvas.frame.top;
  const int across = (width + kTile - 1) / kTile;
  for (int row = 0; row < height; row += kTile) {
    const int end = row + kTile < height ? row + kTile : height;
    for (int column = 0; column < width; column += kLanes) {
      F low = all(kInfinity);
      for (int v = row; v < end; ++v)
        low = least(low, get<F>(canvas.nearness + std::size_t(v) * std::size_t(width) +
                                std::size_t(column)));
      for (int half = 0; half < 2; ++half) {
        float value = kInfinity;
        for (int i = half * kTile; i < (half + 1) * kTile; ++i)
          value = low[i] < value ? low[i] : value;
        // The last of a row may have no second tile; the next row then overwrites it.
        canvas.tiles[row / kTile * across + column / kTile + half] = value;
      }
    }
  }
}

inline bool hidden(const Canvas& canvas, const GroupView& seen) {
  const Frame& f = seen.frame;
  const int across = (canvas.frame.right - canvas.frame.left + kTile - 1) / kTile;
  const float bound = seen.nearness * kTileMargin;
  for (int v = (f.top - canvas.frame.top) / kTile; v <= (f.bottom - 1 - canvas.frame.top) / kTile;
       ++v)
    for (int u = (f.left - canvas.frame.left) / kTile;
         u <= (f.right - 1 - canvas.frame.left) / kTile; ++u)
      if (!(bound < canvas.tiles[v * across + u])) return false;
  return true;
}

inline void draw_body(const View& view, const BodyView& body, const Canvas& canvas) {
  const int count = find_groups(view, body, canvas);
  sort_groups(canvas, count);
  // Looking through the tiles must pay.
  const int round = count / kRounds > kLeastRound ? count / kRounds : kLeastRound;
  for (int k = 0; k < count; ++k) {
    if (k > 0 && k % round == 0) find_tiles(canvas);
    const GroupView& seen = canvas.seen[canvas.order[k]];
    if (k < round || !hidden(canvas, seen)) draw_group(view, body, seen.group, canvas);
  }
}

inline const BodyView& body_of(const View& view, std::uint32_t slot) {
  int b = view.body_count - 1;
  while (b > 0 && slot < view.bodies[b].first_slot) --b;
  return view.bodies[b];
}

/// What sixteen pixels in a row see, from what is drawn there.
inline void take(const View& view, const Canvas& canvas, std::size_t at, const I& valid,
                 Packet& p) {
  begin(p);
  unsigned left = bits(valid & (get<F>(canvas.nearness + at) > 0.0f));
  while (left != 0) {
    const BodyView& body = body_of(view, canvas.slot[at + unsigned(__builtin_ctz(left))]);
    alignas(64) int object[kLanes], triangle[kLanes];
    put(all(-1), object);
    put(I{}, triangle);
    for (unsigned set = left; set != 0;) {
      const int i = next_bit(set);
      const std::uint32_t slot = canvas.slot[at + unsigned(i)];
      if (view.body_count > 1 && &body_of(view, slot) != &body) continue;
      const TriangleName& name = body.clusters.names[slot - body.first_slot];
      object[i] = int(name.object);
      triangle[i] = int(name.triangle);
      left &= ~(1u << i);
    }
    locate(body, object, triangle, p);
  }
  for (int b = 0; b < view.body_count; ++b) meet_platter(view.bodies[b], valid, p);
}

/// The platters, where the canvas goes on beyond the image.
inline void add_platters(const View& view, const Canvas& canvas, const Frame& where) {
  const float dx = 1.0f / view.fx, dy = 1.0f / view.fy;
  const int width = canvas.frame.right - canvas.frame.left;
  for (int b = 0; b < view.body_count; ++b) {
    if (view.bodies[b].platter_radius_squared < 0.0f) continue;
    for (int row = where.top; row < where.bottom; ++row) {
      for (int column = where.left; column < where.right; column += kLanes) {
        const I u = counting() + column;
        Packet p;
        p.x = (real(u) - view.cx) * dx;
        p.y = (real(all(row)) - view.cy) * dy;
        begin(p);
        meet_platter(view.bodies[b], u < where.right, p);
        const std::size_t at = std::size_t(row - canvas.frame.top) * std::size_t(width) +
                               std::size_t(column - canvas.frame.left);
        const F before = get<F>(canvas.nearness + at), nearness = 1.0f / p.z;
        put(nearness > before ? nearness : before, canvas.nearness + at);
      }
    }
  }
}

inline void clear(const Canvas& canvas) {
  const std::size_t size = std::size_t(canvas.frame.right - canvas.frame.left) *
                           std::size_t(canvas.frame.bottom - canvas.frame.top);
  __builtin_memset(canvas.nearness, 0, size * sizeof(float));
}

/// The image's pixels from what is drawn.
inline void finish_image(const View& view, const Directions& directions, const Frame& frame,
                         const Canvas& canvas, const Output& out) {
  const bool by_rays = view.two_eyed && view.baseline == 0.0f;
  RTCIntersectContext context = coherent();
  const int width = frame.right - frame.left, stride = canvas.frame.right - canvas.frame.left;
  for (int row = frame.top; row < frame.bottom; ++row) {
    for (int left = frame.left; left < frame.right; left += kLanes) {
      Packet p;
      load<kLanes>(directions, frame, left, row, p);
      const std::size_t from = std::size_t(row - canvas.frame.top) * std::size_t(stride) +
                               std::size_t(left - canvas.frame.left);
      const I valid = counting() + left < frame.right;
      take(view, canvas, from, valid, p);
      finish(view, valid, by_rays, context, p);
      const std::size_t at =
          std::size_t(row - frame.top) * std::size_t(width) + std::size_t(left - frame.left);
      if (frame.right - left >= kLanes)
        store(p, 0, kLanes, at, out);
      else
        store(p, 0, frame.right - left, at, out);
    }
  }
}

void draw_image(const View& view, const Directions& directions, const Frame& frame,
                const Canvas& canvas, const Output& out) {
  clear(canvas);
  for (int b = 0; b < view.body_count; ++b) draw_body(view, view.bodies[b], canvas);
  finish_image(view, directions, frame, canvas, out);
  if (!view.two_eyed || view.baseline == 0.0f) return;
  const Frame& c = canvas.frame;
  const Frame beyond[4] = {{c.left, c.top, frame.left, c.bottom},
                           {frame.right, c.top, c.right, c.bottom},
                           {c.left, c.top, c.right, frame.top},
                           {c.left, frame.bottom, c.right, c.bottom}};
  for (const Frame& part : beyond) add_platters(view, canvas, part);
  occlude_image(view, directions, frame, &canvas, out);
}
