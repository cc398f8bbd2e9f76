// Rays in packets of kLanes. Part of sample_kernel.inl, in its anonymous namespace.

constexpr float kInfinity = __builtin_inff();
/// Rounding of a hit and of the way to it, relative to the distances concerned.
constexpr float kLift = 0x1p-20f;
constexpr std::uint32_t kNoSurface = 0xffffffffu;

/// Values of Miss.
enum { kCounts = 0, kMissed = 1, kTooNear = 2, kTooFar = 3, kOutOfView = 4, kGrazing = 7 };

inline bool any(const I& mask) {
  int sum = 0;
  for (int i = 0; i < kLanes; ++i) sum |= mask[i];
  return sum != 0;
}

/// In: the rays' directions. Out: the rest.
struct Packet {
  F x, y;
  F z;           ///< 0: nothing is hit
  F nx, ny, nz;  ///< normal in the sensor frame, any length
  I surface, triangle, miss;
};

/// Rays from one point in the directions r * (x, y, z), up to `end`. Lanes that are not valid are
/// left out by Embree, but with AVX2 it asserts that they hold numbers, too.
inline void fill(const float* origin, const float* r, const I& valid, F x, F y, F z, const F& end,
                 RTCRay16& ray) {
  x = valid ? x : F{}, y = valid ? y : F{}, z = valid ? z : F{};
  store(ray.org_x, all(origin[0]));
  store(ray.org_y, all(origin[1]));
  store(ray.org_z, all(origin[2]));
  store(ray.dir_x, r[0] * x + r[1] * y + r[2] * z);
  store(ray.dir_y, r[3] * x + r[4] * y + r[5] * z);
  store(ray.dir_z, r[6] * x + r[7] * y + r[8] * z);
  store(ray.tnear, F{});
  store(ray.time, F{});
  store(ray.tfar, end);
  store(ray.mask, all(-1));
  store(ray.id, I{});
  store(ray.flags, I{});
}

/// Where the rays meet the platter (y = 0) before they end; infinity where they do not.
inline F meet_platter(const RTCRay16& ray, const F& end, float radius_squared) {
  const F t = -load(ray.org_y) / load(ray.dir_y);
  const F x = load(ray.org_x) + t * load(ray.dir_x);
  const F z = load(ray.org_z) + t * load(ray.dir_z);
  const I hit = (t > 0.0f) & (t < end) & (x * x + z * z <= radius_squared);
  return hit ? t : all(kInfinity);
}

/// The platter where it is nearer than what the packet has.
inline void meet_platter(const BodyView& body, const I& valid, Packet& p) {
  if (body.platter_radius_squared < 0.0f) return;
  const float *r = body.rotation, *o = body.origin;
  const F t = -all(o[1]) / (r[3] * p.x + r[4] * p.y + r[5]);
  const F x = o[0] + t * (r[0] * p.x + r[1] * p.y + r[2]);
  const F z = o[2] + t * (r[6] * p.x + r[7] * p.y + r[8]);
  const I on = valid & (t > 0.0f) & (t < p.z) & (x * x + z * z <= body.platter_radius_squared);
  p.z = on ? t : p.z;
  p.surface = on ? all(int(body.id | kPlatterObject)) : p.surface;
  p.triangle = on ? I{} : p.triangle;
  p.nx = on ? all(r[3]) : p.nx;
  p.ny = on ? all(r[4]) : p.ny;
  p.nz = on ? all(r[5]) : p.nz;
}

