#pragma once
// Comparison of a mesh with a reference: accuracy, completeness, and invented surface.
// docs/reference/evaluation.md has the definitions.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/evaluation/evaluation.hpp>
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

ErrorStatistics error_statistics(std::vector<double> distances);

DeviationStatistics deviation_statistics(std::vector<double> deviations);

/// Distances are exact from sample to triangle; the samples are uniform by area and the same in
/// every run. Begins the phases "align" (if requested), "sample", "accuracy", "completeness",
/// "seen" (if given). Fails with kFormat (the message tells which of the two meshes), with
/// kInvalidOption, with kTooFewPoints if a mesh has no area or nothing of the reference was seen,
/// as icp() and the SeenTest do, and with kCancelled. The result is byte-identical for any number
/// of threads.
Result<Evaluation> evaluate(const TriangleMesh& mesh, const TriangleMesh& reference,
                            const EvaluateOptions& options, const SeenTest& seen,
                            const RunContext& context);

/// The mesh transformed by `pose`, including its normals.
TriangleMesh transformed(const TriangleMesh& mesh, const Pose& pose);

/// The mesh with each vertex coloured by its exact distance to the reference, on the perceptually
/// ordered map viridis (Smith and van der Walt 2015): 0 is dark violet, half of max_error_m teal,
/// max_error_m and more yellow. Fails with kFormat, kInvalidOption (max_error_m not positive),
/// kTooFewPoints (no triangle in the reference), kCancelled.
Result<TriangleMesh> color_by_error(const TriangleMesh& mesh, const TriangleMesh& reference,
                                    double max_error_m, const RunContext& context);

}  // namespace turnscan
