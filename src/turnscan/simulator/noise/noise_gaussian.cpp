#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

// Purposes of random numbers.
constexpr std::uint64_t kAxialPurpose = 1, kChoicePurpose = 2, kReachPurpose = 3;

/// Distance of the deepest neighbour behind the pixel, 0 if it is not a silhouette pixel. Two
/// neighbours on the platter never are: at grazing incidence it is no edge.
float silhouette_step(const SampleGrid& exact, int u, int v) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  const std::size_t here = exact.index(u, v);
  const bool on_platter = exact.object(here) == kPlatter;
  float step = 0.0f;
  const auto look = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= exact.width || y >= exact.height) return;
    const std::size_t there = exact.contains(x, y) ? exact.index(x, y) : exact.size();
    if (there == exact.size() || !exact.hit(there)) {
      step = kEndless;
    } else if (!on_platter || exact.object(there) != kPlatter) {
      const float behind = exact.z[there] - exact.z[here];
      if (double(behind) > kSilhouetteStep_m) step = std::max(step, behind);
    }
  };
  look(u - 1, v);
  look(u + 1, v);
  look(u, v - 1);
  look(u, v + 1);
  return step;
}

void mix_silhouette(Job& job) {
  const NoiseOptions& options = job.setup.options;
  const PixelRect& r = job.exact.rect;
  const std::uint64_t choice = job.seed_of(kChoicePurpose), reach = job.seed_of(kReachPurpose);
  for (int v = r.top; v < r.bottom; ++v) {
    for (int u = r.left; u < r.right; ++u) {
      const std::size_t i = job.exact.index(u, v), pixel = job.setup.pixel(u, v);
      if (!job.exact.counts(i)) continue;
      const float step = silhouette_step(job.exact, u, v);
      if (!(step > 0.0f) || uniform01(mix64(choice ^ pixel)) >= options.mixed_pixels) continue;
      job.out.z[i] += static_cast<float>(uniform01(mix64(reach ^ pixel)) *
                                         std::min(options.mixed_reach_m, double(step)));
    }
  }
}

/// Does nothing without sigma.
void add_noise(Job& job, float sigma) {
  const PixelRect& r = job.exact.rect;
  const Key key = job.key_of(kAxialPurpose);
  const int n = r.width();
  std::vector<float> normals(static_cast<std::size_t>(n), 0.0f);
  for (int v = r.top; v < r.bottom && n > 0; ++v) {
    const std::size_t row = job.exact.index(r.left, v);
    if (sigma > 0.0f)
      NoiseKernels::current().normals(key, static_cast<std::uint32_t>(job.setup.pixel(r.left, v)),
                                      1, n, normals.data());
    for (std::size_t k = 0; k < normals.size(); ++k)
      if (job.exact.counts(row + k)) job.out.z[row + k] = job.exact.z[row + k] + sigma * normals[k];
  }
}

}  // namespace

void apply_gaussian(Job& job) {
  const NoiseOptions& options = job.setup.options;
  add_noise(job, options.kind == NoiseKind::kGaussian ? float(options.sigma_m) : 0.0f);
  if (job.setup.options.mixed_pixels > 0.0) mix_silhouette(job);
  for (std::size_t i = 0; i < job.out.z.size(); ++i) {
    if (job.out.miss[i] != Miss::kNone || job.out.z[i] > 0.0f) continue;
    job.out.z[i] = 0.0f;
    job.out.miss[i] = Miss::kRejected;
  }
}

}  // namespace turnscan::noise