/// Where the rays meet the triangles' planes, for those of sixteen whose object is not -1. Rays and
/// drawing both go through here, so that they agree to the last bit where they found the same
/// triangle.
inline void locate(const BodyView& body, const int* objects, const int* triangles, Packet& p) {
  alignas(64) float c[9][kLanes];
  for (int i = 0; i < kLanes; ++i) {
    if (objects[i] == -1) {
      for (int k = 0; k < 9; ++k) c[k][i] = 0.0f;
      continue;
    }
    const ObjectView& o = body.objects[objects[i]];
    const std::uint32_t* index = o.indices + 3 * std::size_t(triangles[i]);
    for (int k = 0; k < 3; ++k) {
      const float* v = o.vertices + 3 * std::size_t(index[k]);
      c[3 * k][i] = v[0];
      c[3 * k + 1][i] = v[1];
      c[3 * k + 2][i] = v[2];
    }
  }
  const F ax = load(c[0]), ay = load(c[1]), az = load(c[2]);
  const F ux = load(c[3]) - ax, uy = load(c[4]) - ay, uz = load(c[5]) - az;
  const F vx = load(c[6]) - ax, vy = load(c[7]) - ay, vz = load(c[8]) - az;
  const F nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
  const float *r = body.rotation, *o = body.origin;
  const F to = nx * (ax - o[0]) + ny * (ay - o[1]) + nz * (az - o[2]);
  const F mx = r[0] * nx + r[3] * ny + r[6] * nz, my = r[1] * nx + r[4] * ny + r[7] * nz,
          mz = r[2] * nx + r[5] * ny + r[8] * nz;
  const I object = load<I>(objects), triangle = load<I>(triangles), hit = object != -1;
  p.z = hit ? to / (mx * p.x + my * p.y + mz) : p.z;
  p.surface = hit ? int(body.id) | object : p.surface;
  p.triangle = hit ? triangle : p.triangle;
  p.nx = hit ? mx : p.nx;
  p.ny = hit ? my : p.ny;
  p.nz = hit ? mz : p.nz;
}

inline void intersect(const BodyView& body, const I& valid, embree::Query& query, Packet& p) {
  alignas(64) RTCRayHit16 hits;
  alignas(64) int active[kLanes];
  fill(body.origin, body.rotation, valid, p.x, p.y, all(1.0f), p.z, hits.ray);
  store(hits.hit.geomID, all(-1));
  store(hits.hit.instID[0], all(-1));
  store(active, valid);
  query.intersect(active, body.scene, hits);
  alignas(64) int object[kLanes], triangle[kLanes];
  store(object, load<I>(hits.hit.geomID));
  store(triangle, load<I>(hits.hit.primID));
  locate(body, object, triangle, p);
  meet_platter(body, valid, p);
}

/// From the other eye to just above the surface.
struct Target {
  F x, y, z;
};

/// Everything but what may stand between the other eye and the surface.
inline void judge(const View& view, const I& valid, Packet& p, Target& target) {
  const I hit = p.z < kInfinity;
  p.z = hit ? p.z : F{};
  const F px = p.x * p.z, py = p.y * p.z;
  const F wx = view.other[0] - px, wy = view.other[1] - py, wz = view.other[2] - p.z;
  const F to_origin = -(p.nx * p.x + p.ny * p.y + p.nz);
  const F to_other = p.nx * wx + p.ny * wy + p.nz * wz;
  const F squared = p.nx * p.nx + p.ny * p.ny + p.nz * p.nz, length = root(squared);
  const F flattest = view.least_cosine * length * root(p.x * p.x + p.y * p.y + 1.0f);
  const I same_side = to_origin * to_other > 0.0f;
  I miss = same_side | (view.two_eyed ? 0 : -1) ? I{} : all(view.blocked);
  miss = absolute(to_origin) >= flattest ? miss : all(int(kGrazing));
  miss = p.z > view.far_m ? all(int(kTooFar)) : miss;
  miss = p.z < view.near_m ? all(int(kTooNear)) : miss;
  miss = hit ? miss : all(int(kMissed));
  p.miss = valid ? miss : all(int(kOutOfView));
  const F lift = kLift * (absolute(px) + absolute(py) + p.z + view.size) / length;
  const F scale = squared > 0.0f ? (to_other > 0.0f ? lift : -lift) : F{};
  target.x = scale * p.nx - wx;
  target.y = scale * p.ny - wy;
  target.z = scale * p.nz - wz;
}

/// The lanes of valid that the body does not block.
inline I lit(const BodyView& body, const Target& target, const I& valid, embree::Query& query) {
  alignas(64) RTCRay16 ray;
  alignas(64) int active[kLanes];
  const F end = all(1.0f);
  fill(body.other, body.rotation, valid, target.x, target.y, target.z, end, ray);
  I left = valid;
  if (body.platter_radius_squared >= 0.0f)
    left &= meet_platter(ray, end, body.platter_radius_squared) == kInfinity;
  store(active, left);
  query.occluded(active, body.scene, ray);
  // Embree marks a blocked ray with tfar = -inf.
  return left & (load(ray.tfar) >= 0.0f);
}

