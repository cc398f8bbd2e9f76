// The loops of brick_kernel.hpp. Part of brick_kernel.inl, in its anonymous namespace.

inline float dot(const float* row, const float p[3]) {
  return row[0] * p[0] + row[1] * p[1] + row[2] * p[2];
}

/// A position in the view's frame.
struct PointInView {
  float x, y, z;
};
inline PointInView to_view(const BrickKernelView& f, const float first[3]) {
  return {dot(f.rows, first) + f.shift[0], dot(f.rows + 3, first) + f.shift[1],
          dot(f.rows + 6, first) + f.shift[2]};
}

/// Image points, plus (right, down). inverse: 1 / z.
template <Projection kProjection>
inline void project(const BrickKernelView& f, const F& x, const F& y, const F& inverse, float right,
                    float down, F& u, F& v) {
  if constexpr (kProjection == Projection::kPinhole) {
    u = x * inverse + (f.cx + right);
    v = y * inverse + (f.cy + down);
  } else {
    F a = x * inverse, b = y * inverse;
    if constexpr (kProjection == Projection::kDistorted)
      distort<TangentialProduct::kShared>(f.lens, a, b);
    if constexpr (kProjection == Projection::kRational)
      distort_rational<TangentialProduct::kShared>(f.lens, a, b);
    u = a * f.fx + (f.cx + right);
    v = b * f.fy + (f.cy + down);
  }
}

template <Projection kProjection>
inline F inverse_depth(const F& z) {
  if constexpr (kProjection == Projection::kParallel) return all(1.0f);
  return 1.0f / larger(z, all(1e-6f));
}

/// Index of the pixels, or of every 2^shift-th one, that begin at these image points; outside it is
/// the nearest one of the border.
inline I pixel(const BrickKernelView& f, const F& u, const F& v, int shift, int width) {
  const F right = all(static_cast<float>(f.width - 1)),
          down = all(static_cast<float>(f.height - 1));
  const I pu = __builtin_convertvector(smaller(larger(u, F{}), right), I);
  const I pv = __builtin_convertvector(smaller(larger(v, F{}), down), I);
  return (pv >> shift) * width + (pu >> shift);
}

/// One mask a lane.
struct BoxVisibility {
  I free, near_surface, partly_free;
};

/// Visibility of boxes from the bounds around the images of their centres.
template <Projection kProjection>
inline BoxVisibility box_visibility(const BrickKernelView& f, const BoundsLevel& level, const F& x,
                                    const F& y, const F& z) {
  F u, v;
  project<kProjection>(f, x, y, inverse_depth<kProjection>(z), 0.5f - level.half_u,
                       0.5f - level.half_v, u, v);
  const I at = 2 * pixel(f, u, v, level.shift, level.width);
  const I depth = gather(level.bounds, at), past = gather(level.bounds + 1, at);
  const F back = z + (level.half_z + f.truncation), front = z - (level.half_z + f.truncation);
  const F seen = z - (level.half_z - f.truncation_z_fraction * f.truncation);
  const F nearest = real(depth & 0xffff) * f.unit + f.bias;
  const I farthest = depth >> 16 & 0xffff, most = past >> 16 & 0xffff, least = past & 0xffff;
  const I measured = (farthest > 0) & (nearest < back) & (real(farthest) * f.unit + f.bias > front);
  const I all_free = (least > 0) & (real(least) * f.unit + f.bias > back);
  const I some_free = (most > 0) & (real(most) * f.unit + f.bias > seen);
  const I observed = z > all(level.least_z), near = z < all(level.nearest_z);
  const I surface = observed & (near | measured), free = observed & ~surface & all_free;
  return {free, surface, observed & ~surface & ~free & some_free};
}

