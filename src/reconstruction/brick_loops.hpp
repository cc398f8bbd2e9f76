// Included by the sources of the kernel, each within a namespace of its own, after kLanes, F, I,
// smaller, larger, gather and bits. Each lane is on its own: their number changes nothing.

inline F load(const float* from) {
  F v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
inline void store(float* to, const F& v) { __builtin_memcpy(to, &v, sizeof v); }
inline F all(float value) { return value - F{}; }
inline I all(int value) { return value - I{}; }
inline F real(const I& v) { return __builtin_convertvector(v, F); }

inline float dot(const float* row, const float p[3]) {
  return row[0] * p[0] + row[1] * p[1] + row[2] * p[2];
}

/// A position in the view's frame.
struct Place {
  float x, y, z;
};
inline Place place(const View& f, const float first[3]) {
  return {dot(f.rows, first) + f.shift[0], dot(f.rows + 3, first) + f.shift[1],
          dot(f.rows + 6, first) + f.shift[2]};
}

/// Image points, plus (right, down). inverse: 1 / z.
template <Lens kLens>
inline void project(const View& f, const F& x, const F& y, const F& inverse, float right,
                    float down, F& u, F& v) {
  if constexpr (kLens == Lens::kPinhole) {
    u = x * inverse + (f.cx + right);
    v = y * inverse + (f.cy + down);
  } else {
    F a = x * inverse, b = y * inverse;
    if constexpr (kLens == Lens::kDistorted) {
      const F r2 = a * a + b * b, ab = a * b;
      const F radial = 1.0f + r2 * (f.k1 + r2 * (f.k2 + r2 * f.k3));
      const F da = a * radial + 2.0f * f.p1 * ab + f.p2 * (r2 + 2.0f * a * a);
      b = b * radial + f.p1 * (r2 + 2.0f * b * b) + 2.0f * f.p2 * ab;
      a = da;
    }
    u = a * f.fx + (f.cx + right);
    v = b * f.fy + (f.cy + down);
  }
}

template <Lens kLens>
inline F inverse_depth(const F& z) {
  if constexpr (kLens == Lens::kParallel) return all(1.0f);
  return 1.0f / larger(z, all(1e-6f));
}

/// Of the pixels, or of every second one, that begin at these image points; outside it is the
/// nearest one of the border.
inline I pixel(const View& f, const F& u, const F& v, int shift, int width) {
  const F right = all(static_cast<float>(f.width - 1)),
          down = all(static_cast<float>(f.height - 1));
  const I pu = __builtin_convertvector(smaller(larger(u, F{}), right), I);
  const I pv = __builtin_convertvector(smaller(larger(v, F{}), down), I);
  return (pv >> shift) * width + (pu >> shift);
}

/// Masks of boxes.
struct Boxes {
  I clear, surface, partly;
};

/// What is known of boxes from the bounds around their middles.
template <Lens kLens>
inline Boxes judge(const View& f, const Level& level, const F& x, const F& y, const F& z) {
  F u, v;
  project<kLens>(f, x, y, inverse_depth<kLens>(z), 0.5f - level.half_u, 0.5f - level.half_v, u, v);
  const I at = 2 * pixel(f, u, v, level.shift, level.width);
  const I depth = gather(level.bounds, at), free = gather(level.bounds + 1, at);
  const F back = z + (level.half_z + f.truncation), front = z - (level.half_z + f.truncation);
  const F seen = z - (level.half_z - f.clear_share * f.truncation);
  const F nearest = real(depth & 0xffff) * f.unit + f.bias;
  const I farthest = depth >> 16 & 0xffff, most = free >> 16 & 0xffff, least = free & 0xffff;
  const I measured = (farthest > 0) & (nearest < back) & (real(farthest) * f.unit + f.bias > front);
  const I past = (least > 0) & (real(least) * f.unit + f.bias > back);
  const I some = (most > 0) & (real(most) * f.unit + f.bias > seen);
  const I looked = z > all(level.least_z), near = z < all(level.nearest);
  const I surface = looked & (near | measured), clear = looked & ~surface & past;
  return {clear, surface, looked & ~surface & ~clear & some};
}

template <Lens kLens>
Sights group(const View& f, const float first[3]) {
  const Place p = place(f, first);
  const float* middle = f.middle_of_brick;
  const float x = p.x + middle[0], y = p.y + middle[1], z = p.z + middle[2];
  Sights out{0, 0, 0};
  for (std::size_t l = 0; l < kGroup; l += kLanes) {
    const Boxes boxes = judge<kLens>(f, f.bricks, x + 8.0f * load(f.x + l),
                                     y + 8.0f * load(f.y + l), z + 8.0f * load(f.z + l));
    out.clear |= static_cast<std::uint64_t>(bits(boxes.clear)) << l;
    out.surface |= static_cast<std::uint64_t>(bits(boxes.surface)) << l;
    out.partly |= static_cast<std::uint64_t>(bits(boxes.partly)) << l;
  }
  return out;
}

template <Lens kLens>
PartSights parts(const View& f, const float first[3]) {
  const Place p = place(f, first);
  const float* middle = f.middle_of_part;
  const float x = p.x + middle[0], y = p.y + middle[1], z = p.z + middle[2];
  PartSights out{0, 0};
  for (std::size_t l = 0; l < kParts; l += kLanes) {
    const Boxes boxes = judge<kLens>(f, f.parts, x + load(f.part_x + l), y + load(f.part_y + l),
                                     z + load(f.part_z + l));
    out.surface |= bits(boxes.surface) << l;
    out.partly |= bits(boxes.partly | boxes.clear) << l;
  }
  out.surface &= 255u, out.partly &= 255u;
  return out;
}

/// How much longer the ray through a place is than its part along z.
template <Lens kLens>
inline float slant(const View& f, float x, float y, float z) {
  if constexpr (kLens == Lens::kParallel) return 1.0f;
  const float far = z > 1e-6f ? z : 1e-6f;
  const float a = x * f.focal_x / far, b = y * f.focal_y / far;
  return __builtin_sqrtf(1.0f + a * a + b * b);
}

/// Adds what the view says about a part's samples; p is the first.
template <Lens kLens>
inline F add_part(const View& f, const Place& p, PartSums& sums, F any) {
  const float* m = f.middle_of_part;
  const float along = slant<kLens>(f, p.x + m[0], p.y + m[1], p.z + m[2]);
  const float past = f.truncation / along;
  const F fall = all(f.inverse_fall), edge_weight = all(f.edge_weight);
  for (std::size_t l = 0; l < kPartCells; l += kLanes) {
    const F x = p.x + load(f.x + l), y = p.y + load(f.y + l), z = p.z + load(f.z + l);
    F u, v;
    project<kLens>(f, x, y, inverse_depth<kLens>(z), 0.5f, 0.5f, u, v);
    const I word = gather(f.pixels, pixel(f, u, v, 0, f.width));
    const I raw = word & 0xffff, free = word >> 16 & 0xfffe;
    const F level = z - f.bias;
    const F d = (real(raw) * f.unit - level) * along;
    const F c = real(free) * f.unit - level;
    const F fade = smaller(larger((d + f.truncation) * fall, F{}), all(1.0f));
    const F seen = raw != 0 ? fade : F{};
    const F near = d < all(f.truncation) ? seen : F{};
    const F w = (word & 0x10000) != 0 ? near * edge_weight : near;
    const F known = free != 0 ? all(1.0f) : F{};
    store(sums.distance + l, load(sums.distance + l) + w * d);
    store(sums.weight + l, load(sums.weight + l) + w);
    store(sums.clear + l, load(sums.clear + l) + (c > all(past) ? known : F{}));
    any = larger(any, w);
  }
  return any;
}

template <Lens kLens>
bool add_parts(const View& f, const float first[3], unsigned parts, BrickSums& sums) {
  const Place p = place(f, first);
  F any{};
  for (; parts != 0; parts &= parts - 1) {
    const int part = __builtin_ctz(parts);
    const Place own{p.x + f.part_x[part], p.y + f.part_y[part], p.z + f.part_z[part]};
    any = add_part<kLens>(f, own, sums.part[part], any);
  }
  return bits(any > F{}) != 0;
}

Sights look_at_group(const View& view, const float first[3]) {
  if (view.lens == Lens::kPinhole) return group<Lens::kPinhole>(view, first);
  if (view.lens == Lens::kDistorted) return group<Lens::kDistorted>(view, first);
  return group<Lens::kParallel>(view, first);
}

PartSights look_at_parts(const View& view, const float first[3]) {
  if (view.lens == Lens::kPinhole) return parts<Lens::kPinhole>(view, first);
  if (view.lens == Lens::kDistorted) return parts<Lens::kDistorted>(view, first);
  return parts<Lens::kParallel>(view, first);
}

bool add(const View& view, const float first[3], unsigned parts, BrickSums& sums) {
  if (view.lens == Lens::kPinhole) return add_parts<Lens::kPinhole>(view, first, parts, sums);
  if (view.lens == Lens::kDistorted) return add_parts<Lens::kDistorted>(view, first, parts, sums);
  return add_parts<Lens::kParallel>(view, first, parts, sums);
}

/// Sixteen bits a lane.
using U = std::uint16_t __attribute__((vector_size(4 * kLanes)));

struct Least {
  template <class T>
  static T of(const T& a, const T& b) {
    return a < b ? a : b;
  }
};
struct Most {
  template <class T>
  static T of(const T& a, const T& b) {
    return a > b ? a : b;
  }
};

/// The choice of each value and the one `apart` behind it, as far as there are such. In ascending
/// order: what is written was read before.
template <class Choice>
inline void join(std::uint16_t* values, std::size_t count, std::size_t apart) {
  if (count <= apart) return;
  const std::size_t end = count - apart;
  std::size_t i = 0;
  for (; i + 2 * kLanes <= end; i += 2 * kLanes) {
    U a, b;
    __builtin_memcpy(&a, values + i, sizeof a);
    __builtin_memcpy(&b, values + i + apart, sizeof b);
    a = Choice::of(a, b);
    __builtin_memcpy(values + i, &a, sizeof a);
  }
  for (; i < end; ++i) values[i] = Choice::of(values[i], values[i + apart]);
}

/// The choice of each value and the size - 1 behind it, `stride` apart.
template <class Choice>
inline void slide(std::uint16_t* values, std::size_t count, std::size_t stride, std::size_t size) {
  std::size_t has = 1;
  for (; 2 * has <= size; has *= 2) join<Choice>(values, count, has * stride);
  if (has < size) join<Choice>(values, count, (size - has) * stride);
}

template <class Choice>
void slide_both_ways(std::uint16_t* plane, std::size_t width, std::size_t height,
                     std::size_t size_x, std::size_t size_y) {
  for (std::size_t y = 0; y < height; ++y) slide<Choice>(plane + y * width, width, 1, size_x);
  slide<Choice>(plane, width * height, width, size_y);
}

void bound(const View& view, const Level& level, std::uint16_t* planes, std::uint32_t* bounds) {
  const auto across = static_cast<std::size_t>(view.width);
  const auto down = static_cast<std::size_t>(view.height);
  const std::size_t count = across * down;
  std::uint16_t *nearest = planes, *farthest = nearest + count, *least = farthest + count,
                *most = least + count;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t word = view.pixels[i];
    const auto raw = static_cast<std::uint16_t>(word & 0xffffu);
    const auto free = static_cast<std::uint16_t>(word >> 16 & 0xfffeu);
    nearest[i] = static_cast<std::uint16_t>(raw - 1);  // 0 becomes the farthest
    farthest[i] = raw;
    least[i] = most[i] = free;
  }
  const auto x = static_cast<std::size_t>(level.size_u), y = static_cast<std::size_t>(level.size_v);
  slide_both_ways<Least>(nearest, across, down, x, y);
  slide_both_ways<Most>(farthest, across, down, x, y);
  slide_both_ways<Least>(least, across, down, x, y);
  slide_both_ways<Most>(most, across, down, x, y);
  const std::size_t step = std::size_t{1} << level.shift;
  for (std::size_t row = 0; row < down; row += step) {
    for (std::size_t i = row * across; i < (row + 1) * across; i += step) {
      const auto near = static_cast<std::uint16_t>(nearest[i] + 1);
      *bounds++ = (near == 0 ? 0xffffu : near) | static_cast<std::uint32_t>(farthest[i]) << 16;
      *bounds++ = least[i] | static_cast<std::uint32_t>(most[i]) << 16;
    }
  }
}

constexpr Kernel kLoops{look_at_group, look_at_parts, add, bound};
