#pragma once

#include <turnscan/reconstruction/tsdf/sample_bits.hpp>

namespace turnscan::tsdf {

/// Flood fill from beyond the volume, along the axes, through the samples that are not inside. The
/// volume must outlive it and stay unchanged.
class OutsideFlood {
 public:
  explicit OutsideFlood(const Volume& volume);

  /// sample: its index in the brick.
  bool reached(std::size_t brick, std::size_t sample) const {
    return contains(reached_.brick(brick), sample);
  }

 private:
  void open_bricks();
  void enter_from_beyond();
  void enter(std::size_t b, const BrickBits& from);
  void fill_brick(std::size_t b);
  void enter_neighbours(std::size_t b);

  const Volume& v_;
  SampleBits open_, reached_;
  std::vector<std::size_t> work_;
};

}  // namespace turnscan::tsdf
