#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/reconstruction/texture/motion_evidence.hpp>

namespace turnscan::texture {
namespace {

/// Directions that move the surface by as many pixels as they say, each known to 0.1 pixels.
MotionEvidence good_evidence() {
  MotionEvidence evidence;
  evidence.image.setIdentity();
  evidence.information = 100.0 * MotionMatrix::Identity();
  return evidence;
}

Motion motion(double a, double b, double c, double d, double e, double f) {
  return (Motion() << a, b, c, d, e, f).finished();
}

TEST(MotionEvidence, KeepsWhatIsMoreThanTwiceItsDeviation) {
  const DeterminedMotion part =
      determined_part(good_evidence(), motion(3.0, 0.21, 0.19, -0.19, -0.21, 0.0));
  EXPECT_EQ(part.directions, 3);
  EXPECT_LT((part.motion - motion(3.0, 0.21, 0.0, 0.0, -0.21, 0.0)).norm(), 1e-9);
  EXPECT_LT((part.open - motion(0.0, 0.0, 0.19, -0.19, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(part.deviation_px, 0.1 * std::sqrt(6.0), 1e-9);
}

TEST(MotionEvidence, LeavesADirectionThatNothingDetermines) {
  MotionEvidence evidence = good_evidence();
  evidence.information(1, 1) = 0.01;  // ten pixels
  const DeterminedMotion part = determined_part(evidence, motion(3.0, 8.0, 0.0, 0.0, 0.0, 0.0));
  EXPECT_LT((part.motion - motion(3.0, 0.0, 0.0, 0.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(part.deviation_px, 10.0, 0.1);
}

TEST(MotionEvidence, FindsTheDirectionAmongTheParameters) {
  MotionEvidence evidence = good_evidence();
  const Motion open = motion(0.6, 0.0, 0.0, 0.8, 0.0, 0.0);
  evidence.information -= 99.99 * open * open.transpose();
  const Motion known = motion(0.8, 0.0, 0.0, -0.6, 0.0, 0.0);
  const DeterminedMotion part = determined_part(evidence, 5.0 * open + 2.0 * known);
  EXPECT_LT((part.motion - 2.0 * known).norm(), 1e-9);
  EXPECT_LT((part.open - 5.0 * open).norm(), 1e-9);
}

TEST(MotionEvidence, DoesNotAverageOutWhatResidualsShare) {
  MotionEvidence evidence = good_evidence();
  // All residuals of the fifth parameter are wrong by the same pixel.
  evidence.shared(4, 4) = 100.0 * 100.0;
  const DeterminedMotion part = determined_part(evidence, motion(1.5, 0.0, 0.0, 0.0, 1.5, 0.0));
  EXPECT_LT((part.motion - motion(1.5, 0.0, 0.0, 0.0, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(part.deviation_px, 1.0, 0.05);
}

TEST(MotionEvidence, LooksAtMovementsInTheImages) {
  // Of two parameters that do nearly the same in the images the difference is hardly known, and
  // hardly matters; the sum is known well.
  MotionEvidence evidence = good_evidence();
  const Motion sum = motion(0.0, 1.0, 1.0, 0.0, 0.0, 0.0) / std::sqrt(2.0);
  const Motion difference = motion(0.0, 1.0, -1.0, 0.0, 0.0, 0.0) / std::sqrt(2.0);
  evidence.image -= (1.0 - 1e-6) * difference * difference.transpose();
  evidence.information -= (100.0 - 2e-4) * difference * difference.transpose();
  const DeterminedMotion part = determined_part(evidence, 2.0 * sum + 0.5 * difference);
  EXPECT_LT((part.motion - 2.0 * sum).norm(), 1e-9);
  EXPECT_NEAR(part.deviation_px, std::sqrt(5.0 * 0.01 + 0.005), 1e-3);
}

}  // namespace
}  // namespace turnscan::texture
