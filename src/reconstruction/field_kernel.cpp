#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/field_kernel.hpp>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TURNSCAN_CLONES __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define TURNSCAN_CLONES
#endif

namespace turnscan::detail {

namespace {

constexpr std::size_t kRow = 64;  // samples of a layer, or vertices of a round

/// Image coordinates and pixel of points of a view; the ones outside land on the empty border.
struct Lookup {
  float u[kRow], v[kRow];  // exact
  float x[kRow], y[kRow];  // x / z and y / z
  float pu[kRow], pv[kRow];
  std::uint32_t word[kRow];
};

#define TURNSCAN_INLINE inline __attribute__((always_inline))

TURNSCAN_INLINE void look_up(const ViewKernel& f, const float* x, const float* y, const float* z,
                             Lookup& out) {
  const float right = static_cast<float>(f.width - 1), bottom = static_cast<float>(f.height - 1);
  for (std::size_t i = 0; i < kRow; ++i) {
    const float scale = f.parallel ? 1.0f : 1.0f / std::max(z[i], 1e-6f);
    out.x[i] = x[i] * scale;
    out.y[i] = y[i] * scale;
  }
  if (f.distorted) {
    for (std::size_t i = 0; i < kRow; ++i) {
      const float a = out.x[i], b = out.y[i], r2 = a * a + b * b;
      const float radial = 1.0f + r2 * (f.k1 + r2 * (f.k2 + r2 * f.k3));
      const float da = a * radial + 2.0f * f.p1 * a * b + f.p2 * (r2 + 2.0f * a * a);
      const float db = b * radial + f.p1 * (r2 + 2.0f * b * b) + 2.0f * f.p2 * a * b;
      out.u[i] = da * f.fx + f.cx;
      out.v[i] = db * f.fy + f.cy;
    }
  } else {
    for (std::size_t i = 0; i < kRow; ++i) {
      out.u[i] = out.x[i] * f.fx + f.cx;
      out.v[i] = out.y[i] * f.fy + f.cy;
    }
  }
  for (std::size_t i = 0; i < kRow; ++i) {
    const float cu = std::min(std::max(out.u[i] + 0.5f, 0.0f), right);
    const float cv = std::min(std::max(out.v[i] + 0.5f, 0.0f), bottom);
    const int pu = static_cast<int>(cu), pv = static_cast<int>(cv);
    out.pu[i] = static_cast<float>(pu);
    out.pv[i] = static_cast<float>(pv);
    out.word[i] = f.pixels[pv * f.width + pu];
  }
}

}  // namespace

TURNSCAN_CLONES
void add_view(const ViewKernel& f, const float origin[3], float cell, const FieldScale& scale,
              BrickSums& sums) {
  const float* r = f.rotation;
  const float inverse_fall = 1.0f / std::max(scale.truncation - scale.behind, 1e-9f);
  float x[kRow], y[kRow], z[kRow];
  Lookup at;
  for (std::size_t k = 0; k < kBrickSide; ++k) {
    const float pz = origin[2] + cell * static_cast<float>(k);
    for (std::size_t i = 0; i < kRow; ++i) {
      const float px = origin[0] + cell * static_cast<float>(i & 7);
      const float py = origin[1] + cell * static_cast<float>(i >> 3);
      x[i] = r[0] * px + r[1] * py + r[2] * pz + f.translation[0];
      y[i] = r[3] * px + r[4] * py + r[5] * pz + f.translation[1];
      z[i] = r[6] * px + r[7] * py + r[8] * pz + f.translation[2];
    }
    look_up(f, x, y, z, at);
    float* distance = sums.distance + k * kRow;
    float* weight = sums.weight + k * kRow;
    float* clear = sums.clear + k * kRow;
    for (std::size_t i = 0; i < kRow; ++i) {
      const std::uint32_t word = at.word[i];
      const auto raw = static_cast<float>(static_cast<int>(word & 0xffffu));
      const auto past = static_cast<float>(static_cast<int>(word >> 17 << 1));
      const float slant =
          f.parallel ? 1.0f : std::sqrt(1.0f + at.x[i] * at.x[i] + at.y[i] * at.y[i]);
      const float d = (raw * f.unit + f.bias - z[i]) * slant;
      const float c = (past * f.unit + f.bias - z[i]) * slant;
      const float fade = std::min((scale.truncation + d) * inverse_fall, 1.0f);
      const float base = (word & 0x10000u) != 0 ? scale.edge_weight : 1.0f;
      const bool near = raw > 0.0f && d < scale.truncation && fade > 0.0f;
      const float w = near ? base * fade : 0.0f;
      distance[i] += w * d;
      weight[i] += w;
      clear[i] += past > 0.0f && c > scale.truncation ? 1.0f : 0.0f;
    }
  }
}

TURNSCAN_CLONES
void add_view_to_vertices(const ViewKernel& f, const VertexColumns& in, std::size_t begin,
                          std::size_t end, const FitScale& scale, VertexSums& sums) {
  const float* r = f.rotation;
  const float pixel_x = 1.0f / f.fx, pixel_y = 1.0f / f.fy;
  const float noise2 = scale.noise * scale.noise, floor2 = scale.noise_floor * scale.noise_floor;
  const float inverse_cut2 = 1.0f / (scale.cut * scale.cut);
  float x[kRow], y[kRow], z[kRow], nx[kRow], ny[kRow], nz[kRow];
  Lookup at;
  for (std::size_t base = begin; base < end; base += kRow) {
    const std::size_t count = std::min(kRow, end - base);
    for (std::size_t i = 0; i < kRow; ++i) {
      // The last, short round looks at its last vertex again and leaves it.
      const std::size_t s = base + std::min(i, count - 1);
      const float px = in.x[s], py = in.y[s], pz = in.z[s];
      const float qx = in.nx[s], qy = in.ny[s], qz = in.nz[s];
      x[i] = r[0] * px + r[1] * py + r[2] * pz + f.translation[0];
      y[i] = r[3] * px + r[4] * py + r[5] * pz + f.translation[1];
      z[i] = r[6] * px + r[7] * py + r[8] * pz + f.translation[2];
      nx[i] = r[0] * qx + r[1] * qy + r[2] * qz;
      ny[i] = r[3] * qx + r[4] * qy + r[5] * qz;
      nz[i] = r[6] * qx + r[7] * qy + r[8] * qz;
    }
    look_up(f, x, y, z, at);
    float weight[kRow], offset[kRow];
    for (std::size_t i = 0; i < kRow; ++i) {
      const std::uint32_t word = at.word[i];
      const auto raw = static_cast<float>(static_cast<int>(word & 0xffffu));
      const float depth = raw * f.unit + f.bias;
      // The pixel's own ray: the vertex's, moved by the rest of the rounding.
      const float rx = at.x[i] + (at.pu[i] - at.u[i]) * pixel_x;
      const float ry = at.y[i] + (at.pv[i] - at.v[i]) * pixel_y;
      const float scale_xy = f.parallel ? 1.0f : depth;
      const float dx = rx * scale_xy - x[i], dy = ry * scale_xy - y[i], dz = depth - z[i];
      const float ax = f.parallel ? 0.0f : rx, ay = f.parallel ? 0.0f : ry;
      const float length = std::sqrt(ax * ax + ay * ay + 1.0f);
      const float cosine = -(nx[i] * ax + ny[i] * ay + nz[i]) / length;
      const float h = dx * nx[i] + dy * ny[i] + dz * nz[i];
      // Across: the pixel's place on the vertex's plane, whatever its noise along the ray. The
      // vertex's ray and the pixel's are almost parallel.
      const float ox = (rx - at.x[i]) * (f.parallel ? 1.0f : z[i]);
      const float oy = (ry - at.y[i]) * (f.parallel ? 1.0f : z[i]);
      const float safe = std::max(cosine, 0.05f);
      const float tilt = (ox * nx[i] + oy * ny[i]) / safe;
      const float across2 = ox * ox + oy * oy + tilt * tilt;
      const float k = std::max(0.0f, 1.0f - across2 * scale.inverse_reach2);
      const float variance = noise2 * cosine * cosine + floor2;
      const float t = std::max(0.0f, 1.0f - h * h / variance * inverse_cut2);
      const float own = (word & 0x10000u) != 0 ? scale.edge_weight : 1.0f;
      const bool use = raw > 0.0f && cosine > scale.facing;
      const float w = use ? own * k * k * t * t * cosine : 0.0f;
      weight[i] = w;
      offset[i] = w * h;
    }
    for (std::size_t i = 0; i < count; ++i) {
      sums.weight[base + i] += weight[i];
      sums.offset[base + i] += offset[i];
    }
  }
}

}  // namespace turnscan::detail