template <Projection kProjection>
VisibilityMasks group_masks(const BrickKernelView& f, const float first[3]) {
  const PointInView p = to_view(f, first);
  const float* center = f.brick_center;
  const float x = p.x + center[0], y = p.y + center[1], z = p.z + center[2];
  VisibilityMasks out{0, 0, 0};
  for (std::size_t l = 0; l < kGroupBricks; l += kLanes) {
    const BoxVisibility boxes =
        box_visibility<kProjection>(f, f.brick_bounds, x + 8.0f * load(f.x + l),
                                    y + 8.0f * load(f.y + l), z + 8.0f * load(f.z + l));
    out.free |= static_cast<std::uint64_t>(bits(boxes.free)) << l;
    out.near_surface |= static_cast<std::uint64_t>(bits(boxes.near_surface)) << l;
    out.partly_free |= static_cast<std::uint64_t>(bits(boxes.partly_free)) << l;
  }
  return out;
}

template <Projection kProjection>
PartVisibilityMasks part_masks(const BrickKernelView& f, const float first[3]) {
  const PointInView p = to_view(f, first);
  const float* center = f.part_center;
  const float x = p.x + center[0], y = p.y + center[1], z = p.z + center[2];
  PartVisibilityMasks out{0, 0};
  for (std::size_t l = 0; l < kParts; l += kLanes) {
    const BoxVisibility boxes = box_visibility<kProjection>(
        f, f.part_bounds, x + load(f.part_x + l), y + load(f.part_y + l), z + load(f.part_z + l));
    out.near_surface |= bits(boxes.near_surface) << l;
    out.partly_free |= bits(boxes.partly_free | boxes.free) << l;
  }
  out.near_surface &= 255u, out.partly_free &= 255u;
  return out;
}

/// How much longer the ray through a place is than its part along z.
template <Projection kProjection>
inline float slant(const BrickKernelView& f, float x, float y, float z) {
  if constexpr (kProjection == Projection::kParallel) return 1.0f;
  const float far = z > 1e-6f ? z : 1e-6f;
  const float a = x * f.focal_x / far, b = y * f.focal_y / far;
  return __builtin_sqrtf(1.0f + a * a + b * b);
}

/// Integrates the view into a part's samples; p is the first.
template <Projection kProjection>
inline F integrate_part(const BrickKernelView& f, const PointInView& p, PartSums& sums, F any) {
  const float* m = f.part_center;
  const float along = slant<kProjection>(f, p.x + m[0], p.y + m[1], p.z + m[2]);
  const float past = f.truncation / along;
  const F inverse_fade = all(f.inverse_fade), edge_weight = all(f.edge_weight);
  for (std::size_t l = 0; l < kPartSamples; l += kLanes) {
    const F x = p.x + load(f.x + l), y = p.y + load(f.y + l), z = p.z + load(f.z + l);
    F u, v;
    project<kProjection>(f, x, y, inverse_depth<kProjection>(z), 0.5f, 0.5f, u, v);
    const I word = gather(f.pixels, pixel(f, u, v, 0, f.width));
    const I raw = word & 0xffff, free = word >> 16 & 0xfffe;
    const F level = z - f.bias;
    const F d = (real(raw) * f.unit - level) * along;
    const F c = real(free) * f.unit - level;
    const F fade = smaller(larger((d + f.truncation) * inverse_fade, F{}), all(1.0f));
    const F seen = raw != 0 ? fade : F{};
    const F near = d < all(f.truncation) ? seen : F{};
    const F w = (word & 0x10000) != 0 ? near * edge_weight : near;
    const F known = free != 0 ? all(1.0f) : F{};
    store(sums.distance + l, load(sums.distance + l) + w * d);
    store(sums.weight + l, load(sums.weight + l) + w);
    store(sums.free + l, load(sums.free + l) + (c > all(past) ? known : F{}));
    any = larger(any, w);
  }
  return any;
}

template <Projection kProjection>
bool integrate_parts(const BrickKernelView& f, const float first[3], unsigned parts,
                     BrickSums& sums) {
  const PointInView p = to_view(f, first);
  F any{};
  for (; parts != 0; parts &= parts - 1) {
    const int part = __builtin_ctz(parts);
    const PointInView own{p.x + f.part_x[part], p.y + f.part_y[part], p.z + f.part_z[part]};
    any = integrate_part<kProjection>(f, own, sums.part[part], any);
  }
  return bits(any > F{}) != 0;
}

