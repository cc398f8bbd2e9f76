#pragma once
// How well a mesh agrees with a reference: accuracy, completeness, what was invented.
// docs/evaluation.md has the definitions.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

struct EvaluateOptions {
  std::string thresholds = "0.5mm,1mm,2mm";  ///< for precision, recall and F; positive lengths
  int samples = 200000;                      ///< drawn from each of the two surfaces
  int seed = 1;
  bool align_icp = false;  ///< first move the mesh rigidly onto the reference
};
/// Fields thresholds, samples, sample-seed, align.
OptionTable describe(EvaluateOptions& options);

/// Which points of the reference the sensors saw: one entry a point, 1 = seen. Points in metres in
/// the reference's frame, unit normals. An empty function: all were seen.
using SeenTest = std::function<Result<std::vector<std::uint8_t>>(std::span<const Vec3f> points,
                                                                 std::span<const Vec3f> normals)>;

/// Of unsigned distances, metres; all zero when there are none (count == 0).
struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0, median = 0.0, p95 = 0.0, max = 0.0, rms = 0.0;
};

/// In percent of samples: 0 to 1.
struct ThresholdScore {
  double threshold_m = 0.0;
  double precision = 0.0;  ///< samples of the mesh within the threshold of the reference
  double recall = 0.0;     ///< samples of the reference within the threshold of the mesh
  double f = 0.0;          ///< harmonic mean of both; 0 when both are
};

struct Evaluation {
  /// Mesh to reference over the part of the mesh whose nearest reference point was seen.
  ErrorStatistics accuracy;
  /// Seen part of the reference to mesh.
  ErrorStatistics completeness;
  /// Mean signed distance of the same samples as accuracy along the reference's normal: positive
  /// when the mesh lies outside the reference.
  double bias_m = 0.0;
  std::vector<ThresholdScore> scores;
  double mesh_area_m2 = 0.0, reference_area_m2 = 0.0;
  double seen_area_m2 = 0.0;  ///< of the reference
  /// The rest of the mesh, where nothing was seen: its area and its own distance to the reference.
  double invented_area_m2 = 0.0;
  ErrorStatistics invented;
  bool aligned = false;
  Pose T_reference_mesh = Pose::Identity();  ///< found by the alignment, else identity
  double alignment_rms_m = 0.0;
};

/// Distances are exact from sample to triangle. Fails as validate_mesh and sample_surface do (the
/// message says which mesh), with kInvalidOption, with kTooFewPoints when the seen part of the
/// reference is empty, as icp does, and when cancelled.
Result<Evaluation> evaluate(const TriangleMesh& mesh, const TriangleMesh& reference,
                            const EvaluateOptions& options, const SeenTest& seen,
                            const RunContext& context);

/// JSON text, keys with units ("median_m"); docs/evaluation.md lists them.
std::string to_json(const Evaluation& evaluation);

/// The mesh with per-vertex colours for its exact distance to the reference: 0 dark violet, over
/// red and orange, to max_error_m and beyond pale yellow (the perceptually ordered "inferno" map).
Result<TriangleMesh> color_by_error(const TriangleMesh& mesh, const TriangleMesh& reference,
                                    double max_error_m, const RunContext& context);

}  // namespace turnscan
