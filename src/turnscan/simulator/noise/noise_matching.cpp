// Effects of window matching on a depth image: neighbours share errors, and the foreground grows.

#include <algorithm>
#include <cmath>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr std::uint64_t kWindowPurpose = 0x77696e;
constexpr int kMargin = 64;        // so that no position beside the image is negative
constexpr double kSteepest = 4.0;  // maximum slope of a surface that is not an edge

/// The nearest pixel within reach that is clearly in front of this one.
class Foreground {
 public:
  Foreground(const Job& job, const std::vector<float>& z) : job_(job), z_(z) {
    const double reach = job.setup.options.edge_fattening_px;
    const int r = static_cast<int>(std::floor(reach));
    for (int dy = -r; dy <= r; ++dy)
      for (int dx = -r; dx <= r; ++dx)
        if ((dx != 0 || dy != 0) && std::hypot(dx, dy) <= reach) around_.push_back({dx, dy});
    std::stable_sort(around_.begin(), around_.end(),
                     [](const Offset& a, const Offset& b) { return a.length2() < b.length2(); });
  }

  /// Its depth, or 0.
  float depth(int u, int v) const {
    const double here = z_[job_.exact.index(u, v)];
    for (const Offset& o : around_) {
      if (!job_.exact.contains(u + o.dx, v + o.dy)) continue;
      const float there = z_[job_.exact.index(u + o.dx, v + o.dy)];
      if (!(there > 0.0f)) continue;
      const double slope = kSteepest * there / job_.setup.model.camera.fx;
      if (here == 0.0 || here - there > kSilhouetteStep_m + slope * std::sqrt(o.length2()))
        return there;
    }
    return 0.0f;
  }

 private:
  struct Offset {
    int dx, dy;
    double length2() const { return double(dx * dx + dy * dy); }
  };

  const Job& job_;
  const std::vector<float>& z_;
  std::vector<Offset> around_;
};

}  // namespace

bool matches_patterns(const ScannerModel& model) {
  return model.sensing == Sensing::kStructuredLight || model.sensing == Sensing::kStereo;
}

void fatten_edges(Job& job) {
  const std::vector<float> before = job.out.z;
  const Foreground foreground(job, before);
  const PixelRect& r = job.exact.rect;
  for (int v = r.top; v < r.bottom; ++v) {
    for (int u = r.left; u < r.right; ++u) {
      const std::size_t i = job.exact.index(u, v);
      if (job.exact.miss[i] == Miss::kOutOfView) continue;
      const float z = foreground.depth(u, v);
      if (z == 0.0f) continue;
      job.out.z[i] = z;
      job.out.miss[i] = Miss::kNone;
    }
  }
}

std::vector<float> window_normals(const Job& job, std::uint64_t purpose) {
  const PixelRect& r = job.exact.rect;
  const int n = job.setup.options.window_px, w = r.width(), h = r.height();
  const std::uint64_t seed = job.seed_of(kWindowPurpose + purpose);
  const auto wide = static_cast<std::size_t>(w);
  // Sums along the rows, with additional rows for the height of the window.
  std::vector<float> rows(wide * std::size_t(h + n - 1)), white(wide + std::size_t(n) - 1);
  for (int y = 0; y < h + n - 1; ++y) {
    for (int x = 0; x < w + n - 1; ++x)
      white[std::size_t(x)] = static_cast<float>(
          standard_normal(hash_key(seed, std::uint64_t(r.left + x - n / 2 + kMargin),
                                   std::uint64_t(r.top + y - n / 2 + kMargin))));
    for (std::size_t x = 0; x < wide; ++x)
      for (std::size_t k = 0; k < std::size_t(n); ++k)
        rows[std::size_t(y) * wide + x] += white[x + k];
  }
  std::vector<float> out(wide * std::size_t(h));
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t k = 0; k < std::size_t(n); ++k) out[i] += rows[i + k * wide];
    out[i] /= float(n);
  }
  return out;
}

}  // namespace turnscan::noise
