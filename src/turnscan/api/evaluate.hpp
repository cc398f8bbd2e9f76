#pragma once
// How well a mesh agrees with a reference: what `turnscan evaluate` does.

#include <string>
#include <string_view>
#include <turnscan/api/options.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/evaluation/evaluation.hpp>
#include <vector>

namespace turnscan {

/// Compares samples of both surfaces (metres, one frame of reference) with the other surface. The
/// option `align=icp` first aligns the mesh rigidly to the reference. The result is the same for
/// every run and every number of threads. SimulatedScan::evaluate() leaves out what no frame saw.
///
/// The options are those of `turnscan evaluate`. Fails with kInvalidOption, kFormat (a mesh is
/// damaged; the message says which), kTooFewPoints (a mesh without area) and kCancelled.
Result<Evaluation> evaluate(const TriangleMesh& mesh, const TriangleMesh& reference,
                            const Options& options = {}, const RunContext& context = {});

/// The options of evaluate().
std::vector<OptionDescription> evaluate_options();

/// Fits elements (spheres, cylinders, cones, planes, circles, lines) to a mesh, and measures their
/// distances and angles: what `turnscan evaluate --elements --json` does. `elements` is the JSON
/// text of its file, the result that of its figures; docs/reference/evaluation.md describes both.
/// Fails with kFormat (the text or the mesh), kTooFewPoints and kInvalidOption, and names the
/// element; kCancelled.
Result<std::string> inspect(const TriangleMesh& mesh, std::string_view elements,
                            const RunContext& context = {});

}  // namespace turnscan
