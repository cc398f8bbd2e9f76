#pragma once
// What images say about a small motion of a camera, and what they leave open.

#include <turnscan/reconstruction/texture/refinement_parts.hpp>

namespace turnscan::texture {

using MotionMatrix = estimation::Matrix6d;

/// How a motion was estimated: as the solution of `information` * motion = right side.
struct MotionEvidence {
  MotionMatrix information = MotionMatrix::Zero();  ///< of all evidence, that known before too
  /// Covariance of the right side by what the information does not count: errors that many
  /// residuals share.
  MotionMatrix shared = MotionMatrix::Zero();
  /// motion^T * image * motion is the mean squared movement of the surface in the images, px^2.
  MotionMatrix image = MotionMatrix::Zero();
};

struct DeterminedMotion {
  Motion motion = Motion::Zero();  ///< the part that the evidence determines
  Motion open = Motion::Zero();    ///< the rest, which it does not tell from none
  double deviation_px = 0.0;       ///< rms over the surface, of all directions together
  int directions = 0;              ///< of six, that are determined
};

/// Parts a motion along six directions whose errors are independent and whose movements in the
/// images are at right angles. A direction is determined where the motion is more than twice its
/// standard deviation. Precondition: the information is positive definite.
DeterminedMotion determined_part(const MotionEvidence& evidence, const Motion& motion);

}  // namespace turnscan::texture
