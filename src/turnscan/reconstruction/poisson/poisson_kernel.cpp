#include <turnscan/reconstruction/poisson/poisson_bricks.hpp>
#include <turnscan/reconstruction/poisson/poisson_kernel.hpp>

namespace turnscan::poisson {
namespace {

constexpr int kLayer = kWide * kWide;
constexpr std::size_t kLanes = 8;

// Integrals of products of two quadratic B-splines 0, 1 and 2 cells apart: the quintic B-spline at
// integers, its negative second derivative and its derivative.
constexpr float kMass[3] = {66.0f / 120.0f, 26.0f / 120.0f, 1.0f / 120.0f};
constexpr float kStiff[3] = {1.0f, -1.0f / 3.0f, -1.0f / 6.0f};
constexpr float kSlope[2] = {10.0f / 24.0f, 1.0f / 24.0f};

/// Eight cells at once, each with two before and two behind it along one axis.
inline void even(const float (&w)[3], const float* from, int stride, float* to) {
  for (int i = 0; i < kSide; ++i)
    to[i] = w[0] * from[i] + (w[1] * (from[i - stride] + from[i + stride]) +
                              w[2] * (from[i - 2 * stride] + from[i + 2 * stride]));
}

inline void odd(const float* from, int stride, float* to) {
  for (int i = 0; i < kSide; ++i)
    to[i] = kSlope[0] * (from[i - stride] - from[i + stride]) +
            kSlope[1] * (from[i - 2 * stride] - from[i + 2 * stride]);
}

/// One product of three matrices, one per axis, added to out.
template <class X, class Y, class Z>
void product(const float* block, const X& along_x, const Y& along_y, const Z& along_z, float* out) {
  constexpr int kRow = kSide;
  float rows[kWide * kWide * kRow], layers[kWide * kSide * kRow], last[kRow];
  for (int r = 0; r < kWide * kWide; ++r) along_x(block + r * kWide + kHalo, 1, rows + r * kRow);
  for (int k = 0; k < kWide; ++k)
    for (int j = 0; j < kSide; ++j)
      along_y(rows + (k * kWide + j + kHalo) * kRow, kRow, layers + (k * kSide + j) * kRow);
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      along_z(layers + ((k + kHalo) * kSide + j) * kRow, kSide * kRow, last);
      float* to = out + in_brick(0, j, k);
      for (int i = 0; i < kRow; ++i) to[i] += last[i];
    }
  }
}

}  // namespace

void stiffness(const float* block, float* out) {
  // S M M + M S M + M M S, axis after axis.
  constexpr int kRow = kSide;
  float mass[kWide * kWide * kRow], stiff[kWide * kWide * kRow];
  float masses[kWide * kSide * kRow], mixed[kWide * kSide * kRow];
  for (int r = 0; r < kWide * kWide; ++r) {
    even(kMass, block + r * kWide + kHalo, 1, mass + r * kRow);
    even(kStiff, block + r * kWide + kHalo, 1, stiff + r * kRow);
  }
  for (int k = 0; k < kWide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      const int from = (k * kWide + j + kHalo) * kRow, to = (k * kSide + j) * kRow;
      float other[kRow];
      even(kMass, mass + from, kRow, masses + to);
      even(kMass, stiff + from, kRow, mixed + to);
      even(kStiff, mass + from, kRow, other);
      for (int i = 0; i < kRow; ++i) mixed[to + i] += other[i];
    }
  }
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      const int from = ((k + kHalo) * kSide + j) * kRow;
      float other[kRow];
      float* to = out + in_brick(0, j, k);
      even(kMass, mixed + from, kSide * kRow, to);
      even(kStiff, masses + from, kSide * kRow, other);
      for (int i = 0; i < kRow; ++i) to[i] += other[i];
    }
  }
}

void divergence(const float* x, const float* y, const float* z, float* out) {
  const auto mass = [](const float* from, int stride, float* to) { even(kMass, from, stride, to); };
  for (std::size_t i = 0; i < kCells; ++i) out[i] = 0.0f;
  product(x, odd, mass, mass, out);
  product(y, mass, odd, mass, out);
  product(z, mass, mass, odd, out);
}

void refine(const float* coarse, float* block) {
  constexpr int kCoarse = 8;
  // Cell f of the block, counted from 0, is in the coarse cell 1 + f / 2, closer to the previous
  // one if f is even.
  const auto between = [](const float* from, int step, int f) {
    const float* own = from + step * (1 + f / 2);
    return 0.75f * own[0] + 0.25f * (f % 2 == 0 ? own[-step] : own[step]);
  };
  float rows[kCoarse * kCoarse * kWide], layers[kCoarse * kWide * kWide];
  for (int r = 0; r < kCoarse * kCoarse; ++r)
    for (int i = 0; i < kWide; ++i) rows[r * kWide + i] = between(coarse + r * kCoarse, 1, i);
  for (int k = 0; k < kCoarse; ++k)
    for (int j = 0; j < kWide; ++j)
      for (int i = 0; i < kWide; ++i)
        layers[(k * kWide + j) * kWide + i] = between(rows + k * kCoarse * kWide + i, kWide, j);
  for (int k = 0; k < kWide; ++k)
    for (int n = 0; n < kLayer; ++n) block[k * kLayer + n] = between(layers + n, kLayer, k);
}

void coarsen(const float* fine, float* out) {
  constexpr int kFine = 2 * kSide + 2;
  // Coarse cell c gathers from its own two, fine cells 2 c + 1 and 2 c + 2 counted from the one
  // before the brick, and from the adjacent ones.
  const auto take = [](const float* from, int step, int c) {
    const float* f = from + step * 2 * c;
    return 0.25f * (f[0] + f[3 * step]) + 0.75f * (f[step] + f[2 * step]);
  };
  float rows[kFine * kFine * kSide], layers[kFine * kSide * kSide];
  for (int r = 0; r < kFine * kFine; ++r)
    for (int i = 0; i < kSide; ++i) rows[r * kSide + i] = take(fine + r * kFine, 1, i);
  for (int k = 0; k < kFine; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        layers[(k * kSide + j) * kSide + i] = take(rows + k * kFine * kSide + i, kSide, j);
  for (int k = 0; k < kSide; ++k)
    for (int n = 0; n < kSide * kSide; ++n)
      out[k * kSide * kSide + n] += 0.5f * take(layers + n, kSide * kSide, k);
}

double dot(const float* a, const float* b, std::size_t n) {
  double sum[kLanes] = {};
  for (std::size_t i = 0; i < n; i += kLanes)
    for (std::size_t l = 0; l < kLanes; ++l) sum[l] += double(a[i + l]) * double(b[i + l]);
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

double update_solution(float step, const float* p, const float* q, const float* inverse_diagonal,
                       float* x, float* r, std::size_t n) {
  double sum[kLanes] = {};
  for (std::size_t i = 0; i < n; i += kLanes) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      x[i + l] += step * p[i + l];
      r[i + l] -= step * q[i + l];
      sum[l] += double(inverse_diagonal[i + l] * r[i + l]) * double(r[i + l]);
    }
  }
  return ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
}

void update_direction(float beta, const float* inverse_diagonal, const float* r, float* p,
                      std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) p[i] = inverse_diagonal[i] * r[i] + beta * p[i];
}

}  // namespace turnscan::poisson
