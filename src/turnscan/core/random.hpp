#pragma once
// Counter-based random numbers: a value is a pure function of (seed, stream, counter), so that it
// does not depend on threads or on the order of evaluation.

#include <cmath>
#include <cstdint>
#include <numbers>

namespace turnscan {

/// Mixes 64 bits (the finaliser of SplitMix64; Steele, Lea, Flood 2014, "Fast splittable
/// pseudorandom number generators").
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t hash_key(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0,
                                 std::uint64_t c = 0) {
  return mix64(mix64(mix64(mix64(seed) ^ a) ^ b) ^ c);
}

/// Uniform in (0, 1), from the upper 52 bits (with 53 the largest would round to 1); never exactly
/// 0 or 1.
constexpr double uniform01(std::uint64_t key) {
  return (static_cast<double>(key >> 12) + 0.5) * 0x1.0p-52;
}

/// Standard normal (Box and Muller 1958).
inline double standard_normal(std::uint64_t key) {
  const double u = uniform01(key), v = uniform01(mix64(key ^ 0xd1b54a32d192ed03ULL));
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

}  // namespace turnscan
