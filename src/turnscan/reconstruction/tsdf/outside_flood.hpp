#pragma once

#include <cstdint>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// Which samples that are not inside can be reached, from one to the next along the axes, from
/// beyond the volume: a bit each, brick by brick. The volume must outlive it and stay as it is.
class OutsideFlood {
 public:
  explicit OutsideFlood(const Volume& volume);

  /// sample: its position in the brick.
  bool reached(std::size_t brick, std::size_t sample) const {
    return (reached_[brick][sample >> 6] >> (sample & 63) & 1) != 0;
  }

 private:
  using BrickBits = std::array<std::uint64_t, kBrickSide>;  // a layer in each word, i fastest

  static BrickBits face(int axis, int layer);
  void open_bricks();
  void enter_from_beyond();
  void enter(std::size_t b, const BrickBits& from);
  void spread_within(std::size_t b);
  void spread_beyond(std::size_t b);

  const Volume& v_;
  std::vector<BrickBits> open_, reached_;
  std::vector<std::size_t> work_;
};

}  // namespace turnscan::tsdf
