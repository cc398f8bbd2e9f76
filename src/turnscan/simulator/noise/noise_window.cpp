#include <algorithm>
#include <cmath>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr std::uint64_t kPattern = 0x646f7473;  // the same for every scanner and frame, since it is
                                                // one slide

/// The projector's dots, and those visible to the camera.
class Dots {
 public:
  explicit Dots(const Job& job)
      : job_(job),
        noise_(job.setup.model.noise),
        disparity_(job.exact.size(), 0.0f),
        dot_(job.exact.size(), 0) {
    const PixelRect& r = job.exact.rect;
    for (int v = r.top; v < r.bottom; ++v) {
      for (int u = r.left; u < r.right; ++u) {
        const std::size_t i = job.exact.index(u, v);
        if (!job.exact.counts(i)) continue;
        disparity_[i] = static_cast<float>(job.setup.focal_baseline / job.exact.z[i]);
        dot_[i] = on_slide(u, v, disparity_[i]) ? 1 : 0;
      }
    }
  }

  /// Whether enough of the dots that a matcher expects around the pixel are visible.
  bool found(int u, int v, double disparity) const {
    const int half = noise_.window_px / 2;
    int expected = 0, there = 0;
    for (int y = std::max(v - half, 0); y <= std::min(v + half, job_.exact.height - 1); ++y) {
      for (int x = std::max(u - half, 0); x <= std::min(u + half, job_.exact.width - 1); ++x) {
        const bool seen = job_.exact.contains(x, y) && job_.exact.counts(job_.exact.index(x, y));
        if (!seen) {
          expected += on_slide(x, y, disparity) ? 1 : 0;
          continue;
        }
        const std::size_t i = job_.exact.index(x, y);
        if (dot_[i] == 0) continue;
        ++expected;
        there += std::abs(disparity_[i] - disparity) <= noise_.window_agreement_px ? 1 : 0;
      }
    }
    return there > 0 && there >= noise_.window_share * expected;
  }

 private:
  /// Whether a dot illuminates the pixel at a disparity.
  bool on_slide(int u, int v, double disparity) const {
    const auto column = static_cast<std::int64_t>(std::floor(u - disparity));
    return uniform01(hash_key(kPattern, static_cast<std::uint64_t>(column),
                              static_cast<std::uint64_t>(v), 0)) < noise_.window_dots;
  }

  const Job& job_;
  const NoiseModel& noise_;
  std::vector<float> disparity_;  ///< exact; 0 if no sample counts
  Mask dot_;                      ///< lit by a dot
};

}  // namespace

void match_windows(Job& job) {
  if (job.setup.model.noise.window_px <= 0 || !(job.setup.focal_baseline > 0.0)) return;
  const Dots dots(job);
  const PixelRect& r = job.exact.rect;
  for (int v = r.top; v < r.bottom; ++v) {
    for (int u = r.left; u < r.right; ++u) {
      const std::size_t i = job.exact.index(u, v);
      const double z = job.out.z[i];
      if (!(z > 0.0) || dots.found(u, v, job.setup.focal_baseline / z)) continue;
      job.out.z[i] = 0.0f;
      job.out.miss[i] = Miss::kRejected;
    }
  }
}

}  // namespace turnscan::noise
