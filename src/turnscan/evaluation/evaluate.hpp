#pragma once
// Comparison of a mesh with a reference: accuracy, completeness, and invented surface.
// docs/evaluation.md has the definitions.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/registration/registration.hpp>
#include <vector>

namespace turnscan {

enum class Align { kNone, kIcp };
/// Treatment of the part of the mesh nearest to an open edge of the reference, such as closed
/// holes.
enum class Border { kCount, kLeaveOut };

struct EvaluateOptions {
  std::string thresholds = "0.5mm,1mm,2mm";  ///< for precision, recall and F
  int samples = 200000;                      ///< drawn from each of the two surfaces
  int seed = 1;
  Align align = Align::kNone;           ///< kIcp: first align the mesh rigidly with the reference
  IcpOptions icp{};                     ///< for kIcp
  Border border = Border::kCount;       ///< kLeaveOut: treated like unseen surface
  std::optional<double> tolerance_m{};  ///< half the width of the band of ToleranceShares
};
/// Fields thresholds, samples, sample-seed, border (count, leave-out), tolerance, align (none,
/// icp), and those of IcpOptions.
OptionTable describe(EvaluateOptions& options);

/// Parses lengths separated by commas, as "0.5mm,1mm", to metres, ascending. kInvalidOption unless
/// there are one to 64, all positive.
Result<std::vector<double>> parse_thresholds(std::string_view text);

/// Marks the points of the reference that the sensors saw: one entry per point, 1 = seen. Points in
/// metres in the reference's frame, unit normals. An empty function: all were seen.
using SeenTest = std::function<Result<std::vector<std::uint8_t>>(std::span<const Vec3f> points,
                                                                 std::span<const Vec3f> normals)>;

/// Statistics of unsigned distances, metres; all zero if there are none (count == 0). Percentiles
/// are by nearest rank.
struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0, median = 0.0, p95 = 0.0, max = 0.0, rms = 0.0;
};
ErrorStatistics error_statistics(std::vector<double> distances);

/// Fractions, 0 to 1.
struct ThresholdScore {
  double threshold_m = 0.0;
  double precision = 0.0;  ///< of the mesh within the threshold of the reference
  double recall = 0.0;     ///< of the seen reference within the threshold of the mesh
  double f = 0.0;          ///< harmonic mean of both; 0 if both are 0
};

/// Statistics of signed distances, metres, positive outside; all zero if there are none (count ==
/// 0).
struct DeviationStatistics {
  std::size_t count = 0;
  double mean = 0.0, sigma = 0.0;  ///< sigma: standard deviation about the mean
  double low = 0.0, high = 0.0;    ///< 2.5th and 97.5th percentile, by nearest rank
  double min = 0.0, max = 0.0;
};
DeviationStatistics deviation_statistics(std::vector<double> deviations);

/// Shares of the mesh, 0 to 1; their sum is 1.
struct ToleranceShares {
  double tolerance_m = 0.0;
  double in = 0.0;     ///< |deviation| <= tolerance
  double above = 0.0;  ///< outside the reference by more than the tolerance: too much material
  double below = 0.0;  ///< inside it by more than the tolerance: too little
};

struct Evaluation {
  /// Distances from the mesh to the reference over the part of the mesh whose nearest reference
  /// point was seen (and, with Border::kLeaveOut, is not on an open edge).
  ErrorStatistics accuracy;
  /// Distances from the seen part of the reference to the mesh.
  ErrorStatistics completeness;
  /// Mean offset of the samples of accuracy from the reference, along its normal: positive if the
  /// mesh is outside the reference.
  double bias_m = 0.0;
  /// For the samples of accuracy: distance to the reference, negative inside it. The sign is that
  /// of PseudoNormals, correct for a closed reference whose triangles face outward.
  DeviationStatistics deviation;
  std::optional<ToleranceShares> tolerance;  ///< if a tolerance was given
  std::vector<ThresholdScore> scores;
  double mesh_area_m2 = 0.0, reference_area_m2 = 0.0;
  double seen_area_m2 = 0.0;  ///< of the reference
  /// The rest of the mesh, where nothing was seen: its area and its own distance to the reference.
  double invented_area_m2 = 0.0;
  ErrorStatistics invented;
  bool aligned = false;
  Pose T_reference_mesh = Pose::Identity();  ///< from the alignment, else identity
  double alignment_rms_m = 0.0;
};

/// Distances are exact from sample to triangle; the samples are uniform by area and the same in
/// every run. Begins the phases "align" (if requested), "sample", "accuracy", "completeness",
/// "seen" (if given). Fails with kFormat (the message tells which of the two meshes), with
/// kInvalidOption, with kTooFewPoints if a mesh has no area or nothing of the reference was seen,
/// as icp() and the SeenTest do, and with kCancelled. The result is byte-identical for any number
/// of threads.
Result<Evaluation> evaluate(const TriangleMesh& mesh, const TriangleMesh& reference,
                            const EvaluateOptions& options, const SeenTest& seen,
                            const RunContext& context);

/// JSON text with a final newline; keys carry units ("median_m"). docs/evaluation.md lists them.
std::string to_json(const Evaluation& evaluation);

/// The mesh transformed by `pose`, including its normals.
TriangleMesh transformed(const TriangleMesh& mesh, const Pose& pose);

/// The mesh with each vertex coloured by its exact distance to the reference, on the perceptually
/// ordered map viridis (Smith and van der Walt 2015): 0 is dark violet, half of max_error_m teal,
/// max_error_m and more yellow. Fails with kFormat, kInvalidOption (max_error_m not positive),
/// kTooFewPoints (no triangle in the reference), kCancelled.
Result<TriangleMesh> color_by_error(const TriangleMesh& mesh, const TriangleMesh& reference,
                                    double max_error_m, const RunContext& context);

}  // namespace turnscan
