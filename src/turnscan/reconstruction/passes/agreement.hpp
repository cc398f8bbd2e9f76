#pragma once
// How well a motion fits what two passes measured and what they saw to be empty.

#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

struct Agreement {
  double agreeing_m2 = 0.0;  ///< of surface that both measured, mean of both directions
  double against_m2 = 0.0;   ///< measured by one where the other saw nothing
  double rms_m = 0.0;        ///< distance to the tangent plane, over what agrees
  /// What agrees, the better the nearer, minus a multiple of what speaks against it.
  double score_m2 = 0.0;
};

/// Which density is compared.
enum class Density { kCoarse, kMedium };

/// Surfaces farther apart than tolerance_m do not agree.
Agreement compare(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                  double tolerance_m, Density density);

/// Per sample of b the sample of a that it agrees with; NearestGrid::kNone where there is none.
std::vector<std::uint32_t> agreeing_partners(const PreparedPass& a, const PreparedPass& b,
                                             const Pose& T_a_b, double tolerance_m,
                                             Density density);

/// How sure it is that one motion fits better than another: what the difference of their scores is
/// over its deviation, as the differences over blocks of the surface show it.
double preference(const PreparedPass& a, const PreparedPass& b, const Pose& one, const Pose& other,
                  double tolerance_m);

/// Mean square distance by which two motions of b move its surface apart, as a root.
double motion_distance(const PreparedPass& b, const Pose& one, const Pose& other);

}  // namespace turnscan::passes
