#pragma once
// Access to samples of a volume by their coordinates, for neighbours across bricks.

#include <algorithm>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// The boundary value that a known distance sets for the unknown beside it: dominated by its sign
/// rather than its magnitude. Inside, distances are known only as far as measurements reach, while
/// free space has the full truncation distance; with magnitudes, invented surface would sink into
/// the object.
inline float boundary_value(float distance, float outside) {
  return std::clamp(3.0f * distance, -outside, outside);
}

/// Samples of a volume by their coordinates, including bricks without samples.
class VolumeSamples {
 public:
  explicit VolumeSamples(const Volume& volume) : v_(volume) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = volume.bricks.size()[a] * kBrickSide;
  }
  const GridCoords& size() const { return size_; }
  std::size_t brick(int i, int j, int k) const { return v_.bricks.at({i >> 3, j >> 3, k >> 3}); }
  /// Position in value and weight, or -1 if the brick has no samples.
  std::ptrdiff_t at(int i, int j, int k) const {
    const std::int32_t slot = v_.slot[brick(i, j, k)];
    return slot < 0 ? -1
                    : std::ptrdiff_t(std::size_t(slot) * kBrickSamples + sample_in_brick(i, j, k));
  }
  float value(int i, int j, int k) const {
    const std::ptrdiff_t s = at(i, j, k);
    return s >= 0 ? v_.value[std::size_t(s)] : v_.uniform[brick(i, j, k)] * float(v_.truncation_m);
  }

 private:
  const Volume& v_;
  GridCoords size_{};
};

/// Values and weights of a brick and one layer of samples around it.
struct BrickHalo {
  static constexpr int kWide = kBrickSide + 2;
  std::array<float, std::size_t(kWide*kWide*kWide)> value, weight;
  static std::size_t at(int i, int j, int k) {
    return std::size_t(i + 1) + kWide * (std::size_t(j + 1) + kWide * std::size_t(k + 1));
  }

  void gather(const Volume& v, const VolumeSamples& samples, const GridCoords& b) {
    std::size_t out = 0;
    const auto& size = samples.size();
    for (int k = b[2] * kBrickSide - 1; k <= b[2] * kBrickSide + kBrickSide; ++k) {
      for (int j = b[1] * kBrickSide - 1; j <= b[1] * kBrickSide + kBrickSide; ++j) {
        for (int i = b[0] * kBrickSide - 1; i <= b[0] * kBrickSide + kBrickSide; ++i, ++out) {
          // Beyond the volume its last samples are repeated.
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

}  // namespace turnscan::tsdf
