#pragma once
// The figures of a comparison between a mesh and a reference. docs/reference/evaluation.md defines
// them.

#include <cstddef>
#include <optional>
#include <string>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan {

/// Statistics of unsigned distances in metres. All are zero where there are no distances (count ==
/// 0). The median and the 95th percentile are by nearest rank.
struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0, median = 0.0, p95 = 0.0, max = 0.0, rms = 0.0;
};

/// Fractions from 0 to 1 at one distance threshold.
struct ThresholdScore {
  double threshold_m = 0.0;
  double precision = 0.0;  ///< of the mesh within the threshold of the reference
  double recall = 0.0;     ///< of the seen reference within the threshold of the mesh
  double f = 0.0;          ///< harmonic mean of precision and recall; 0 when both are 0
};

/// Statistics of signed distances in metres, positive outside the reference. All are zero where
/// there are no distances (count == 0).
struct DeviationStatistics {
  std::size_t count = 0;
  double mean = 0.0, sigma = 0.0;  ///< sigma: standard deviation about the mean
  double low = 0.0, high = 0.0;    ///< 2.5th and 97.5th percentile, by nearest rank
  double min = 0.0, max = 0.0;
};

/// Fractions of the mesh inside and outside a tolerance band, from 0 to 1; their sum is 1.
struct ToleranceShares {
  double tolerance_m = 0.0;
  double in = 0.0;     ///< |deviation| <= tolerance_m
  double above = 0.0;  ///< farther outside the reference: too much material
  double below = 0.0;  ///< farther inside the reference: too little material
};

struct Evaluation {
  /// From the mesh to the reference, over the part of the mesh whose closest reference point was
  /// seen (with the option border=leave-out, and does not lie on an open edge of the reference).
  ErrorStatistics accuracy;
  /// From the seen part of the reference to the mesh.
  ErrorStatistics completeness;
  /// Mean offset of the samples of accuracy from the reference along its normal: positive when the
  /// mesh lies outside the reference.
  double bias_m = 0.0;
  /// Signed distances of the samples of accuracy, negative inside the reference. The sign is
  /// meaningful for a closed reference whose triangles face outward.
  DeviationStatistics deviation;
  std::optional<ToleranceShares> tolerance;  ///< where a tolerance was given
  std::vector<ThresholdScore> scores;        ///< by ascending threshold
  double mesh_area_m2 = 0.0, reference_area_m2 = 0.0;
  double seen_area_m2 = 0.0;  ///< of the reference
  /// The rest of the mesh, which covers what was not seen: its area and its distances to the
  /// reference.
  double invented_area_m2 = 0.0;
  ErrorStatistics invented;
  bool aligned = false;                      ///< whether the mesh was aligned to the reference
  Pose T_reference_mesh = Pose::Identity();  ///< the alignment; identity where there was none
  double alignment_rms_m = 0.0;
};

/// JSON text with a final newline. Keys carry their units ("median_m");
/// docs/reference/evaluation.md lists them.
std::string to_json(const Evaluation& evaluation);

}  // namespace turnscan
