#pragma once
// Normals of candidates from their neighbourhood, oriented towards the sensors that saw them.

#include <turnscan/reconstruction/points/candidates.hpp>

namespace turnscan::points {

/// Sets candidates.cloud.normals: the direction of least variance of the weighted candidates within
/// radius_m (Hoppe et al. 1992) that were seen from the same side, oriented towards the sensors
/// that saw the candidate, never towards one viewpoint for the whole cloud. With fewer than 3
/// neighbours, the mean direction to the sensors.
Result<> estimate_normals(Candidates& candidates, double radius_m, const RunContext& context);

}  // namespace turnscan::points
