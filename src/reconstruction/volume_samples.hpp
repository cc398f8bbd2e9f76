#pragma once
// Samples of a volume by their position, for what looks at neighbours across bricks. Internal.

#include <algorithm>
#include <turnscan/reconstruction/volume.hpp>

namespace turnscan::detail {

using Index = Volume::Index;
inline constexpr int kSide = Volume::kSide;
inline constexpr std::size_t kCells = detail::kBrickCells;

constexpr std::size_t within(int i, int j, int k) {
  return std::size_t(i & 7) + std::size_t(j & 7) * 8 + std::size_t(k & 7) * 64;
}

/// What a known distance says to the unknown beside it: its side more than its length. Inside,
/// distances are known only as far as measurements reach, while what is clear has all of the
/// truncation; by lengths, what is invented would sink into the object.
inline float side_of(float distance, float outside) {
  return std::clamp(3.0f * distance, -outside, outside);
}

/// Samples of a volume by their position, bricks without samples included.
class Samples {
 public:
  explicit Samples(const Volume& volume) : v_(volume) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = volume.bricks[a] * kSide;
  }
  const Index& size() const { return size_; }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size_[0] && j < size_[1] && k < size_[2];
  }
  std::size_t brick(int i, int j, int k) const { return v_.brick_index({i >> 3, j >> 3, k >> 3}); }
  /// Position among all samples, or -1 where there are none.
  std::ptrdiff_t at(int i, int j, int k) const {
    const std::int32_t slot = v_.slot[brick(i, j, k)];
    return slot < 0 ? -1 : std::ptrdiff_t(std::size_t(slot) * kCells + within(i, j, k));
  }
  float value(int i, int j, int k) const {
    const std::ptrdiff_t s = at(i, j, k);
    return s >= 0 ? v_.value[std::size_t(s)] : v_.uniform[brick(i, j, k)] * float(v_.truncation_m);
  }

 private:
  const Volume& v_;
  Index size_{};
};

/// Values and weights of a brick and one layer of samples around it.
struct Halo {
  static constexpr int kWide = kSide + 2;
  std::array<float, kWide * kWide * kWide> value, weight;
  static std::size_t at(int i, int j, int k) {
    return std::size_t(i + 1) + kWide * (std::size_t(j + 1) + kWide * std::size_t(k + 1));
  }

  void gather(const Volume& v, const Samples& samples, const Index& b) {
    std::size_t out = 0;
    const auto& size = samples.size();
    for (int k = b[2] * kSide - 1; k <= b[2] * kSide + kSide; ++k) {
      for (int j = b[1] * kSide - 1; j <= b[1] * kSide + kSide; ++j) {
        for (int i = b[0] * kSide - 1; i <= b[0] * kSide + kSide; ++i, ++out) {
          // Beyond the volume its last samples go on.
          const int x = std::clamp(i, 0, size[0] - 1), y = std::clamp(j, 0, size[1] - 1),
                    z = std::clamp(k, 0, size[2] - 1);
          const std::ptrdiff_t s = samples.at(x, y, z);
          value[out] = s >= 0 ? v.value[std::size_t(s)] : samples.value(x, y, z);
          weight[out] = s >= 0 ? v.weight[std::size_t(s)] : 0.0f;
        }
      }
    }
  }
};

inline std::vector<std::size_t> touched_bricks(const Volume& volume) {
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    if (volume.slot[b] >= 0) out.push_back(b);
  }
  return out;
}

}  // namespace turnscan::detail
