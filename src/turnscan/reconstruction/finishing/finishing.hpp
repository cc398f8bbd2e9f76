#pragma once
// User-requested post-processing of the meshes of any method.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options/finish_options.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::finishing {

/// Keeps the chosen object, opens or flattens unmeasured surface, smooths, cuts, and drops small
/// parts, in this order, and checks the meshes again. Options at their defaults change nothing.
/// Holes are taken from the objects' evidence. Fails with kInvalidOption if there is no such
/// object, with kTooFewPoints if nothing is left, and with kCancelled.
Result<> finish_objects(const FinishOptions& options, Reconstruction& reconstruction,
                        const RunContext& context);

}  // namespace turnscan::finishing
