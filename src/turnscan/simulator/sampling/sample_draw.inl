// Draws bodies into the canvas, and takes an image's samples from there. Part of sample_kernel.inl,
// behind sample_raster.inl. Groups of triangles come near ones first; one that lies behind what is
// drawn everywhere in its place is left out.

/// How often what is drawn is looked through for tiles without a gap, and how much nearer than a
/// tile's farthest pixel a group must be to be drawn there.
constexpr int kRounds = 12;
constexpr int kMinRound = 96;
constexpr float kTileMargin = 1.0f + 0x1p-16f;
constexpr int kDepthSteps = 32;

/// Sixteen boxes as the sensor sees them.
struct BoxViews {
  unsigned some;  ///< those that may be in the frame
  Rects rects;
  I cut;  ///< these may be anywhere
  F nearness;
};

inline BoxViews view_boxes(const View& view, const BodyView& body, const Window& frame,
                           const GroupBoxes& boxes, int first) {
  const float* r = body.rotation;
  const float* from = boxes.bounds + std::size_t(first) * 6;
  const Corner c = corner_of(body, from);
  const F hx = load(from + 3 * kLanes), hy = load(from + 4 * kLanes), hz = load(from + 5 * kLanes);
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
  const GroupBoxes* levels = body.clusters.levels;
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
              v.cut[i] != 0 ? canvas.frame : Window{s.left[i], s.top[i], s.right[i], s.bottom[i]}};
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
        low = smaller(
            low, load(canvas.nearness + std::size_t(v) * std::size_t(width) + std::size_t(column)));
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
  const Window& f = seen.frame;
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
  const int round = count / kRounds > kMinRound ? count / kRounds : kMinRound;
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
  unsigned left = bits(valid & (load(canvas.nearness + at) > 0.0f));
  while (left != 0) {
    const BodyView& body = body_of(view, canvas.slot[at + unsigned(__builtin_ctz(left))]);
    alignas(64) int object[kLanes], triangle[kLanes];
    store(object, all(-1));
    store(triangle, I{});
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
inline void add_platters(const View& view, const Canvas& canvas, const Window& where) {
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
        const F before = load(canvas.nearness + at), nearness = 1.0f / p.z;
        store(canvas.nearness + at, nearness > before ? nearness : before);
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
inline void finish_image(const View& view, const Directions& directions, const Window& frame,
                         const Canvas& canvas, const Output& out) {
  const bool by_rays = view.two_eyed && view.baseline == 0.0f;
  embree::Query query(true);
  const int width = frame.right - frame.left, stride = canvas.frame.right - canvas.frame.left;
  for (int row = frame.top; row < frame.bottom; ++row) {
    for (int left = frame.left; left < frame.right; left += kLanes) {
      Packet p;
      load_tile<kLanes>(directions, frame, left, row, p);
      const std::size_t from = std::size_t(row - canvas.frame.top) * std::size_t(stride) +
                               std::size_t(left - canvas.frame.left);
      const I valid = counting() + left < frame.right;
      take(view, canvas, from, valid, p);
      finish(view, valid, by_rays, query, p);
      const std::size_t at =
          std::size_t(row - frame.top) * std::size_t(width) + std::size_t(left - frame.left);
      if (frame.right - left >= kLanes)
        write(p, 0, kLanes, at, out);
      else
        write(p, 0, frame.right - left, at, out);
    }
  }
}

void draw_image(const View& view, const Directions& directions, const Window& frame,
                const Canvas& canvas, const Output& out) {
  clear(canvas);
  for (int b = 0; b < view.body_count; ++b) draw_body(view, view.bodies[b], canvas);
  finish_image(view, directions, frame, canvas, out);
  if (!view.two_eyed || view.baseline == 0.0f) return;
  const Window& c = canvas.frame;
  const Window beyond[4] = {{c.left, c.top, frame.left, c.bottom},
                            {frame.right, c.top, c.right, c.bottom},
                            {c.left, c.top, c.right, frame.top},
                            {c.left, frame.bottom, c.right, c.bottom}};
  for (const Window& part : beyond) add_platters(view, canvas, part);
  occlude_image(view, directions, frame, &canvas, out);
}
