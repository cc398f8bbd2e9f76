#include "bench/texture/image_likeness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace turnscan::bench {

namespace {

constexpr int kReach = 5;

double grey(Rgb c) { return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b; }

double ssim_at(const ColorImage& a, const ColorImage& b, int x, int y) {
  double w = 0.0, ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (int dy = -kReach; dy <= kReach; ++dy) {
    for (int dx = -kReach; dx <= kReach; ++dx) {
      const int u = std::clamp(x + dx, 0, a.width - 1), v = std::clamp(y + dy, 0, a.height - 1);
      const double k = std::exp(-(dx * dx + dy * dy) / (2.0 * 1.5 * 1.5));
      const double p = grey(a.at(u, v)), q = grey(b.at(u, v));
      w += k, ma += k * p, mb += k * q, aa += k * p * p, bb += k * q * q, ab += k * p * q;
    }
  }
  ma /= w, mb /= w;
  const double va = aa / w - ma * ma, vb = bb / w - mb * mb, cov = ab / w - ma * mb;
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  return (2 * ma * mb + kC1) * (2 * cov + kC2) / ((ma * ma + mb * mb + kC1) * (va + vb + kC2));
}

}  // namespace

void Likeness::add(const Likeness& other) {
  squared += other.squared, pixels += other.pixels;
  ssim_sum += other.ssim_sum, windows += other.windows;
}

double Likeness::psnr_db() const {
  const double mse = squared / std::max(1.0, 3.0 * pixels);
  return 10.0 * std::log10(255.0 * 255.0 / std::max(mse, 1e-6));
}

Likeness likeness(const ColorImage& a, const ColorImage& b, const std::vector<std::uint8_t>& mask) {
  Likeness out;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (mask[std::size_t(y) * std::size_t(a.width) + std::size_t(x)] == 0) continue;
      const Rgb p = a.at(x, y), q = b.at(x, y);
      for (const int d : {p.r - q.r, p.g - q.g, p.b - q.b}) out.squared += double(d * d);
      out.pixels += 1.0;
      if ((x + y) % 4 != 0) continue;
      out.ssim_sum += ssim_at(a, b, x, y);
      out.windows += 1.0;
    }
  }
  return out;
}

}  // namespace turnscan::bench
