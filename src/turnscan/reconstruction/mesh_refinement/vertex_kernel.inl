// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/reconstruction/mesh_refinement/vertex_kernel.hpp>

namespace turnscan::mesh_refinement {
namespace {

/// As std::min and std::max, with internal linkage.
inline float smaller(float a, float b) { return b < a ? b : a; }
inline float larger(float a, float b) { return a < b ? b : a; }

constexpr std::size_t kRow = 64;  // samples of a layer, or vertices of a round

/// Points of a view, and what its pixel there holds; points outside land on the empty border.
struct Row {
  float x[kRow], y[kRow], z[kRow];  // position
  float a[kRow], b[kRow];           // x / z and y / z
  float du[kRow], dv[kRow];         // from the exact image point to the pixel's centre
  float raw[kRow], edge[kRow];
};

/// Perspective as arithmetic: parallel rays divide by one.
struct Perspective {
  float on, off;
};

TURNSCAN_INLINE void look_up(const VertexKernelView& f, const Perspective& perspective, Row& row) {
  const float right = static_cast<float>(f.width - 1), bottom = static_cast<float>(f.height - 1);
  float u[kRow], v[kRow];
  int at[kRow];
  std::uint32_t word[kRow];
  for (std::size_t i = 0; i < kRow; ++i) {
    const float z = larger(row.z[i], 1e-6f) * perspective.on + perspective.off;
    row.a[i] = row.x[i] / z;
    row.b[i] = row.y[i] / z;
  }
  if (f.distorted == 1) {
    for (std::size_t i = 0; i < kRow; ++i) {
      float a = row.a[i], b = row.b[i];
      distort(f.lens, a, b);
      u[i] = a * f.fx + f.cx;
      v[i] = b * f.fy + f.cy;
    }
  } else if (f.distorted == 2) {
    for (std::size_t i = 0; i < kRow; ++i) {
      float a = row.a[i], b = row.b[i];
      distort_rational(f.lens, a, b);
      u[i] = a * f.fx + f.cx;
      v[i] = b * f.fy + f.cy;
    }
  } else {
    for (std::size_t i = 0; i < kRow; ++i) {
      u[i] = row.a[i] * f.fx + f.cx;
      v[i] = row.b[i] * f.fy + f.cy;
    }
  }
  for (std::size_t i = 0; i < kRow; ++i) {
    const float cu = smaller(larger(u[i] + 0.5f, 0.0f), right);
    const float cv = smaller(larger(v[i] + 0.5f, 0.0f), bottom);
    const int pu = static_cast<int>(cu), pv = static_cast<int>(cv);
    row.du[i] = static_cast<float>(pu) - u[i];
    row.dv[i] = static_cast<float>(pv) - v[i];
    at[i] = pv * f.width + pu;
  }
  const std::uint32_t* pixels = f.pixels;
  for (std::size_t i = 0; i < kRow; ++i) word[i] = pixels[at[i]];
  for (std::size_t i = 0; i < kRow; ++i) {
    row.raw[i] = static_cast<float>(static_cast<int>(word[i] & 0xffffu));
    row.edge[i] = static_cast<float>(static_cast<int>(word[i] >> 16 & 1u));
  }
}

void add_view(const VertexKernelView& f, const VertexColumns& in, std::size_t begin,
              std::size_t end, const VertexKernelScale& scale, VertexSums& sums) {
  const Perspective perspective{f.parallel != 0 ? 0.0f : 1.0f, f.parallel != 0 ? 1.0f : 0.0f};
  const float* r = f.rotation;
  const float pixel_x = 1.0f / f.fx, pixel_y = 1.0f / f.fy, unit = f.unit, bias = f.bias;
  const float noise2 = scale.noise * scale.noise, floor2 = scale.noise_floor * scale.noise_floor;
  const float inverse_cut2 = 1.0f / (scale.cut * scale.cut), less = 1.0f - scale.edge_weight;
  float nx[kRow], ny[kRow], nz[kRow];
  Row row;
  for (std::size_t base = begin; base < end; base += kRow) {
    const float *qx = in.x + base, *qy = in.y + base, *qz = in.z + base;
    const float *mx = in.nx + base, *my = in.ny + base, *mz = in.nz + base;
    for (std::size_t i = 0; i < kRow; ++i) {
      row.x[i] = r[0] * qx[i] + r[1] * qy[i] + r[2] * qz[i] + f.translation[0];
      row.y[i] = r[3] * qx[i] + r[4] * qy[i] + r[5] * qz[i] + f.translation[1];
      row.z[i] = r[6] * qx[i] + r[7] * qy[i] + r[8] * qz[i] + f.translation[2];
      nx[i] = r[0] * mx[i] + r[1] * my[i] + r[2] * mz[i];
      ny[i] = r[3] * mx[i] + r[4] * my[i] + r[5] * mz[i];
      nz[i] = r[6] * mx[i] + r[7] * my[i] + r[8] * mz[i];
    }
    look_up(f, perspective, row);
    float* weight = sums.weight + base;
    float* offset = sums.offset + base;
    for (std::size_t i = 0; i < kRow; ++i) {
      const float depth = row.raw[i] * unit + bias;
      // The pixel's own ray: the vertex's, moved by the rest of the rounding.
      const float rx = row.a[i] + row.du[i] * pixel_x, ry = row.b[i] + row.dv[i] * pixel_y;
      const float spread = depth * perspective.on + perspective.off;
      const float dx = rx * spread - row.x[i], dy = ry * spread - row.y[i], dz = depth - row.z[i];
      const float ax = rx * perspective.on, ay = ry * perspective.on;
      const float length = __builtin_sqrtf(ax * ax + ay * ay + 1.0f);
      const float cosine = -(nx[i] * ax + ny[i] * ay + nz[i]) / length;
      const float h = dx * nx[i] + dy * ny[i] + dz * nz[i];
      // Across: the pixel's place on the vertex's plane, whatever its noise along the ray. The
      // vertex's ray and the pixel's are almost parallel.
      const float apart = row.z[i] * perspective.on + perspective.off;
      const float px = (rx - row.a[i]) * apart, py = (ry - row.b[i]) * apart;
      const float tilt = (px * nx[i] + py * ny[i]) / larger(cosine, 0.05f);
      const float across2 = px * px + py * py + tilt * tilt;
      const float k = larger(0.0f, 1.0f - across2 * scale.inverse_reach2);
      const float variance = noise2 * cosine * cosine + floor2;
      const float t = larger(0.0f, 1.0f - h * h / variance * inverse_cut2);
      const float seen = row.raw[i] > 0.0f ? cosine : 0.0f;
      const float facing = cosine > scale.facing ? seen : 0.0f;
      const float w = facing * (1.0f - less * row.edge[i]) * k * k * t * t;
      weight[i] += w;
      offset[i] += w * h;
    }
  }
}

constexpr VertexKernel kKernel{add_view};

}  // namespace
}  // namespace turnscan::mesh_refinement

template <>
const turnscan::mesh_refinement::VertexKernel&
turnscan::built_kernel<turnscan::mesh_refinement::VertexKernel, TURNSCAN_INSTRUCTION_SET>() {
  return mesh_refinement::kKernel;
}
