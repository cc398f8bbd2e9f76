#include <algorithm>
#include <cmath>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/detection/residual_correlation.hpp>

namespace turnscan::detection {

namespace {

constexpr int kCorrelationReach =
    3;  // pixels: twice the reach of a filter over 3 x 3, and one for noise

/// Clamps residuals, since those beyond their limits would let a single edge dominate.
class ResidualImage {
 public:
  ResidualImage(const ScanPixels& scan, const RayTable& rays, const Plane& plane,
                const std::vector<std::int32_t>& pixels)
      : width_(scan.width), height_(scan.height), value_(scan.point.size(), std::nanf("")) {
    std::vector<double> sizes;
    for (const std::int32_t i : pixels) {
      const auto k = std::size_t(i);
      const Vec3d ray(rays.x()[k], rays.y()[k], 1.0);
      value_[k] = float(double(scan.point[k].z()) - plane.depth_along(ray));
      sizes.push_back(std::abs(double(value_[k])));
    }
    sigma_ = estimation::mad_sigma(sizes);
    for (const std::int32_t i : pixels) {
      float& v = value_[std::size_t(i)];
      v = float(std::clamp(double(v), -3.0 * sigma_, 3.0 * sigma_));
    }
  }

  double sigma() const { return sigma_; }

  double covariance(const std::vector<std::int32_t>& pixels, int dx, int dy) const {
    double sum = 0.0, count = 0.0;
    for (const std::int32_t i : pixels) {
      const int x = i % width_ + dx, y = i / width_ + dy;
      if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
      const float there = value_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
      if (std::isnan(there)) continue;
      sum += double(value_[std::size_t(i)]) * double(there);
      count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
  }

 private:
  int width_, height_;
  std::vector<float> value_;
  double sigma_ = 0.0;
};

}  // namespace

NoiseCorrelation correlation_of(const ScanPixels& scan, const RayTable& rays, const Plane& plane,
                                const std::vector<std::int32_t>& pixels) {
  NoiseCorrelation out;
  if (pixels.empty()) return out;
  const ResidualImage residuals(scan, rays, plane, pixels);
  out.sigma_m = residuals.sigma();
  const double variance = residuals.covariance(pixels, 0, 0);
  if (!(variance > 0.0)) return out;
  const double beside =
      0.5 * (residuals.covariance(pixels, 1, 0) + residuals.covariance(pixels, 0, 1)) / variance;
  // Uncorrelated noise through a box of n pixels: neighbours have a share of 1 - 1 / n in common.
  const double width = 1.0 / std::max(0.2, 1.0 - std::max(0.0, beside));
  out.blur_px = static_cast<int>(std::lround(0.5 * (width - 1.0)));
  double sum = 1.0;
  for (int dy = 0; dy <= kCorrelationReach; ++dy) {
    for (int dx = dy == 0 ? 1 : -kCorrelationReach; dx <= kCorrelationReach; ++dx)
      sum += 2.0 * residuals.covariance(pixels, dx, dy) / variance;
  }
  out.pixels_per_sample = std::max(1.0, sum);
  return out;
}

}  // namespace turnscan::detection