inline bool overlap(const Window& a, const Window& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

inline void begin(Packet& p) {
  p.z = all(kInfinity);
  p.surface = all(-1);
  p.triangle = I{};
  p.nx = p.ny = p.nz = F{};
}

/// Whether what was hit counts. other_eye: whether to look from there, too.
inline void finish(const View& view, const I& valid, bool other_eye, embree::Query& query,
                   Packet& p) {
  Target target;
  judge(view, valid, p, target);
  if (!other_eye) return;
  const I seen = p.miss == int(kCounts);
  I left = seen;
  for (int b = 0; b < view.body_count && any(left); ++b)
    left = lit(view.bodies[b], target, left, query);
  p.miss = seen & ~left ? all(view.blocked) : p.miss;
}

inline void trace(const View& view, const Window* where, bool other_eye, embree::Query& query,
                  Packet& p) {
  const I valid = (p.x == p.x) & (p.y == p.y);
  begin(p);
  for (int b = 0; b < view.body_count; ++b)
    if (where == nullptr || overlap(*where, view.bodies[b].frame))
      intersect(view.bodies[b], valid, query, p);
  finish(view, valid, other_eye, query, p);
}

/// Lanes [lane, lane + count) to the place `at`. count is a constant where it matters.
inline void write(const Packet& p, int lane, int count, std::size_t at, const Output& out) {
  const std::size_t bytes = std::size_t(count) * 4;
  __builtin_memcpy(out.z + at, reinterpret_cast<const char*>(&p.z) + 4 * lane, bytes);
  __builtin_memcpy(out.surface + at, reinterpret_cast<const char*>(&p.surface) + 4 * lane, bytes);
  __builtin_memcpy(out.triangle + at, reinterpret_cast<const char*>(&p.triangle) + 4 * lane, bytes);
  for (int i = 0; i < count; ++i) out.miss[at + i] = static_cast<std::uint8_t>(p.miss[lane + i]);
}

/// Lanes beyond the frame repeat its last column or row.
template <int kTileWidth>
inline void load_tile(const Directions& d, const Window& frame, int left, int top, Packet& p) {
  alignas(64) float x[kLanes], y[kLanes];
  for (int row = 0; row < kLanes / kTileWidth; ++row) {
    const int v = top + row < frame.bottom ? top + row : frame.bottom - 1;
    for (int column = 0; column < kTileWidth; ++column) {
      const int u = left + column < frame.right ? left + column : frame.right - 1;
      x[row * kTileWidth + column] = d.x[v * d.x_row + u];
      y[row * kTileWidth + column] = d.y[v * d.y_row + u * d.y_column];
    }
  }
  p.x = load(x);
  p.y = load(y);
}

/// Its width is a constant, so that rows are copied as vectors.
template <int kTileWidth>
void trace_tiles(const View& view, const Directions& directions, const Window& frame,
                 const Output& out) {
  constexpr int kTileHeight = kLanes / kTileWidth;
  const bool by_rays = view.two_eyed && view.baseline == 0.0f;
  embree::Query query(true);
  const int width = frame.right - frame.left;
  for (int top = frame.top; top < frame.bottom; top += kTileHeight) {
    for (int left = frame.left; left < frame.right; left += kTileWidth) {
      const Window tile{left, top, left + kTileWidth, top + kTileHeight};
      Packet p;
      load_tile<kTileWidth>(directions, frame, left, top, p);
      trace(view, &tile, by_rays, query, p);
      const int rows = frame.bottom - top < kTileHeight ? frame.bottom - top : kTileHeight;
      for (int row = 0; row < rows; ++row) {
        const std::size_t at = std::size_t(top + row - frame.top) * std::size_t(width) +
                               std::size_t(left - frame.left);
        if (frame.right - left >= kTileWidth)
          write(p, row * kTileWidth, kTileWidth, at, out);
        else
          write(p, row * kTileWidth, frame.right - left, at, out);
      }
    }
  }
}

void trace_list(const View& view, const float* x, const float* y, std::size_t n,
                const Output& out) {
  embree::Query query(true);
  for (std::size_t at = 0; at < n; at += kLanes) {
    const int count = n - at < std::size_t(kLanes) ? int(n - at) : kLanes;
    Packet p;
    for (int i = 0; i < kLanes; ++i) {
      const std::size_t ray = at + std::size_t(i < count ? i : count - 1);
      p.x[i] = x[ray];
      p.y[i] = y[ray];
    }
    trace(view, nullptr, view.two_eyed, query, p);
    write(p, 0, count, at, out);
  }
}