VisibilityMasks group_visibility(const BrickKernelView& view, const float first[3]) {
  if (view.projection == Projection::kPinhole)
    return group_masks<Projection::kPinhole>(view, first);
  if (view.projection == Projection::kDistorted)
    return group_masks<Projection::kDistorted>(view, first);
  if (view.projection == Projection::kRational)
    return group_masks<Projection::kRational>(view, first);
  return group_masks<Projection::kParallel>(view, first);
}

PartVisibilityMasks part_visibility(const BrickKernelView& view, const float first[3]) {
  if (view.projection == Projection::kPinhole) return part_masks<Projection::kPinhole>(view, first);
  if (view.projection == Projection::kDistorted)
    return part_masks<Projection::kDistorted>(view, first);
  if (view.projection == Projection::kRational)
    return part_masks<Projection::kRational>(view, first);
  return part_masks<Projection::kParallel>(view, first);
}

bool integrate(const BrickKernelView& view, const float first[3], unsigned parts, BrickSums& sums) {
  if (view.projection == Projection::kPinhole)
    return integrate_parts<Projection::kPinhole>(view, first, parts, sums);
  if (view.projection == Projection::kDistorted)
    return integrate_parts<Projection::kDistorted>(view, first, parts, sums);
  if (view.projection == Projection::kRational)
    return integrate_parts<Projection::kRational>(view, first, parts, sums);
  return integrate_parts<Projection::kParallel>(view, first, parts, sums);
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

/// The extreme of each value and the one `apart` behind it, as far as there are such. In ascending
/// order: what is written was read before.
template <class Extreme>
inline void combine(std::uint16_t* values, std::size_t count, std::size_t apart) {
  if (count <= apart) return;
  const std::size_t end = count - apart;
  std::size_t i = 0;
  for (; i + 2 * kLanes <= end; i += 2 * kLanes) {
    U a, b;
    __builtin_memcpy(&a, values + i, sizeof a);
    __builtin_memcpy(&b, values + i + apart, sizeof b);
    a = Extreme::of(a, b);
    __builtin_memcpy(values + i, &a, sizeof a);
  }
  for (; i < end; ++i) values[i] = Extreme::of(values[i], values[i + apart]);
}

/// The extreme of each value and the size - 1 behind it, `stride` apart: a running minimum or
/// maximum by doubling.
template <class Extreme>
inline void running_extreme(std::uint16_t* values, std::size_t count, std::size_t stride,
                            std::size_t size) {
  std::size_t has = 1;
  for (; 2 * has <= size; has *= 2) combine<Extreme>(values, count, has * stride);
  if (has < size) combine<Extreme>(values, count, (size - has) * stride);
}

template <class Extreme>
void window_extreme(std::uint16_t* plane, std::size_t width, std::size_t height, std::size_t size_x,
                    std::size_t size_y) {
  for (std::size_t y = 0; y < height; ++y)
    running_extreme<Extreme>(plane + y * width, width, 1, size_x);
  running_extreme<Extreme>(plane, width * height, width, size_y);
}

void compute_bounds(const BrickKernelView& view, const BoundsLevel& level, std::uint16_t* planes,
                    std::uint32_t* bounds) {
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
  const auto x = static_cast<std::size_t>(level.window_width),
             y = static_cast<std::size_t>(level.window_height);
  window_extreme<Least>(nearest, across, down, x, y);
  window_extreme<Most>(farthest, across, down, x, y);
  window_extreme<Least>(least, across, down, x, y);
  window_extreme<Most>(most, across, down, x, y);
  const std::size_t step = std::size_t{1} << level.shift;
  for (std::size_t row = 0; row < down; row += step) {
    for (std::size_t i = row * across; i < (row + 1) * across; i += step) {
      const auto near = static_cast<std::uint16_t>(nearest[i] + 1);
      *bounds++ = (near == 0 ? 0xffffu : near) | static_cast<std::uint32_t>(farthest[i]) << 16;
      *bounds++ = least[i] | static_cast<std::uint32_t>(most[i]) << 16;
    }
  }
}
