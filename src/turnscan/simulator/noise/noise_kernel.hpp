#pragma once
// The inner loops of the noise, a kernel (core/simd/kernel_choice.hpp): no fused operations, no
// sums across elements.

#include <cstdint>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan::noise {

inline constexpr int kFrequencies = 3;
inline constexpr int kSteps = 3;

/// Key of one frame: random numbers are a function of it and a counter.
struct Key {
  std::uint32_t a, b, c, d;
};

/// Three phasors per pixel, of the modulation frequencies 80, 16 and 120 MHz.
struct Phasors {
  float *re[kFrequencies], *im[kFrequencies];
};

struct CorrelationNoise {
  float read, shot, relative;
};

/// Conversion between depth and half the path of the light.
struct DepthRays {
  const float* z_per_range;    ///< z of the point one metre along the pixel's ray
  const float* along_emitter;  ///< component of the emitter's position along the ray
  float emitter2;              ///< square of its distance
};

struct Gate {
  float near_m, far_m;
};

/// Why a pixel has no depth; 0 if it has one.
enum Verdict : std::uint8_t { kGood = 0, kDark, kAliased, kNear, kFar, kEdge };

struct NoiseKernel {
  /// out[i] is the standard normal of counter first + i * step.
  void (*normals)(Key key, std::uint32_t first, std::uint32_t step, int n, float* out);
  /// Phasors of light with the path 2 * half_path, from the amplitude it has at 16 MHz.
  void (*phasors)(int n, const float* half_path, const float* amplitude, Phasors out);
  /// The nine correlations, three for each frequency, of pixels with counters first, first + 1, ...
  void (*correlate)(int n, Phasors light, const float* amplitude, Key key, std::uint32_t first,
                    CorrelationNoise noise, float* const* correlations);
  /// Converts back to phasors; those with a correlation at the limit are zero. norm is their
  /// magnitude.
  void (*combine)(int n, const float* const* correlations, Phasors out, float* const* norm);
  /// The driver's bilateral filter over 3 x 3 pixels, one row: pixels at +-1 and +-stride are read.
  /// unlike[i] measures how much they differ, at most 9.
  void (*smooth)(int n, int stride, Phasors in, const float* const* norm, Phasors out,
                 float* unlike);
  /// Half path in metres (0 if there is none), the summed amplitude, and a verdict.
  void (*unwrap)(int n, Phasors in, float* half_path, float* amplitude, std::uint8_t* verdict);
  /// z of half paths; those outside the gate get a verdict. Their z is kept for the neighbours.
  void (*depth)(int n, const float* half_path, DepthRays rays, Gate gate, float* z,
                std::uint8_t* verdict);
  /// The driver's edge filter over 3 x 3 pixels, one row: pixels between two surfaces and pixels
  /// that differ too much get kEdge.
  void (*edges)(int n, int stride, const float* z, const float* amplitude, const float* unlike,
                std::uint8_t* verdict);
};
using NoiseKernels = KernelChoice<NoiseKernel>;

}  // namespace turnscan::noise
