#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/texture/motion_evidence.hpp>

namespace turnscan::texture {

namespace {

constexpr double kLeastDeviations = 2.0;

}  // namespace

DeterminedMotion determined_part(const MotionEvidence& evidence, const Motion& motion) {
  const Eigen::LDLT<MotionMatrix> inverse(evidence.information);
  const MotionMatrix spread = inverse.solve(MotionMatrix(evidence.information + evidence.shared) *
                                            inverse.solve(MotionMatrix::Identity()));
  // With covariance = K K^T, K^-1 motion has the covariance 1, and so it has when it is rotated to
  // the axes of the movement in the images.
  const MotionMatrix K = Eigen::LLT<MotionMatrix>(0.5 * (spread + spread.transpose())).matrixL();
  const Eigen::SelfAdjointEigenSolver<MotionMatrix> axes(K.transpose() * evidence.image * K);
  const Motion deviations =
      axes.eigenvectors().transpose() * K.triangularView<Eigen::Lower>().solve(motion);
  DeterminedMotion out;
  Motion kept = Motion::Zero();
  for (int i = 0; i < 6; ++i) {
    out.deviation_px += std::max(0.0, axes.eigenvalues()[i]);
    if (!(std::abs(deviations[i]) > kLeastDeviations)) continue;
    kept[i] = deviations[i];
    ++out.directions;
  }
  out.deviation_px = std::sqrt(out.deviation_px);
  out.motion = K * (axes.eigenvectors() * kept);
  out.open = motion - out.motion;
  return out;
}

}  // namespace turnscan::texture
