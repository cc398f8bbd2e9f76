#pragma once
// The last steps, on the meshes of any method: what a person wants of them.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options/finish_options.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::finishing {

/// Keeps the chosen object, opens or flattens what nothing measured, smooths, cuts, drops small
/// parts, in this order, and checks the meshes again. Options at their defaults change nothing.
/// Holes are those of the objects' evidence. Fails with kInvalidOption when there is no such
/// object, with kTooFewPoints when nothing is left, and with kCancelled.
Result<> finish_objects(const FinishOptions& options, Reconstruction& reconstruction,
                        const RunContext& context);

}  // namespace turnscan::finishing
