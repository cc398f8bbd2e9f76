#include <algorithm>
#include <cmath>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/reconstruction/texture/motion_evidence.hpp>

namespace turnscan::texture {

namespace {

constexpr double kMinDeviations = 2.0;

}  // namespace

DeterminedMotion determined_part(const MotionEvidence& evidence, const Motion& motion) {
  const MotionMatrix inverse =
      estimation::solve_ldlt(evidence.information, MotionMatrix(MotionMatrix::Identity()));
  const MotionMatrix spread = estimation::solve_ldlt(
      evidence.information, MotionMatrix((evidence.information + evidence.shared) * inverse));
  // With covariance = K K^T, K^-1 motion has unit covariance, also after rotation to the principal
  // axes of the movement in the images.
  const MotionMatrix K = estimation::cholesky_root(0.5 * (spread + spread.transpose()));
  const auto axes = estimation::congruent_eigen(K, evidence.image);
  const Motion deviations = axes.vectors.transpose() * estimation::solve_lower(K, motion);
  DeterminedMotion out;
  Motion kept = Motion::Zero();
  for (int i = 0; i < 6; ++i) {
    out.deviation_px += std::max(0.0, axes.values[i]);
    if (!(std::abs(deviations[i]) > kMinDeviations)) continue;
    kept[i] = deviations[i];
    ++out.directions;
  }
  out.deviation_px = std::sqrt(out.deviation_px);
  out.motion = K * (axes.vectors * kept);
  out.open = motion - out.motion;
  return out;
}

}  // namespace turnscan::texture
