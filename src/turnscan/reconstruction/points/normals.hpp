#pragma once
// Normals of candidates from their neighbourhood, towards the sensors that saw them.

#include <turnscan/reconstruction/points/candidates.hpp>

namespace turnscan::points {

/// Sets candidates.cloud.normals: the direction of least spread of the weighted candidates within
/// radius_m (Hoppe et al. 1992) that were seen from the same side, pointing to the side of the
/// sensors that saw the candidate: never one viewpoint for the whole cloud. With fewer than 3
/// neighbours, the mean direction to the sensors.
Result<> estimate_normals(Candidates& candidates, double radius_m, const RunContext& context);

}  // namespace turnscan::points
