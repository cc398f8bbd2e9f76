#pragma once
// Determines which directions of a small camera motion the images support.

#include <turnscan/reconstruction/texture/refinement_parts.hpp>

namespace turnscan::texture {

using MotionMatrix = estimation::Matrix6d;

/// Estimation of a motion as the solution of `information` * motion = right side.
struct MotionEvidence {
  MotionMatrix information = MotionMatrix::Zero();  ///< of all evidence, including the prior
  /// Covariance of the right side that the information does not account for: errors shared by many
  /// residuals.
  MotionMatrix shared = MotionMatrix::Zero();
  /// motion^T * image * motion is the mean squared movement of the surface in the images, px^2.
  MotionMatrix image = MotionMatrix::Zero();
};

struct DeterminedMotion {
  Motion motion = Motion::Zero();  ///< the part that the evidence determines
  Motion open = Motion::Zero();    ///< the rest, which is not distinguishable from zero
  double deviation_px = 0.0;  ///< root mean square over the surface, of all directions together
  int directions = 0;         ///< number of determined ones, of six
};

/// Decomposes a motion into six directions whose errors are independent and whose movements in the
/// images are orthogonal. A direction is determined if the motion is more than twice its standard
/// deviation. Precondition: the information is positive definite.
DeterminedMotion determined_part(const MotionEvidence& evidence, const Motion& motion);

}  // namespace turnscan::texture
