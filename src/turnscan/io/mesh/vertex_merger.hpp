#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::mesh_io {

/// Assigns the same index to equal points, in the order of their first occurrence. -0 equals 0.
class VertexMerger {
 public:
  /// expected: estimated number of distinct points; more only make it slower.
  explicit VertexMerger(std::size_t expected) {
    slots_.assign(std::bit_ceil(expected * 2 + 16), kFree);
  }

  std::uint32_t index_of(Vec3f point) {
    point.array() += 0.0F;  // -0 becomes 0
    if (points_.size() * 2 >= slots_.size()) grow();
    const std::size_t slot = find(point);
    if (slots_[slot] == kFree) {
      slots_[slot] = static_cast<std::uint32_t>(points_.size());
      points_.push_back(point);
    }
    return slots_[slot];
  }

  std::vector<Vec3f> take() { return std::move(points_); }

 private:
  static constexpr std::uint32_t kFree = 0xffffffffU;

  static std::uint64_t hash(const Vec3f& point) {
    std::uint64_t h = 0x9e3779b97f4a7c15U;
    for (int i = 0; i < 3; ++i) {
      h = (h ^ std::bit_cast<std::uint32_t>(point[i])) * 0xff51afd7ed558ccdU;
      h ^= h >> 32;
    }
    return h;
  }

  static bool same(const Vec3f& a, const Vec3f& b) {
    for (int i = 0; i < 3; ++i)  // bitwise: NaN equals itself
      if (std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i])) return false;
    return true;
  }

  std::size_t find(const Vec3f& point) const {
    std::size_t slot = hash(point) & (slots_.size() - 1);
    while (slots_[slot] != kFree && !same(points_[slots_[slot]], point))
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void grow() {
    slots_.assign(slots_.size() * 2, kFree);
    for (std::uint32_t i = 0; i < points_.size(); ++i) slots_[find(points_[i])] = i;
  }

  std::vector<std::uint32_t> slots_;
  std::vector<Vec3f> points_;
};

}  // namespace turnscan::mesh_io
