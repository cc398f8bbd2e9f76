#pragma once
// How alike two pictures of an object are.

#include <turnscan/core/image.hpp>
#include <vector>

namespace turnscan::bench {

struct Likeness {
  double squared = 0.0;  ///< sum of squared differences of all channels
  double pixels = 0.0;
  double ssim_sum = 0.0, windows = 0.0;
  void add(const Likeness& other);
  double psnr_db() const;
  double ssim() const { return windows > 0.0 ? ssim_sum / windows : 0.0; }
};

/// Over the pixels of the mask. SSIM: Wang et al. 2004, of luminance, windows of 11 x 11 with a
/// Gaussian of 1.5 whose middles lie in the mask.
Likeness likeness(const ColorImage& a, const ColorImage& b, const std::vector<std::uint8_t>& mask);

}  // namespace turnscan::bench
