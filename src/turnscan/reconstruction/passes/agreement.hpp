#pragma once
// Agreement of a motion with the surface and the free space of two passes.

#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

struct Agreement {
  double agreeing_m2 = 0.0;  ///< surface that both measured, mean of both directions
  double against_m2 = 0.0;   ///< measured by one where the other saw free space
  double rms_m = 0.0;        ///< distance to the tangent plane, over the agreeing surface
  /// Agreeing surface, weighted by closeness, minus a multiple of the contradicting surface.
  double score_m2 = 0.0;
};

/// Sampling density for comparisons.
enum class Density { kCoarse, kMedium };

/// Surfaces farther apart than tolerance_m do not agree.
Agreement compare(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                  double tolerance_m, Density density);

/// Per sample of b the sample of a that it agrees with; NearestGrid::kNone if there is none.
std::vector<std::uint32_t> agreeing_partners(const PreparedPass& a, const PreparedPass& b,
                                             const Pose& T_a_b, double tolerance_m,
                                             Density density);

/// Significance with which one motion fits better than another: the difference of their scores over
/// its standard deviation, from the differences over blocks of the surface.
double preference(const PreparedPass& a, const PreparedPass& b, const Pose& one, const Pose& other,
                  double tolerance_m);

/// Root mean square distance between the positions of b's surface under two motions.
double motion_distance(const PreparedPass& b, const Pose& one, const Pose& other);

}  // namespace turnscan::passes
