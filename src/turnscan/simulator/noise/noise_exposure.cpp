#include <algorithm>
#include <cmath>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

constexpr double kSameSurface_m = 0.01;  // maximum difference between moments

/// The surfaces that pass a pixel during the exposure.
struct Passing {
  double sum = 0.0, low = 1e9, high = 0.0;
  std::size_t count = 0;

  void add(double z) {
    sum += z;
    low = std::min(low, z);
    high = std::max(high, z);
    ++count;
  }
  double mean() const { return sum / double(count); }
};

/// The depths of a pixel at the moments when it counts that are within `apart` of z.
Passing passing(std::span<const SensorMoment> moments, int u, int v, double z, double apart) {
  Passing there;
  for (const SensorMoment& moment : moments) {
    if (!moment.exact.contains(u, v)) continue;
    const std::size_t i = moment.exact.index(u, v);
    if (!moment.exact.counts(i) || std::abs(double(moment.exact.z[i]) - z) > apart) continue;
    there.add(moment.exact.z[i]);
  }
  return there;
}

/// A matcher needs the pattern of one surface for most of the time. If light is integrated, depths
/// between two surfaces are dropped like mixed pixels.
bool found(const Job& job, const Passing& there, bool adds_up) {
  if (!adds_up) return 2 * there.count > job.view.moments.size();
  const double limit = job.setup.model.noise.mixed_rejection_m, z = there.mean();
  return there.count > 0 && !(limit > 0.0 && z - there.low > limit && there.high - z > limit);
}

}  // namespace

void blur(Job& job) {
  const bool adds_up = job.setup.model.sensing == Sensing::kTimeOfFlight;
  const double apart = adds_up ? 1e9 : kSameSurface_m;
  const PixelRect& r = job.exact.rect;
  for (int v = r.top; v < r.bottom; ++v) {
    for (int u = r.left; u < r.right; ++u) {
      const std::size_t i = job.exact.index(u, v);
      if (job.out.miss[i] != Miss::kNone || !job.exact.counts(i)) continue;
      const double z = job.exact.z[i];
      const Passing there = passing(job.view.moments, u, v, z, apart);
      if (found(job, there, adds_up)) {
        job.out.z[i] += float(there.mean() - z);
      } else {
        job.out.z[i] = 0.0f;
        job.out.miss[i] = Miss::kRejected;
      }
    }
  }
}

}  // namespace turnscan::noise
