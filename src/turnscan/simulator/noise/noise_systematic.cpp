#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/noise/noise_apply.hpp>

namespace turnscan::noise {

namespace {

/// Change of the depth z by wiggling on the line of sight d (with z = 1).
double wiggling(const Setup& setup, const Vec3d& d, double z) {
  const Vec3d p = z * d;
  const double half_path = 0.5 * (p.norm() + (p - setup.model.emitter_m).norm());
  return setup.options.wiggling_m * std::sin(kTurn * half_path / setup.options.wiggling_period_m) /
         d.norm();
}

}  // namespace

void add_systematic(Job& job) {
  const Setup& setup = job.setup;
  const bool wiggles =
      setup.options.wiggling_m != 0.0 && setup.model.sensing == Sensing::kTimeOfFlight;
  if (!wiggles && job.view.too_far_m == 0.0) return;
  const PixelRect& r = job.exact.rect;
  for (int v = r.top; v < r.bottom; ++v) {
    for (int u = r.left; u < r.right; ++u) {
      const std::size_t i = job.exact.index(u, v), pixel = setup.pixel(u, v);
      if (job.out.miss[i] != Miss::kNone) continue;
      const Vec3d d(setup.rays.x()[pixel], setup.rays.y()[pixel], 1.0);
      const double z = job.out.z[i];
      const double wrong = z + job.view.too_far_m + (wiggles ? wiggling(setup, d, z) : 0.0);
      job.out.z[i] = wrong > 0.0 ? float(wrong) : 0.0f;
      if (!(wrong > 0.0)) job.out.miss[i] = Miss::kRejected;
    }
  }
}

}  // namespace turnscan::noise
